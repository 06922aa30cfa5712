// SPDX-License-Identifier: BSD-3-Clause
/// Gauss-Legendre points on [0, 1].
#pragma once

#include <span>

namespace cdca {

struct GaussPoint {
  double x;
  double weight;
};

/// n points, 1 <= n <= 20; exact for polynomials of degree 2n - 1.
std::span<const GaussPoint> gauss_points(int n);

}  // namespace cdca
