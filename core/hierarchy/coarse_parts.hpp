// SPDX-License-Identifier: BSD-3-Clause
/// The parts of elements on every scale: a coarse element is cut by the cracks just as a fine one.
#pragma once

#include "core/cells/element_cuts.hpp"
#include "core/cells/element_stiffness.hpp"
#include "core/hierarchy/bonds.hpp"

#include <unordered_map>
#include <unordered_set>

namespace cdca {

/// The parts of the elements of one scale, with the stiffness of bilinear functions on each.
class ScaleParts : public ElementParts {
 public:
  virtual PlainStiffness stiffness(GridIndex element, int part) const = 0;
  /// Springs between touching faces.
  const std::vector<Bond>& bonds() const { return bonds_; }

 protected:
  std::vector<Bond> bonds_;
};

/// The scale of the grid itself.
class FinestParts final : public ScaleParts {
 public:
  /// springs: null when no faces touch.
  FinestParts(const ElementCuts& cuts, const ElasticMatrix& elastic, const FaceSprings* springs)
      : cuts_(cuts), elastic_(elastic) {
    if (springs) bonds_ = finest_bonds(cuts, elastic, *springs);
  }
  const StructuredGrid& grid() const override { return cuts_.grid(); }
  const std::vector<GlobalId>& touched_elements() const override {
    return cuts_.touched_elements();
  }
  bool touched(GridIndex e) const override { return cuts_.touched(e); }
  int parts(GridIndex e) const override { return cuts_.parts(e); }
  const std::vector<SidePortion>& side(GridIndex e, std::size_t side) const override {
    return cuts_.side(e, side);
  }
  PlainStiffness stiffness(GridIndex element, int part) const override;

 private:
  const ElementCuts& cuts_;
  ElasticMatrix elastic_;
};

/// Elements twice as large as those of `finer`: their parts are the connected components of their
/// children's parts, their stiffness is the sum of P^T K P over the children. Worked out from the
/// cracks wherever it is asked for, the same on every rank.
class CoarseParts final : public ScaleParts {
 public:
  /// level: 1 for the first scale above the grid. body: elements of the grid itself.
  CoarseParts(const ScaleParts& finer, int level, GridIndex body, const ElasticMatrix& elastic);
  /// Takes the elements of before the cracks grew but for those that have changed.
  void take_over(CoarseParts& before, const std::vector<GlobalId>& changed);

  const StructuredGrid& grid() const override { return grid_; }
  const std::vector<GlobalId>& touched_elements() const override { return touched_; }
  bool touched(GridIndex e) const override;
  int parts(GridIndex e) const override {
    const Element* element = find(e);
    return element ? element->parts : 1;
  }
  const std::vector<SidePortion>& side(GridIndex e, std::size_t side) const override;
  PlainStiffness stiffness(GridIndex element, int part) const override;

  /// The part of a coarse element that holds a part of one of its children.
  int part_of(GridIndex child, int part) const;
  /// Does the element reach beyond the rim?
  bool over_the_rim(GridIndex e) const { return inside(e).minCoeff() < 1.0; }
  const PlainStiffness& plain() const { return plain_; }
  /// The stiffness of all kinds of elements without cracks: within the body, and over its rim.
  std::vector<PlainStiffness> whole_elements() const;

 private:
  /// Of an element without cracks.
  PlainStiffness whole(GridIndex e) const;
  struct Element {
    int parts = 0;
    std::array<std::vector<int>, 4> part_of_child;
    std::array<std::vector<SidePortion>, 4> sides;
    std::vector<PlainStiffness> stiffness;
  };
  /// Null where no crack touches the element.
  const Element* find(GridIndex e) const;
  Element make_element(GridIndex e) const;
  void make_sides(GridIndex e, Element& element) const;
  void join_bonds();
  /// The share of the element's width and height that lies in the body.
  Vec2 inside(GridIndex e) const;

  const ScaleParts& finer_;
  StructuredGrid grid_;
  int stride_;      ///< elements of the grid itself across one of these
  GridIndex body_;  ///< elements of the grid itself
  ElasticMatrix elastic_;
  PlainStiffness plain_;
  std::vector<GlobalId> touched_;
  std::unordered_set<GlobalId> is_touched_;
  mutable std::unordered_map<GlobalId, Element> cache_;
};

/// The elements of a coarse scale as cells add them up.
class CoarseElements final : public ElementStiffness {
 public:
  CoarseElements(const LocalMesh& mesh, const CellUnknowns& unknowns, const CoarseParts& parts);
  const PlainStiffness& plain() const override { return parts_.plain(); }
  const std::vector<GlobalId>& special() const override { return special_; }
  std::vector<PartStiffness> parts(GridIndex element) override;
  std::vector<const PartStiffness*> faces(GridIndex element) override;

 private:
  const LocalMesh& mesh_;
  const CellUnknowns& unknowns_;
  const CoarseParts& parts_;
  std::vector<GlobalId> special_;
  std::unordered_map<GlobalId, std::vector<std::size_t>> bonds_at_;  ///< by the plus element
  std::vector<PartStiffness> faces_;  ///< of the element last asked for
};

/// Displacements of a child's corners from those of the coarse element, x and y of each; (cx, cy)
/// is the child's place, 0 or 1.
PlainStiffness child_interpolation(int cx, int cy);

}  // namespace cdca
