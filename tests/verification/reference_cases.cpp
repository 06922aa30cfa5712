// SPDX-License-Identifier: BSD-3-Clause
#include "tests/verification/reference_cases.hpp"

#include "core/cracks/crack.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <fstream>
#include <numbers>
#include <regex>
#include <stdexcept>

namespace cdca::testing {

namespace {

using nlohmann::json;

constexpr double pi = std::numbers::pi;

json read_json(const std::string& name) {
  const std::string path =
      std::string(CDCA_SOURCE_DIR) + "/tests/verification/reference/" + name + ".json";
  std::ifstream file(path);
  if (!file) throw std::runtime_error("cannot read " + path);
  return json::parse(file);
}

[[noreturn]] void not_understood(const ReferenceCase& c, const std::string& what) {
  throw std::runtime_error(c.id + ": " + what + " is not understood: " + c.json.dump());
}

Vec2 point_of(const json& j) { return {j.at(0).get<double>(), j.at(1).get<double>()}; }

std::vector<double> numbers_in(const std::string& text) {
  static const std::regex number(R"([-+]?(\d+\.?\d*|\.\d+)(e[-+]?\d+)?)");
  std::vector<double> found;
  for (std::sregex_iterator it(text.begin(), text.end(), number), end; it != end; ++it) {
    found.push_back(std::stod(it->str()));
  }
  return found;
}

/// "arc R=1 centred (0,0), polar angles 90-30..90+30 deg, polyline >=40 segments"
double half_angle_of_arc(const ReferenceCase& c) {
  static const std::regex form(
      R"(arc R=1 centred \(0,0\), polar angles 90-(\d+)\.\.90\+\1 deg, polyline >=40 segments)");
  const std::string text = c.json.at("geometry").at("crack");
  std::smatch match;
  if (!std::regex_match(text, match, form)) not_understood(c, "crack");
  return std::stod(match[1]) * pi / 180;
}

std::vector<Vec2> arc_points(double half_angle) {
  constexpr int segments = 80;
  std::vector<Vec2> points;
  for (int k = 0; k <= segments; ++k) {
    const double angle = pi / 2 + half_angle * (1.0 - 2.0 * k / segments);
    points.emplace_back(std::cos(angle), std::sin(angle));
  }
  return points;
}

bool on_rim(const ReferenceGeometry& g, const Vec2& x) {
  const double gap = std::min((x - g.lower).minCoeff(), (g.upper - x).minCoeff());
  return !g.infinite && gap < 1e-9 * (g.upper - g.lower).norm();
}

void read_cracks(const ReferenceCase& c, const json& geometry, ReferenceGeometry& g) {
  if (geometry.contains("arms")) {
    const Vec2 junction = point_of(geometry.at("junction"));
    for (const json& arm : geometry.at("arms")) {
      g.cracks.push_back({{junction, point_of(arm)}, {false, true}});
    }
  } else if (geometry.contains("cracks")) {
    for (const json& crack : geometry.at("cracks")) {
      g.cracks.emplace_back();
      for (const json& point : crack) g.cracks.back().points.push_back(point_of(point));
    }
  } else if (geometry.contains("crack")) {
    g.cracks.push_back({arc_points(half_angle_of_arc(c)), {true, true}});
    g.smooth = true;
  } else {
    not_understood(c, "geometry");
  }
}

double length_of(const ReferenceGeometry::CrackLine& crack) {
  double sum = 0.0;
  for (std::size_t k = 1; k < crack.points.size(); ++k) {
    sum += (crack.points[k] - crack.points[k - 1]).norm();
  }
  return crack.is_tip[0] && crack.is_tip[1] ? sum / 2 : sum;
}

double distance(const ReferenceGeometry::CrackLine& crack, const Vec2& x) {
  double least = 1e300;
  for (std::size_t k = 1; k < crack.points.size(); ++k) {
    const Vec2 &a = crack.points[k - 1], &b = crack.points[k];
    least = std::min(least, (a + nearest_fraction(a, b, x) * (b - a) - x).norm());
  }
  return least;
}

}  // namespace

void PrintTo(const ReferenceCase& reference, std::ostream* out) { *out << test_name(reference); }

std::string test_name(const ReferenceCase& reference) {
  std::string name;
  for (const char c : reference.id) {
    if (std::isalnum(static_cast<unsigned char>(c))) {
      name += c;
    } else if (c == '-' || c == '.') {
      name += c == '-' ? "minus" : "p";
    } else if (!name.empty() && name.back() != '_') {
      name += '_';
    }
  }
  return name;
}

std::vector<ReferenceCase> reference_cases() {
  static const json file = read_json("cases"), paths = read_json("paths");
  std::vector<ReferenceCase> cases;
  for (const json& c : file.at("cases")) cases.push_back({c.at("id"), c.at("tag"), c});
  for (const auto& [name, path] : paths.at("paths").items()) {
    cases.push_back({name, path.at("tag"), path});
    cases.back().json["group"] = "paths";
  }
  return cases;
}

std::map<std::string, int> reference_tags() {
  std::map<std::string, int> count;
  for (const ReferenceCase& c : reference_cases()) ++count[c.tag];
  return count;
}

double ReferenceGeometry::shortest() const {
  double least = 1e300;
  for (const CrackLine& crack : cracks) least = std::min(least, length_of(crack));
  return least;
}

double ReferenceGeometry::longest() const {
  double most = 0.0;
  for (const CrackLine& crack : cracks) most = std::max(most, length_of(crack));
  return most;
}

double ReferenceGeometry::room() const {
  double least = 1e300;
  for (const CrackLine& crack : cracks) {
    const auto& p = crack.points;
    for (const int end : {0, 1}) {
      if (!crack.is_tip[end]) continue;
      const Vec2& tip = end == 0 ? p.front() : p.back();
      const Vec2& bend = end == 0 ? p[1] : p[p.size() - 2];
      if (p.size() > 2 && !smooth) least = std::min(least, (tip - bend).norm());
      for (const CrackLine& other : cracks) {
        if (&other != &crack) least = std::min(least, distance(other, tip));
      }
      if (!infinite) {
        least = std::min({least, (tip - lower).minCoeff(), (upper - tip).minCoeff()});
      }
    }
  }
  return least;
}

ReferenceGeometry geometry_of(const ReferenceCase& c) {
  const json& geometry = c.json.at("geometry");
  ReferenceGeometry g;
  if (geometry.is_string()) {  // "NEARTIP W=20 H=52 a=12"
    const auto n = numbers_in(geometry.get<std::string>());
    if (n.size() != 3) not_understood(c, "geometry");
    g.lower = {0, -n[1] / 2};
    g.upper = {n[0], n[1] / 2};
    g.cracks.push_back({{{0, 0}, {n[2], 0}}, {true, true}});
  } else {
    const json& domain = geometry.at("domain");
    g.infinite = domain.is_string();
    if (g.infinite && domain.get<std::string>().rfind("infinite", 0) != 0) {
      not_understood(c, "domain");
    }
    if (!g.infinite) {
      g.lower = {domain.at(0).get<double>(), domain.at(2).get<double>()};
      g.upper = {domain.at(1).get<double>(), domain.at(3).get<double>()};
    }
    read_cracks(c, geometry, g);
  }
  for (auto& crack : g.cracks) {
    if (on_rim(g, crack.points.front())) crack.is_tip[0] = false;
    if (on_rim(g, crack.points.back())) crack.is_tip[1] = false;
  }
  return g;
}

namespace {

/// Loads of cases whose faces touch; they name the friction themselves or in the case's id.
std::optional<ReferenceLoad> load_on_touching_faces(const ReferenceCase& c,
                                                    const std::string& text) {
  using Kind = ReferenceLoad::Kind;
  static const std::regex slope(
      R"(sigma_yy=x/a on top/bottom \(a=([\d.]+)\), frictionless or frictional alike)");
  static const std::regex own(R"(sigma_yy=-1; closed, mu=([\d.]+))");
  static const std::regex sides(R"((remote )?sigma_yy=-1( top/bottom)?)"
                                R"((, sigma_xx=(-[\d.]+) sides)?[;,] (Coulomb )?mu.*)");
  static const std::regex named(R"(.*_mu([\d.]+)(_.*)?)");
  std::smatch match;
  if (std::regex_match(text, match, slope))
    return ReferenceLoad{Kind::slope, {0, 0, 0}, 1 / std::stod(match[1]), 0.0};
  if (std::regex_match(text, match, own))
    return ReferenceLoad{Kind::stress, {0, -1, 0}, 0.0, std::stod(match[1])};
  if (!std::regex_match(text, match, sides)) return std::nullopt;
  const double side = match[4].matched ? std::stod(match[4]) : 0.0;
  if (!std::regex_match(c.id, match, named)) not_understood(c, "friction");
  return ReferenceLoad{Kind::stress, {side, -1, 0}, 0.0, std::stod(match[1])};
}

}  // namespace

ReferenceLoad load_of(const ReferenceCase& c) {
  using Kind = ReferenceLoad::Kind;
  static const std::map<std::string, ReferenceLoad> known{
      {"sigma_yy=1 on top and bottom edges, sides free", {Kind::stress, {0, 1, 0}}},
      {"sigma_yy=1 on top and bottom, sides free", {Kind::stress, {0, 1, 0}}},
      {"sigma_yy=1 top/bottom", {Kind::stress, {0, 1, 0}}},
      {"sigma_yy=1", {Kind::stress, {0, 1, 0}}},
      {"sigma=1 (scale 200 MPa)", {Kind::stress, {0, 1, 0}}},
      {"remote sigma_yy=1", {Kind::stress, {0, 1, 0}}},
      {"uniaxial sigma_yy=1", {Kind::stress, {0, 1, 0}}},
      {"pure shear sigma_xy=1 on all four edges", {Kind::stress, {0, 0, 1}}},
      {"biaxial sigma_xx=sigma_yy=1", {Kind::stress, {1, 1, 0}}},
      {"remote sigma_xx=sigma_yy=1", {Kind::stress, {1, 1, 0}}},
      {"biaxial 1", {Kind::stress, {1, 1, 0}}},
      {"sigma_yy=-1; linear traction-free (NO contact), KI<0 expected", {Kind::stress, {0, -1, 0}}},
      {"sigma_yy=1-2x on top/bottom (outer fibre 1 at cracked edge)", {Kind::bending, {0, 0, 0}}},
      {"top edge traction tau_x=1; bottom edge u=0; plane strain nu=.25 (K insensitive to nu)",
       {Kind::edge_shear, {0, 0, 0}}},
  };
  const std::string text = c.json.at("loads");
  if (const auto it = known.find(text); it != known.end()) return it->second;
  if (const auto load = load_on_touching_faces(c, text)) return *load;
  const std::string start = "remote (sxx,syy,sxy)=";
  const auto n = numbers_in(text);
  if (text.rfind(start, 0) != 0 || n.size() != 3) not_understood(c, "load");
  return {Kind::stress, {n[0], n[1], n[2]}};
}

ReferenceTolerance tolerance_of(const ReferenceCase& c) {
  ReferenceTolerance t;
  const std::map<std::string, std::optional<double>*> known{
      {"K_rel", &t.k_rel},
      {"KII_abs_over_Kmax", &t.k2_over_max},
      {"K_abs_over_Kmax", &t.k_over_max},
      {"K_rel_of_max", &t.k_rel_of_max},
      {"stress_rel", &t.stress_rel},
      {"KII_rel", &t.k2_rel},
      {"KI_abs_over_KII", &t.k1_over_k2},
      {"closure_point_abs", &t.closure_elements},
      {"sigma_wing_init_rel", &t.initiation_rel},
      {"arrest_radius_rel", &t.arrest_rel}};
  for (const auto& [key, value] : c.json.at("tolerance").items()) {
    if (key == "mesh" || key == "range") continue;  // see reference_static_test.cpp
    const auto it = known.find(key);
    if (it == known.end()) not_understood(c, "tolerance " + key);
    // "1.5h": in elements
    *it->second =
        value.is_string() ? numbers_in(value.get<std::string>()).at(0) : value.get<double>();
  }
  return t;
}

}  // namespace cdca::testing
