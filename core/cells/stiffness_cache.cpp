// SPDX-License-Identifier: BSD-3-Clause
#include "core/cells/stiffness_cache.hpp"

#include <cstring>

namespace cdca {

namespace {

/// FNV-1a over the bits of everything that the matrix depends on.
class Signature {
 public:
  void add(double value) {
    std::uint64_t bits = 0;
    std::memcpy(&bits, &value, sizeof bits);
    add_bits(bits);
  }
  void add_bits(std::uint64_t bits) {
    for (int k = 0; k < 8; ++k) hash_ = (hash_ ^ ((bits >> (8 * k)) & 0xff)) * 1099511628211ULL;
  }
  std::uint64_t value() const { return hash_; }

 private:
  std::uint64_t hash_ = 1469598103934665603ULL;
};

std::uint64_t signature_of(const BasisContext& c, GridIndex e, int part, const PartBasis& basis) {
  Signature s;
  s.add_bits(std::uint64_t(c.mesh.grid().element(e)));
  s.add_bits(std::uint64_t(part));
  const Vec2 corner(e.i, e.j);
  for (const int id : c.cuts.paths().steps_in(e)) {
    const PathStep& step = c.cuts.paths().steps()[std::size_t(id)];
    for (const Vec2& p : {Vec2(step.from - corner), Vec2(step.to - corner)})
      s.add(p.x()), s.add(p.y());
  }
  for (const double v : basis.tip_signature()) s.add(v);
  return s.value();
}

}  // namespace

void StiffnessCache::begin_cycle() {
  before_ = std::move(now_);
  now_.clear();
  integrated_ = reused_ = 0;
}

PartStiffness StiffnessCache::of(const BasisContext& context, GridIndex element, int part,
                                 const ElasticMatrix& elastic) {
  const PartBasis basis(context, element, part);
  const std::uint64_t key = signature_of(context, element, part, basis);
  if (const auto it = before_.find(key); it != before_.end()) {
    ++reused_;
    now_[key] = it->second;
    PartStiffness found;
    for (const LocalId first : basis.unknowns()) {
      found.unknowns.push_back(first);
      found.unknowns.push_back(first + 1);
    }
    found.matrix = it->second;
    return found;
  }
  ++integrated_;
  PartStiffness made = part_stiffness(context, element, part, elastic);
  now_[key] = made.matrix;
  return made;
}

}  // namespace cdca
