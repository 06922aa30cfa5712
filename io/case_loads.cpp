// SPDX-License-Identifier: BSD-3-Clause
#include "io/case_loads.hpp"

#include "io/expression.hpp"

#include <fmt/format.h>

#include <cmath>

namespace cdca {
namespace {

/// The written value itself is nothing: 0, or an expression without variables that gives 0.
bool is_zero(const ConfigNode& value) {
  if (value.is_number()) return value.number == 0.0;
  const Expression expression(value.text);
  return expression.is_constant() && expression(0.0, 0.0, 0.0) == 0.0;
}

}  // namespace

void LoadReader::check_factor(const LoadValue& load, const ConfigNode& value,
                              const std::string& path) const {
  if (!spec_.loading.critical || load.proportional) return;
  problems_.push_back(problem_at(
      value, path,
      fmt::format("Found {}, which is not proportional to the load factor; with loading.mode "
                  "\"critical\" allowed is a number, or s times an expression in x and y.",
                  describe(value))));
}

std::optional<LoadValue> LoadReader::read(const ConfigNode& value, const std::string& path) const {
  if (value.is_number()) {
    auto load = proportional_load(value.number);
    load.text = toml_value(value);
    return load;
  }
  try {
    auto load = expression_load(value.text, places_, value.line, path);
    for (const double s : {spec_.load_factors.front(), spec_.load_factors.back()}) {
      for (const auto& at : places_) load.at(at.x(), at.y(), s);
    }
    check_factor(load, value, path);
    return load;
  } catch (const InputError& error) {
    problems_.push_back(problem_at(value, path, error.what()));
    return std::nullopt;
  }
}

std::optional<LoadValue> LoadReader::load(const ConfigNode& value, const std::string& path) const {
  auto load = read(value, path);
  return load && is_zero(value) ? std::nullopt : load;
}

std::optional<LoadValue> LoadReader::support(const ConfigNode& value,
                                             const std::string& path) const {
  const bool is_free = value.kind == ConfigKind::text && value.text == "free";
  return is_free ? std::nullopt : read(value, path);
}

LoadVector LoadReader::load_pair(const ConfigNode& value, const std::string& path) const {
  return {load(value.items[0], path + "[0]"), load(value.items[1], path + "[1]")};
}

LoadVector LoadReader::support_pair(const ConfigNode& value, const std::string& path) const {
  return {support(value.items[0], path + "[0]"), support(value.items[1], path + "[1]")};
}

std::array<Vec2, 2> ends_of(const DomainSpec& domain, Side side) {
  const Vec2 low = domain.origin;
  const Vec2 high = domain.origin + domain.size;
  switch (side) {
    case Side::left: return {low, Vec2(low.x(), high.y())};
    case Side::right: return {Vec2(high.x(), low.y()), high};
    case Side::bottom: return {low, Vec2(high.x(), low.y())};
    case Side::top: return {Vec2(low.x(), high.y()), high};
  }
  return {low, high};
}

std::vector<Vec2> places_in(const DomainSpec& domain) {
  // Uneven fractions, so that a symmetric expression is not seen at its zeros only.
  std::vector<Vec2> places;
  for (const double x : {0.07, 0.31, 0.52, 0.77, 0.94}) {
    for (const double y : {0.04, 0.23, 0.46, 0.71, 0.96}) {
      places.emplace_back(domain.origin + Vec2(x, y).cwiseProduct(domain.size));
    }
  }
  return places;
}

std::vector<Vec2> places_on(const DomainSpec& domain, Side side) {
  const auto [start, end] = ends_of(domain, side);
  std::vector<Vec2> places;
  for (const double t : {0.013, 0.11, 0.27, 0.38, 0.52, 0.66, 0.79, 0.91, 0.989}) {
    places.emplace_back(start + t * (end - start));
  }
  return places;
}

std::vector<Vec2> places_on(const CrackSpec& crack) {
  std::vector<Vec2> places;
  for (std::size_t i = 0; i + 1 < crack.points.size(); ++i) {
    for (const double t : {0.21, 0.53, 0.82}) {
      places.emplace_back(crack.points[i] + t * (crack.points[i + 1] - crack.points[i]));
    }
  }
  return places;
}

}  // namespace cdca
