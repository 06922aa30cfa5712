// SPDX-License-Identifier: BSD-3-Clause
/// The many ways in which the cases write down what their tips must show.
#include "tests/verification/reference_cases.hpp"

#include <cmath>
#include <numbers>
#include <regex>
#include <stdexcept>

namespace cdca::testing {

namespace {

using nlohmann::json;

const double root_pi = std::sqrt(std::numbers::pi);

/// {"KI", "KII"}, {"FI", "FII"} with K = F sqrt(pi) (unit half length), or [K_I, K_II].
ExpectedTip tip_of(const Vec2& at, const json& value) {
  ExpectedTip tip;
  tip.at = at;
  if (value.is_array()) {
    tip.k1 = value.at(0);
    tip.k2 = value.at(1);
  } else if (value.contains("KI")) {
    tip.k1 = value.at("KI");
    tip.k2 = value.at("KII");
  } else {
    tip.k1 = root_pi * value.at("FI").get<double>();
    tip.k2 = root_pi * value.value("FII", 0.0);  // not given: none, by symmetry
  }
  return tip;
}

/// The place in "tip(12,0)", "c0 tip[0.48, 1.71]", or the end of the "left" or "right" crack.
Vec2 place_of(const ReferenceGeometry& g, const std::string& name) {
  static const std::regex form(R"(.*tip[(\[]([-+.\de]+),\s*([-+.\de]+)[)\]])");
  if (name == "left") return g.cracks.at(0).points.back();
  if (name == "right") return g.cracks.at(1).points.back();
  if (name == "lower outer") return g.cracks.at(0).points.front();
  if (name == "lower inner") return g.cracks.at(0).points.back();
  if (name == "upper inner") return g.cracks.at(1).points.front();
  if (name == "upper outer") return g.cracks.at(1).points.back();
  static const std::regex numbers(R"(\((\d), (\d)\))");  // crack and end
  std::smatch match;
  if (std::regex_match(name, match, numbers)) {
    const auto& points = g.cracks.at(std::size_t(std::stoi(match[1]))).points;
    return match[2] == "0" ? points.front() : points.back();
  }
  if (!std::regex_match(name, match, form)) {
    throw std::runtime_error("reference \"" + name + "\" names no tip");
  }
  return {std::stod(match[1]), std::stod(match[2])};
}

/// Closed cracks: the two tips of one flaw, in its plate where the reference has one.
std::vector<ExpectedTip> closed_tips(const ReferenceGeometry& g, const json& r) {
  const double k2 = r.at(r.contains("KII_plate60x120") ? "KII_plate60x120" : "KII_infinite");
  const auto& points = g.cracks.at(0).points;
  return {{points.front(), r.at("KI"), k2}, {points.back(), r.at("KI"), k2}};
}

/// A flaw with a wing at each end, alike by symmetry.
std::vector<ExpectedTip> wing_tips(const ReferenceGeometry& g, const json& r) {
  const auto& points = g.cracks.at(0).points;
  return {tip_of(points.front(), r), tip_of(points.back(), r)};
}

/// Open at its right end, closed at its left one. F = K / (sigma sqrt(pi a)).
std::vector<ExpectedTip> half_open_tips(const ReferenceGeometry& g, const json& r) {
  const double scale = root_pi * std::sqrt(g.longest());
  const auto& points = g.cracks.at(0).points;
  return {{points.front(), scale * r.at("FI_left").get<double>()},
          {points.back(), scale * r.at("FI_right").get<double>()}};
}

/// Two collinear cracks of half length 1: outer, inner, inner, outer tip.
std::vector<ExpectedTip> collinear_tips(const ReferenceGeometry& g, const json& r) {
  const double inner = root_pi * r.at("F_inner").get<double>();
  const double outer = root_pi * r.at("F_outer").get<double>();
  const auto &left = g.cracks.at(0).points, &right = g.cracks.at(1).points;
  return {
      {left.front(), outer}, {left.back(), inner}, {right.front(), inner}, {right.back(), outer}};
}

std::vector<ExpectedTip> arc_tips(const ReferenceGeometry& g, const json& r) {
  const auto& points = g.cracks.at(0).points;
  const double half_chord = (points.back() - points.front()).norm() / 2;
  std::vector<ExpectedTip> tips;
  for (const Vec2& at : {points.front(), points.back()}) {
    const double scale = root_pi * std::sqrt(half_chord);
    tips.push_back({at, scale * r.at("FI").get<double>(), scale * r.at("FII_abs").get<double>()});
    tips.back().sign_of_k2 = false;
  }
  return tips;
}

}  // namespace

std::vector<ExpectedTip> expected_tips(const ReferenceCase& c) {
  const json& r = c.json.at("reference");
  const ReferenceGeometry g = geometry_of(c);
  const Vec2 only_tip = g.cracks.at(0).points.back();
  if (r.contains("KII_infinite")) return closed_tips(g, r);
  if (r.contains("FI_right")) return half_open_tips(g, r);
  if (r.contains("FII_abs")) return arc_tips(g, r);
  if (r.contains("FI")) return wing_tips(g, r);
  if (r.contains("KI")) return {tip_of(only_tip, r)};
  if (r.contains("K_over_sigma")) return {{only_tip, r.at("K_over_sigma").get<double>()}};
  if (r.contains("F")) {
    return {{only_tip, r.at("F").get<double>() * root_pi * std::sqrt(g.longest())}};
  }
  if (r.contains("F_inner")) return collinear_tips(g, r);
  std::vector<ExpectedTip> tips;
  if (r.contains("all")) {
    for (const auto& crack : g.cracks) tips.push_back(tip_of(crack.points.back(), r.at("all")));
    return tips;
  }
  for (const auto& [name, value] : r.items()) tips.push_back(tip_of(place_of(g, name), value));
  return tips;
}

std::vector<ExpectedStress> expected_stresses(const ReferenceCase& c) {
  const json& reference = c.json.at("reference");
  const auto list = [](const json& j) { return j.get<std::vector<double>>(); };
  const auto r = list(reference.at("r_mm"));
  const auto sx = list(reference.at("sx_over_sigma")), sy = list(reference.at("sy_over_sigma"));
  std::vector<ExpectedStress> found;
  for (std::size_t k = 0; k < r.size(); ++k) {
    found.push_back({r[k], 0.0, Voigt(sx.at(k), sy.at(k), 0), 2});
  }
  const auto degrees = list(reference.at("ring_r1_theta"));
  const json& ring = reference.at("ring");
  const auto xx = list(ring.at(0)), yy = list(ring.at(1)), xy = list(ring.at(2));
  for (std::size_t k = 0; k < degrees.size(); ++k) {
    found.push_back({1.0, degrees[k], Voigt(xx.at(k), yy.at(k), xy.at(k)), 3});
  }
  return found;
}

}  // namespace cdca::testing
