// SPDX-License-Identifier: BSD-3-Clause
/// Factors of the stiffness of windows, kept from one growth cycle to the next.
#pragma once

#include "core/base/content_cache.hpp"
#include "core/hierarchy/elimination_order.hpp"

namespace cdca {

/// The factor of a window's stiffness, and where in it every unknown of the window stands.
struct WindowFactor {
  Eigen::VectorXi place;
  OrderedFactor factor;
};

/// Factors kept from one growth cycle to the next: a window whose stiffness is bit for bit the same
/// needs no new one, and one with entries at the same places no new order of elimination.
class WindowFactors {
 public:
  void begin_cycle() {
    factors_.begin_cycle();
    orders_.begin_cycle();
  }
  struct Found {
    const WindowFactor* factor = nullptr;
    std::uint64_t signature = 0;
  };
  /// entries: both triangles of the stiffness of a window of so many unknowns.
  Found of(std::size_t size, const StiffnessEntries& entries);
  void keep(const Found& found) { factors_.keep(found.signature); }
  std::int64_t made() const { return factors_.made(); }
  std::int64_t reused() const { return factors_.reused(); }

 private:
  ContentCache<WindowFactor> factors_;
  ContentCache<Eigen::VectorXi> orders_;
};

}  // namespace cdca
