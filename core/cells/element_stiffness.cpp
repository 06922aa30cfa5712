// SPDX-License-Identifier: BSD-3-Clause
#include "core/cells/element_stiffness.hpp"

#include "core/base/marked.hpp"

#include <algorithm>
#include <utility>

namespace cdca {

FinestElements::FinestElements(const BasisContext& context, const ElasticMatrix& elastic,
                               StiffnessCache& cache, const FaceSprings* springs)
    : context_(context),
      elastic_(elastic),
      cache_(cache),
      springs_(springs),
      plain_(plain_stiffness(context.mesh.grid().element_size(), elastic)),
      special_(elements_near_cracks(context.mesh, context.cuts, context.unknowns)) {}

FinestElements::Element& FinestElements::element(GridIndex e) {
  const auto [it, is_new] = known_.try_emplace(context_.mesh.grid().element(e));
  Element& element = it->second;
  if (!is_new) return element;
  for (int part = 0; part < context_.cuts.parts(e); ++part)
    element.parts.push_back(cache_.of(context_, e, part, elastic_));
  if (!springs_) return element;
  const auto faces = context_.cuts.faces_of(e);
  for (std::size_t k = 0; k < faces.size(); ++k)
    element.faces.emplace_back(context_, faces[k], elastic_, springs_->on(e, k));
  return element;
}

std::vector<PartStiffness> FinestElements::parts(GridIndex e) {
  const Element& known = element(e);
  std::vector<PartStiffness> parts;
  for (const auto& part : known.parts) parts.push_back({part.unknowns, *part.matrix});
  return parts;
}

std::vector<const PartStiffness*> FinestElements::faces(GridIndex e) {
  std::vector<const PartStiffness*> faces;
  if (!springs_ || !context_.cuts.touched(e)) return faces;
  Element& known = element(e);
  for (std::size_t k = 0; k < known.faces.size(); ++k) {
    const PartStiffness& face = known.faces[k].stiffness(springs_->on(e, k));
    if (!face.unknowns.empty()) faces.push_back(&face);
  }
  return faces;
}

std::vector<GlobalId> elements_near_cracks(const LocalMesh& mesh, const ElementParts& elements,
                                           const CellUnknowns& unknowns) {
  std::vector<char> near(std::size_t(mesh.element_count()), 0);
  const auto add = [&](GridIndex e) {
    const LocalId found = mesh.find_element(e);
    if (found >= 0) near[std::size_t(found)] = 1;
  };
  for (const GlobalId id : elements.touched_elements()) add(mesh.grid().element_index(id));
  for (const LocalId n : unknowns.special_nodes()) {
    for (const GridIndex e : mesh.grid().elements_round(mesh.node(n))) add(e);
  }
  std::vector<GlobalId> found;
  for (const LocalId e : marked(near)) found.push_back(mesh.grid().element(mesh.element(e)));
  return found;
}

}  // namespace cdca
