// SPDX-License-Identifier: BSD-3-Clause
#include "core/cells/gauss.hpp"

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

namespace cdca {

namespace {

std::vector<GaussPoint> compute(int n) {
  std::vector<GaussPoint> points;
  for (int k = 0; k < n; ++k) {
    // Newton on the Legendre polynomial from the usual first guess
    double x = std::cos(std::numbers::pi * (k + 0.75) / (n + 0.5)), slope = 1.0;
    for (int it = 0; it < 100; ++it) {
      double p0 = 1.0, p1 = x;
      for (int m = 2; m <= n; ++m) {
        const double p2 = ((2 * m - 1) * x * p1 - (m - 1) * p0) / m;
        p0 = p1;
        p1 = p2;
      }
      slope = n * (x * p1 - p0) / (x * x - 1);
      const double dx = p1 / slope;
      x -= dx;
      if (std::abs(dx) < 1e-15) break;
    }
    points.push_back({0.5 * (1 - x), 1.0 / ((1 - x * x) * slope * slope)});
  }
  return points;
}

}  // namespace

std::span<const GaussPoint> gauss_points(int n) {
  static const auto tables = [] {
    std::array<std::vector<GaussPoint>, 21> all;
    for (int k = 1; k <= 20; ++k) all[std::size_t(k)] = compute(k);
    return all;
  }();
  return tables.at(std::size_t(n));
}

}  // namespace cdca
