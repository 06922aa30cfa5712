// SPDX-License-Identifier: BSD-3-Clause
#include "core/hierarchy/window_factors.hpp"

#include "core/base/errors.hpp"

namespace cdca {

WindowFactors::Found WindowFactors::of(std::size_t size, const StiffnessEntries& entries) {
  Signature s;
  s.add_bits(size);
  for (const auto& e : entries)
    s.add_bits((std::uint64_t(std::uint32_t(e.row())) << 32) | std::uint32_t(e.col()));
  const std::uint64_t places = s.value();
  for (const auto& e : entries) s.add(e.value());
  const WindowFactor& factor = factors_.of(s.value(), [&] {
    const Eigen::VectorXi& place = orders_.of(places, [&] {
      return std::make_unique<Eigen::VectorXi>(elimination_order(size, entries));
    });
    auto made = std::make_unique<WindowFactor>();
    made->place = place;
    made->factor.compute(in_order(place, entries, true));
    if (made->factor.info() != Eigen::Success) {
      throw SolveError("the stiffness of cells near a crack could not be factored");
    }
    return made;
  });
  return {&factor, s.value()};
}

}  // namespace cdca
