// SPDX-License-Identifier: BSD-3-Clause
#include "core/simulation/case_spec.hpp"

namespace cdca {

LoadValue proportional_load(double value) {
  LoadValue load;
  load.at = [value](double, double, double s) { return value * s; };
  load.text = std::to_string(value);
  return load;
}

}  // namespace cdca
