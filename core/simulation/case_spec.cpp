// SPDX-License-Identifier: BSD-3-Clause
#include "core/simulation/case_spec.hpp"

namespace cdca {

double length_of(const CrackSpec& crack) {
  double length = 0.0;
  for (std::size_t i = 0; i + 1 < crack.points.size(); ++i)
    length += (crack.points[i + 1] - crack.points[i]).norm();
  return length;
}

LoadValue proportional_load(double value) {
  LoadValue load;
  load.at = [value](double, double, double s) { return value * s; };
  load.text = std::to_string(value);
  return load;
}

}  // namespace cdca
