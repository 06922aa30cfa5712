// SPDX-License-Identifier: BSD-3-Clause
#include "benchmarks/plate_case.hpp"

#include "core/base/stopwatch.hpp"

#include <algorithm>
#include <array>
#include <numbers>
#include <random>
#include <string>

namespace cdca::benchmarks {

namespace {

using Points = std::array<Vec2, 2>;

bool are_apart(const Points& a, const Points& b) {
  constexpr double least = 0.03;  // m
  for (int s = 0; s <= 10; ++s) {
    for (int t = 0; t <= 10; ++t) {
      const Vec2 x = a[0] + 0.1 * s * (a[1] - a[0]), y = b[0] + 0.1 * t * (b[1] - b[0]);
      if ((x - y).norm() < least) return false;
    }
  }
  return true;
}

/// Cracks 5 to 15 cm long, well inside the plate, none near another.
std::vector<Points> random_cracks(int count) {
  std::mt19937 engine(7);
  // the standard's own distributions differ between libraries
  const auto any = [&engine] { return double(engine()) / double(std::mt19937::max()); };
  std::vector<Points> cracks;
  while (int(cracks.size()) < count) {
    const Vec2 middle(0.1 + 0.8 * any(), 0.1 + 1.8 * any());
    const double half = 0.025 + 0.05 * any(), angle = std::numbers::pi * any();
    const Vec2 along = half * Vec2(std::cos(angle), std::sin(angle));
    const Points crack{middle - along, middle + along};
    const bool free = std::all_of(cracks.begin(), cracks.end(),
                                  [&](const Points& other) { return are_apart(crack, other); });
    if (free) cracks.push_back(crack);
  }
  return cracks;
}

std::vector<Points> cracks_of(int count) {
  if (count == 1) return {{Vec2(0.3012, 1.003), Vec2(0.7031, 1.0511)}};
  if (count == 3) {
    return {{Vec2(0.2012, 0.503), Vec2(0.5031, 0.6511)},
            {Vec2(0.5, 1.1), Vec2(0.8, 0.95)},
            {Vec2(0.2, 1.503), Vec2(0.6031, 1.7511)}};
  }
  return random_cracks(count);
}

BoundarySpec held_side(Side side, double upward) {
  BoundarySpec b;
  b.kind = BoundaryKind::side;
  b.side = side;
  b.displacement[1] = proportional_load(upward);
  return b;
}

}  // namespace

CaseSpec plate_in_tension(int nx, int cracks) {
  CaseSpec spec;
  spec.domain.size = {1, 2};
  spec.domain.cells = {nx, 2 * nx};
  spec.domain.plane_strain = true;
  spec.material.young = 1000.0;
  spec.material.poisson = 0.3;
  for (const Points& p : cracks_of(cracks)) {
    spec.cracks.push_back({"crack" + std::to_string(spec.cracks.size() + 1), {p[0], p[1]}, 0});
  }
  BoundarySpec corner;
  corner.kind = BoundaryKind::point;
  corner.at = {0, 0};
  corner.displacement[0] = proportional_load(0);
  spec.boundaries = {held_side(Side::top, 1e-3), held_side(Side::bottom, 0), corner};
  return spec;
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const std::size_t half = values.size() / 2;
  return values.size() % 2 == 1 ? values[half] : 0.5 * (values[half - 1] + values[half]);
}

double triad_bandwidth(std::size_t length) {
  std::vector<double> x(length, 1.0), y(length, 2.0), z(length, 0.0);
  double best = 1e9;
  for (int run = 0; run < 15; ++run) {
    const double factor = 1.0 + run;
    const Stopwatch watch;
    for (std::size_t k = 0; k < length; ++k) z[k] = y[k] + factor * x[k];
    best = std::min(best, watch.seconds());
  }
  return z[length / 2] > 0 ? 3.0 * double(sizeof(double)) * double(length) / best : 0.0;
}

}  // namespace cdca::benchmarks
