// SPDX-License-Identifier: BSD-3-Clause
#include "core/base/communicator.hpp"

namespace cdca {

double Communicator::sum(double value) {
  sum(std::span<double>(&value, 1));
  return value;
}

std::int64_t Communicator::sum(std::int64_t value) {
  sum(std::span<std::int64_t>(&value, 1));
  return value;
}

double Communicator::max(double value) {
  max(std::span<double>(&value, 1));
  return value;
}

double Communicator::min(double value) {
  min(std::span<double>(&value, 1));
  return value;
}

}  // namespace cdca
