// SPDX-License-Identifier: BSD-3-Clause
/// The stiffness of the elements of one scale, as cells add it up.
#pragma once

#include "core/cells/face_stiffness.hpp"
#include "core/cells/stiffness_cache.hpp"

#include <unordered_map>
#include <vector>

namespace cdca {

/// Of an element without cracks; nodes counter-clockwise from the lower left, x and y of each.
using PlainStiffness = Eigen::Matrix<double, 8, 8>;

class ElementStiffness {
 public:
  virtual ~ElementStiffness() = default;
  /// Of all elements that are not special.
  virtual const PlainStiffness& plain() const = 0;
  /// Elements of this rank that are cut, or carry near-tip functions, or touch cells with several
  /// pieces, or are not whole; in order of id.
  virtual const std::vector<GlobalId>& special() const = 0;
  /// Of a special element, one matrix for each part.
  virtual std::vector<PartStiffness> parts(GridIndex element) = 0;
  /// Springs of a special element, one matrix for each face that it counts as its own. They may
  /// turn while cracks stay as they are; the unknowns are the same then. Good until the next call.
  virtual std::vector<const PartStiffness*> faces(GridIndex element) = 0;
};

/// The elements of the grid itself, as long as the cracks stay as they are; springs may change.
class FinestElements final : public ElementStiffness {
 public:
  /// springs: between touching faces; null for none.
  FinestElements(const BasisContext& context, const ElasticMatrix& elastic, StiffnessCache& cache,
                 const FaceSprings* springs);
  const PlainStiffness& plain() const override { return plain_; }
  const std::vector<GlobalId>& special() const override { return special_; }
  std::vector<PartStiffness> parts(GridIndex element) override;
  std::vector<const PartStiffness*> faces(GridIndex element) override;

 private:
  struct Element {
    std::vector<StiffnessCache::Found> parts;
    std::vector<FaceSpots> faces;
  };
  Element& element(GridIndex e);

  std::unordered_map<GlobalId, Element> known_;
  BasisContext context_;
  ElasticMatrix elastic_;
  StiffnessCache& cache_;
  const FaceSprings* springs_;
  PlainStiffness plain_;
  std::vector<GlobalId> special_;
};

/// Elements of a rank that cracks touch or that have a cell with more than its two plain unknowns;
/// in order of id.
std::vector<GlobalId> elements_near_cracks(const LocalMesh& mesh, const ElementParts& elements,
                                           const CellUnknowns& unknowns);

}  // namespace cdca
