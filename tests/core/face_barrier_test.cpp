// SPDX-License-Identifier: BSD-3-Clause
/// Faces of a small body of springs come to balance where body and laws agree.
#include "core/mechanics/face_barrier.hpp"

#include "core/mechanics/held_faces.hpp"
#include "core/simulation/model.hpp"
#include "tests/plates.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace cdca::testing {
namespace {

constexpr double body = 10.0;  ///< stiffness of a face of the body alone, Pa/m
constexpr double stiff = 1e4;  ///< of touching faces
constexpr double friction = 0.5;

/// The patches of one crack, to be balanced without their plate.
ContactPatches patches_of(const ContactSpec& law) {
  CaseSpec spec = plate({0, 0}, {1, 1}, 8, 8);
  add_crack(spec, {{0.13, 0.21}, {0.91, 0.83}});
  spec.cracks.back().contact = law;
  pull(spec, {0, 1, 0});
  const Model model(spec, world(), world_partitioner());
  return model.contact();
}

/// A chain of faces, each pulled with its own force; neighbours hold each other.
struct Chain {
  Eigen::MatrixXd stiffness;
  Eigen::VectorXd forces;

  explicit Chain(std::size_t faces, double phase) {
    const auto n = Eigen::Index(faces);
    stiffness = 2 * body * Eigen::MatrixXd::Identity(n, n);
    forces.resize(n);
    for (Eigen::Index k = 0; k < n; ++k) {
      forces[k] = std::sin(1.7 * double(k) + phase);
      if (k > 0) stiffness(k, k - 1) = stiffness(k - 1, k) = -0.95 * body;
    }
  }
  /// Gaps with springs against these zeros.
  Eigen::VectorXd gaps(const Eigen::VectorXd& springs, const Eigen::VectorXd& zeros) const {
    const Eigen::MatrixXd held = stiffness + Eigen::MatrixXd(springs.asDiagonal());
    return held.ldlt().solve(forces + springs.cwiseProduct(zeros));
  }
};

struct Balance {
  std::vector<ContactGap> gaps;
  double unbalanced = 1.0;
  int steps = 0;
};

Balance balance(const ContactPatches& patches, const Chain& across, const Chain& along) {
  const std::size_t n = patches.patches().size();
  FaceBarrier faces(patches, std::vector<double>(n, 0.0), std::vector<ContactGap>(n), 1 / body);
  const HeldFaces held(patches, std::vector<double>(n, 0.0), 1 / body,
                       FrictionLimits::follow_pressures);
  std::vector<ContactGap> there(n);
  const auto solve = [&](const std::vector<ContactAnswer>& answers) {
    Eigen::MatrixXd springs(Eigen::Index(n), 2), zeros = springs;
    for (std::size_t k = 0; k < n; ++k) {
      const auto row = Eigen::Index(k);
      springs.row(row) << answers[k].normal_spring, answers[k].tangential_spring;
      zeros.row(row) << answers[k].normal_zero, answers[k].tangential_zero;
    }
    const auto normal = across.gaps(springs.col(0), zeros.col(0));
    const auto tangential = along.gaps(springs.col(1), zeros.col(1));
    for (std::size_t k = 0; k < n; ++k)
      there[k] = {normal[Eigen::Index(k)], tangential[Eigen::Index(k)]};
    return there;
  };
  Balance found;
  found.gaps.resize(n);
  for (; found.unbalanced > 1e-11 && found.steps < 100; ++found.steps) {
    const double share = faces.step(solve, 1e-12);
    for (std::size_t k = 0; k < n; ++k) {
      const auto go = [share](double& from, double to) { from += share * (to - from); };
      go(found.gaps[k].normal, there[k].normal);
      go(found.gaps[k].tangential, there[k].tangential);
    }
    found.unbalanced = held.unbalanced(faces.tractions(), found.gaps);
  }
  return found;
}

/// Forces of the body less those of the faces, by their laws.
double left_over(const Chain& chain, const std::vector<double>& gaps,
                 const std::vector<double>& tractions) {
  const auto n = Eigen::Index(gaps.size());
  const Eigen::Map<const Eigen::VectorXd> g(gaps.data(), n), t(tractions.data(), n);
  return (chain.stiffness * g + t - chain.forces).lpNorm<Eigen::Infinity>();
}

void expect_balance(const ContactSpec& law) {
  const ContactPatches patches = patches_of(law);
  const std::size_t n = patches.patches().size();
  ASSERT_GT(n, 8u);
  const Chain across(n, 0.3), along(n, 1.1);
  const Balance found = balance(patches, across, along);
  std::cout << n << " faces, " << found.steps << " steps\n";
  EXPECT_LT(found.steps, 40);
  std::vector<double> normal, tangential, pressure, shear;
  int open = 0, sliding = 0;
  for (std::size_t k = 0; k < n; ++k) {
    const ContactGap& gap = found.gaps[k];
    normal.push_back(gap.normal);
    tangential.push_back(gap.tangential);
    pressure.push_back(std::min(0.0, law.normal_stiffness * gap.normal));
    const double limit = -law.friction * pressure.back();
    shear.push_back(std::clamp(law.tangential_stiffness * gap.tangential, -limit, limit));
    open += gap.normal > 0.0;
    sliding += limit > 0.0 && std::abs(shear.back()) == limit;
  }
  EXPECT_GT(open, 0);
  EXPECT_LT(open, int(n)) << "some faces are to touch";
  EXPECT_LT(left_over(across, normal, pressure), 1e-8);
  if (law.law != ContactLaw::coulomb) return;
  EXPECT_GT(sliding, 0);
  EXPECT_LT(left_over(along, tangential, shear), 1e-8);
}

TEST(FaceBarrier, FrictionlessFacesComeToBalance) {
  expect_balance({ContactLaw::frictionless, stiff, 0, 0, 0, 0, 0});
}

TEST(FaceBarrier, FacesThatSlideKeepToTheirLimits) {
  expect_balance({ContactLaw::coulomb, stiff, 0.1 * stiff, friction, 0, 0, 0});
}

/// Nothing presses in the end, so that tractions cannot be measured by the largest of them.
TEST(FaceBarrier, FacesThatAllOpenAreInBalance) {
  const ContactPatches patches = patches_of({ContactLaw::frictionless, stiff, 0, 0, 0, 0, 0});
  const std::size_t n = patches.patches().size();
  Chain across(n, 0.3);
  across.forces.setOnes();
  const Balance found = balance(patches, across, Chain(n, 1.1));
  EXPECT_LT(found.steps, 40);
  const Eigen::VectorXd open = across.stiffness.ldlt().solve(across.forces);
  for (std::size_t k = 0; k < n; ++k)
    EXPECT_NEAR(found.gaps[k].normal, open[Eigen::Index(k)], 1e-8 * open.maxCoeff());
}

}  // namespace
}  // namespace cdca::testing
