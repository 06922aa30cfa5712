// SPDX-License-Identifier: BSD-3-Clause
/// Springs between the two faces of a crack (Eq. 8-9 and K^I of Eq. 14).
#pragma once

#include "core/cells/part_stiffness.hpp"

#include <array>
#include <vector>

namespace cdca {

/// A stretch of a face, as fractions of its length, with the springs on it.
struct FaceStretch {
  double from = 0.0;
  double to = 1.0;
  double normal = 0.0;      ///< Pa/m
  double tangential = 0.0;  ///< Pa/m
};

/// Who knows which springs act on a face.
class FaceSprings {
 public:
  virtual ~FaceSprings() = default;
  /// Stretches with springs; none where the faces are free.
  virtual std::vector<FaceStretch> on(const CrackFace& face) const = 0;
};

/// A face in metres, and how its springs are put to work.
///
/// A stiff spring k at every place of a cut element gives tractions that oscillate from element to
/// element. So the traction is t = (g + S s) / (1/k + S), s the mean stress of the two sides,
/// weighted by their areas, and S the compliance of a tenth of the element: it is the spring's
/// k g when both agree, and never stiffer than the element itself (Nitsche's method for compliant
/// interfaces). Its symmetric form is
///
///     a [u][v] + b (s(u) [v] + [u] s(v)) - c s(u) s(v),
///     a = 1 / (1/k + S), b = S a, c = b / k.
///
/// Stresses of near-tip functions are not square integrable: beside these only a is used, S there
/// being the compliance of a hundredth of the element.
struct FaceGeometry {
  FaceGeometry(const ElementCuts& cuts, const std::vector<TipZone>& zones, const CrackFace& face,
               const ElasticMatrix& elastic);

  Vec2 tangent, normal;  ///< of the crack's direction, and from the minus to the plus face
  double length;         ///< m
  bool near_tip;
  double compliance;  ///< S, m/Pa
  double plus_share;  ///< of the mean stress
};

/// a, b and c for a spring k > 0.
struct SpringTerms {
  SpringTerms(const FaceGeometry& face, double spring);
  double jump, mixed, stress;
};

/// A function as the face sees it: its jump, and the mean of its tractions (s n) for unit
/// displacements in x and y, Pa.
struct FaceFunction {
  LocalId unknown = 0;
  double jump = 0.0;
  Eigen::Matrix2d traction = Eigen::Matrix2d::Zero();
};

/// (s n) of a function with the given gradient, moved in x and in y.
Eigen::Matrix2d traction_of(const Vec2& gradient, const Vec2& normal, const ElasticMatrix& elastic);

/// Adds the springs at one place to a matrix over all functions, x and y of each.
void add_springs(const std::vector<FaceFunction>& functions, const FaceGeometry& face,
                 const FaceStretch& springs, double weight, Eigen::Ref<Eigen::MatrixXd> matrix);

/// Places on a stretch of a face: grid coordinates and length elements, m.
struct FacePoint {
  Vec2 at{0, 0};
  double weight = 0.0;
};

/// Three points: exact for products of jumps of bilinear functions.
std::array<FacePoint, 3> plain_points(const CrackFace& face, const FaceGeometry& geometry,
                                      double from, double to);

/// All functions on both sides of one face.
class FaceBasis {
 public:
  FaceBasis(const BasisContext& context, const CrackFace& face, const ElasticMatrix& elastic);

  const FaceGeometry& geometry() const { return geometry_; }
  /// Places on a stretch, graded towards tips.
  std::vector<FacePoint> points(double from, double to) const;
  /// An unknown on both sides is one function. Always in the same order.
  void evaluate(const Vec2& at, std::vector<FaceFunction>& functions) const;

  /// Jump and mean traction, both as (tangential, normal).
  struct Field {
    Vec2 jump{0, 0};      ///< m
    Vec2 traction{0, 0};  ///< Pa
  };
  Field field(const std::vector<FaceFunction>& functions, std::span<const double> state) const;

 private:
  CrackFace face_;
  Vec2 plus_corner_, minus_corner_;
  ElasticMatrix elastic_;
  FaceGeometry geometry_;
  PartBasis plus_, minus_;
  mutable std::vector<BasisFunction> side_;
};

/// Stiffness of the springs on a face over all unknowns of both sides.
PartStiffness face_stiffness(const BasisContext& context, const CrackFace& face,
                             const ElasticMatrix& elastic, const std::vector<FaceStretch>& springs);

}  // namespace cdca
