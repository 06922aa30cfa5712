// SPDX-License-Identifier: BSD-3-Clause
#include "core/cells/element_stiffness.hpp"

#include <algorithm>

namespace cdca {

FinestElements::FinestElements(const BasisContext& context, const ElasticMatrix& elastic,
                               StiffnessCache& cache, const FaceSprings* springs)
    : context_(context),
      elastic_(elastic),
      cache_(cache),
      springs_(springs),
      plain_(plain_stiffness(context.mesh.grid().element_size(), elastic)),
      special_(elements_near_cracks(context.mesh, context.cuts, context.unknowns)) {}

std::vector<PartStiffness> FinestElements::parts(GridIndex element) {
  std::vector<PartStiffness> parts;
  for (int part = 0; part < context_.cuts.parts(element); ++part) {
    parts.push_back(cache_.of(context_, element, part, elastic_));
  }
  if (springs_) {
    const auto faces = context_.cuts.faces_of(element);
    for (std::size_t k = 0; k < faces.size(); ++k) {
      const auto stretches = springs_->on(element, k);
      if (!stretches.empty())
        parts.push_back(face_stiffness(context_, faces[k], elastic_, stretches));
    }
  }
  return parts;
}

std::vector<GlobalId> elements_near_cracks(const LocalMesh& mesh, const ElementParts& elements,
                                           const CellUnknowns& unknowns) {
  std::vector<GlobalId> found;
  for (const GlobalId id : elements.touched_elements()) {
    if (mesh.find_element(mesh.grid().element_index(id)) >= 0) found.push_back(id);
  }
  for (const LocalId n : unknowns.special_nodes()) {
    for (const GridIndex e : mesh.grid().elements_round(mesh.node(n))) {
      if (mesh.find_element(e) >= 0) found.push_back(mesh.grid().element(e));
    }
  }
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

}  // namespace cdca
