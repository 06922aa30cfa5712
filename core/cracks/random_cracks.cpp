// SPDX-License-Identifier: BSD-3-Clause
#include "core/cracks/random_cracks.hpp"

#include "core/base/errors.hpp"

#include <cmath>
#include <numbers>
#include <random>

namespace cdca {

std::vector<std::array<Vec2, 2>> random_cracks(const CrackFieldSpec& spec) {
  std::mt19937_64 engine(spec.seed);
  // the engine is the same everywhere, the library's distributions are not
  const auto uniform = [&engine](double low, double high) {
    return low + (high - low) * double(engine() >> 11) / 9007199254740992.0;
  };
  std::vector<std::array<Vec2, 2>> cracks;
  for (int tries = 0; int(cracks.size()) < spec.count; ++tries) {
    if (tries > 1000 * (spec.count + 10)) {
      throw InputError(0, "crack_field.length",
                       "cracks of this length hardly fit into crack_field.region; make them "
                       "shorter or the region larger.");
    }
    const Vec2 centre(uniform(spec.region.lower.x(), spec.region.upper.x()),
                      uniform(spec.region.lower.y(), spec.region.upper.y()));
    const double length = uniform(spec.length[0], spec.length[1]);
    const double angle = uniform(spec.angle[0], spec.angle[1]) * std::numbers::pi / 180;
    const Vec2 half = 0.5 * length * Vec2(std::cos(angle), std::sin(angle));
    const Vec2 a = centre - half, b = centre + half;
    const bool inside = (a.cwiseMin(b).array() >= spec.region.lower.array()).all() &&
                        (a.cwiseMax(b).array() <= spec.region.upper.array()).all();
    if (inside) cracks.push_back({a, b});
  }
  return cracks;
}

}  // namespace cdca
