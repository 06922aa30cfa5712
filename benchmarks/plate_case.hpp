// SPDX-License-Identifier: BSD-3-Clause
/// The plates that are timed, and how runs are timed.
#pragma once

#include "core/simulation/case_spec.hpp"

#include <vector>

namespace cdca::benchmarks {

/// A plate 1 m wide and 2 m high of nx x 2 nx elements, pulled by 1 mm between its lower and its
/// upper side; plane strain. cracks: 1, 3, or any number of short cracks at random places.
CaseSpec plate_in_tension(int nx, int cracks);

double median(std::vector<double> values);

/// Bandwidth of z = y + a x over vectors of this length, bytes/s: the best of several runs.
double triad_bandwidth(std::size_t length);

}  // namespace cdca::benchmarks
