// SPDX-License-Identifier: BSD-3-Clause
#include "core/cells/stiffness_cache.hpp"

namespace cdca {

void add_part(const BasisContext& c, GridIndex e, int part, const PartBasis& basis, Signature& s) {
  s.add_bits(std::uint64_t(c.mesh.grid().element(e)));
  s.add_bits(std::uint64_t(part));
  const Vec2 corner(e.i, e.j);
  for (const int id : c.cuts.paths().steps_in(e)) {
    const PathStep& step = c.cuts.paths().steps()[std::size_t(id)];
    for (const Vec2& p : {Vec2(step.from - corner), Vec2(step.to - corner)})
      s.add(p.x()), s.add(p.y());
  }
  s.add(basis.tip_signature());
}

StiffnessCache::Found StiffnessCache::of(const BasisContext& context, GridIndex element, int part,
                                         const ElasticMatrix& elastic) {
  const PartBasis basis(context, element, part);
  Signature signature;
  add_part(context, element, part, basis, signature);
  Found found{{}, &matrices_.of(signature.value(), [&] {
                return std::make_unique<Eigen::MatrixXd>(
                    part_stiffness(context, element, part, elastic).matrix);
              })};
  for (const LocalId first : basis.unknowns()) {
    found.unknowns.push_back(first);
    found.unknowns.push_back(first + 1);
  }
  return found;
}

}  // namespace cdca
