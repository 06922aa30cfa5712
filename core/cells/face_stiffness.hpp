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

  bool operator==(const FaceStretch&) const = default;
};

/// Who knows which springs act on a face.
class FaceSprings {
 public:
  virtual ~FaceSprings() = default;
  /// Of a face as ElementCuts::faces_of() lists it: stretches with their springs, which may be 0;
  /// none for faces that never touch.
  virtual std::vector<FaceStretch> on(GridIndex element, std::size_t face) const = 0;
};

/// A face in metres, and how its springs are put to work.
///
/// Springs act on the mean jump over a face, that is, over the crack inside one element. A stiff
/// spring k gives tractions that oscillate from element to element even so. Therefore the traction
/// is t = (g + S s) / (1/k + S), s the mean stress of the two sides, weighted by their areas, and S
/// the compliance of a fifth of the element: it is the spring's k g when both agree, and never
/// stiffer than the element itself (Nitsche's method for compliant interfaces). It is the
/// stationary point in t of
///
///     t (g + S s) - (1/k + S) t^2 / 2 - S s^2 / 2.
///
/// With the spring, t drops out and leaves the form
///
///     a [u][v] + b (s(u) [v] + [u] s(v)) - c s(u) s(v),   a = 1 / (1/k + S), b = S a, c = b / k;
///
/// with a given traction t (0 on open faces) a = b = 0, c = S, and t ([v] + S s(v)) is a load. Both
/// meet without a jump where one takes over from the other. The form stays positive as long as S is
/// small enough.
///
/// Among near-tip functions S is a tenth of that, and shrinks with the distance from the tip, so
/// that the squares of the singular stresses stay bounded. Stresses beyond a grid line reach
/// farther than the neighbour cells: along grid lines S is 0, and the springs stand at the nodes
/// there, so that no tractions oscillate either.
struct FaceGeometry {
  FaceGeometry(const ElementCuts& cuts, const CrackFace& face, const ElasticMatrix& elastic);

  Vec2 tangent, normal;  ///< of the crack's direction, and from the minus to the plus face
  double length;         ///< m
  bool uses_stress;      ///< not along a grid line
  double depth;          ///< m, of the material that the springs see
  double compliance;     ///< S away from tips, m/Pa
  double plus_share;     ///< of the mean stress
};

/// The functions of two unknowns as a spot of a face sees them. Columns are for a unit of the first
/// and of the second.
struct FaceFunction {
  LocalId unknown = 0;
  Eigen::Matrix2d jump = Eigen::Matrix2d::Zero();
  Eigen::Matrix2d traction = Eigen::Matrix2d::Zero();  ///< mean of (s n), Pa
};

/// Where a spring acts: the means over a stretch of a face, or a node on a grid line.
struct FaceSpot {
  double weight = 0.0;      ///< length, m
  double compliance = 0.0;  ///< S, m/Pa
  std::vector<FaceFunction> functions;

  /// Jump (m) and mean traction (Pa), both as (tangential, normal).
  struct Field {
    Vec2 jump{0, 0};
    Vec2 traction{0, 0};
  };
  Field field(const FaceGeometry& face, std::span<const double> state) const;
};

/// a, b and c for a spring k, or without one (k = 0).
struct SpringTerms {
  SpringTerms(const FaceGeometry& face, double compliance, double spring);
  double jump = 0.0, mixed = 0.0, stress = 0.0;
};

/// (s n) of a function with the given gradient, moved in x and in y.
Eigen::Matrix2d traction_of(const Vec2& gradient, const Vec2& normal, const ElasticMatrix& elastic);

/// The springs at a spot as matrices over all of its functions, x and y of each.
class SpotForms {
 public:
  SpotForms(const FaceSpot& spot, const FaceGeometry& face);
  void add_springs(const FaceStretch& springs, Eigen::Ref<Eigen::MatrixXd> matrix) const;

 private:
  FaceGeometry face_;
  double weight_, compliance_;
  /// What 1 m of every unknown does to the jump and to the mean stress across the face, then to
  /// both along it.
  Eigen::MatrixX4d effects_;
};

/// A place on a face: grid coordinates and length element, m.
struct FacePoint {
  Vec2 at{0, 0};
  double weight = 0.0;
};

/// The points whose mean a spot is: two, exact for jumps of bilinear functions, or on a grid line
/// the nearer end of the face.
std::vector<FacePoint> plain_points(const CrackFace& face, const FaceGeometry& geometry,
                                    double from, double to);

/// All functions on both sides of one face.
class FaceBasis {
 public:
  FaceBasis(const BasisContext& context, const CrackFace& face, const ElasticMatrix& elastic);

  const FaceGeometry& geometry() const { return geometry_; }
  /// On a stretch of the face; near tips the means are over points graded towards them. An unknown
  /// on both sides is one function; all spots have the same functions in the same order.
  FaceSpot spot(double from, double to) const;

 private:
  std::vector<FacePoint> points(double from, double to,
                                const std::vector<SingularPlace>& tips) const;
  std::vector<SingularPlace> tip_places() const;
  void add_functions(const FacePoint& point, double share, FaceSpot& spot) const;
  /// S shrinks with the distance from the tips.
  double compliance_at(const Vec2& at, const std::vector<SingularPlace>& tips) const;

  CrackFace face_;
  Vec2 size_;  ///< of the elements, m
  Vec2 plus_corner_, minus_corner_;
  ElasticMatrix elastic_;
  FaceGeometry geometry_;
  PartBasis plus_, minus_;
  mutable std::vector<BasisFunction> side_;
};

/// The spots of a face's stretches, ready for any springs.
class FaceSpots {
 public:
  FaceSpots(const BasisContext& context, const CrackFace& face, const ElasticMatrix& elastic,
            const std::vector<FaceStretch>& stretches);
  /// Stiffness of springs on the same stretches, over all unknowns of both sides. Made anew only
  /// where it is not that of the last time.
  const PartStiffness& stiffness(const std::vector<FaceStretch>& springs);

 private:
  std::vector<SpotForms> forms_;
  std::vector<FaceStretch> springs_;  ///< that the stiffness counts
  PartStiffness stiffness_;
};

}  // namespace cdca
