// SPDX-License-Identifier: BSD-3-Clause
/// The displacement functions that act on one part of one element.
#pragma once

#include "core/cells/cell_unknowns.hpp"
#include "core/cells/element_cuts.hpp"
#include "core/cells/tip_quadrature.hpp"
#include "core/cells/tip_zone.hpp"
#include "core/mesh/local_mesh.hpp"

#include <array>
#include <vector>

namespace cdca {

/// One scalar function; it carries the unknowns `unknown` and `unknown + 1`.
struct BasisFunction {
  LocalId unknown = 0;
  double value = 0.0;
  Vec2 gradient{0, 0};  ///< 1/m
  /// Columns: which way the two unknowns move. Null: x and y.
  const Eigen::Matrix2d* directions = nullptr;

  Vec2 moved(const Vec2& unknowns) const {
    return directions ? Vec2(*directions * unknowns) : unknowns;
  }
  /// What a force in x and y is to the two unknowns.
  Vec2 along(const Vec2& force) const {
    return directions ? Vec2(directions->transpose() * force) : force;
  }
  Eigen::Matrix2d columns() const {
    return directions ? *directions : Eigen::Matrix2d(Eigen::Matrix2d::Identity());
  }
};

/// What the basis needs to know; borrowed.
struct BasisContext {
  const LocalMesh& mesh;
  const ElementCuts& cuts;
  const std::vector<TipZone>& zones;
  const CellUnknowns& unknowns;
};

/// The four functions of Eq. 5 at a node as a piece of its cell takes them: F_l(x_i) below.
struct TipAtNode {
  FaceSide side;                 ///< of the piece
  std::array<double, 4> values;  ///< as seen from there, m^1/2
};
/// The cell must have that piece and functions of the zone.
TipAtNode tip_at_node(const BasisContext& context, const TipZone& zone, LocalId node, int piece);

/// u^h = sum over cells of N_i chi_(i,p) v_(i,p) + N_i (F_l - F_l(x_i)) b_(i,l) on one part (Eq.
/// 4-5, in the basis of pieces). Of b the unknowns are the coefficients of functions that are
/// orthonormal in the cell; cells with mode functions have b = sum over modes of V_l k_i. A
/// piece on one side of the crack takes F_l(x_i) as continued from there: else the functions would
/// be nearly a multiple of N_i chi_(i,p) on the side where the node is not.
class PartBasis {
 public:
  PartBasis(const BasisContext& context, GridIndex element, int part);

  bool has_tip_functions() const { return !tips_.empty(); }
  /// First unknowns of all functions, each once, in the order in which evaluate() lists them.
  std::vector<LocalId> unknowns() const;
  /// p: inside the element, [0, 1]. For a point on a crack, `inside` is a place near it that tells
  /// which face is meant. Functions of cells that this rank does not hold are left out; they vanish
  /// on the side that the element shares with one of this rank's.
  void evaluate(const Vec2& p, std::vector<BasisFunction>& functions,
                const Vec2* inside = nullptr) const;
  /// Their gradients alone, 1/m, in the same order: x and y have room for those of all functions.
  void evaluate_gradients(const Vec2& p, double* x, double* y) const;
  /// Numbers that tell near-tip functions apart: which corners carry them, and their crack's path.
  std::vector<double> tip_signature() const;
  /// Tips whose functions act here, inside-the-element coordinates, with the bends that quadrature
  /// has to follow.
  std::vector<SingularPlace> tip_places() const;

 private:
  struct TipShape {
    std::size_t corner;
    const TipZone* zone;
    const TipUnknowns* unknowns;
    TipAtNode at_node;
  };
  /// Calls visit(unknown, value, gradient, directions) for every function.
  template <class Visit>
  void for_each_function(const Vec2& p, const Vec2* inside, const Visit& visit) const;
  Vec2 position(const Vec2& p) const;
  /// Slivers take the field across the crack: from there they are looked at.
  const Vec2* seen_from(const Vec2& p, const Vec2* inside) const;

  Vec2 corner_;                    ///< m
  Vec2 size_;                      ///< m
  std::array<LocalId, 4> pieces_;  ///< -1: not held by this rank
  std::vector<TipShape> tips_;
  std::vector<const ElementPolygon*> slivers_;  ///< of this part
};

/// Displacement and its gradient at a place.
struct FieldValue {
  Vec2 displacement{0, 0};                             ///< m
  Eigen::Matrix2d gradient = Eigen::Matrix2d::Zero();  ///< gradient(i, j) = d u_i / d x_j
};

/// Sums the functions with the values in `state`.
FieldValue field_value(const std::vector<BasisFunction>& functions, std::span<const double> state);

}  // namespace cdca
