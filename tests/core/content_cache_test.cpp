// SPDX-License-Identifier: BSD-3-Clause
/// Values found again by what they were made from.
#include "core/base/content_cache.hpp"

#include "core/simulation/equilibrium.hpp"
#include "tests/cracked_plates.hpp"

#include <gtest/gtest.h>

namespace cdca::testing {
namespace {

std::uint64_t signature_of(std::initializer_list<double> values) {
  Signature s;
  for (const double value : values) s.add(value);
  return s.value();
}

TEST(ContentCache, SignaturesTellValuesApart) {
  EXPECT_EQ(signature_of({1, 2}), signature_of({1, 2}));
  EXPECT_NE(signature_of({1, 2}), signature_of({2, 1}));
  EXPECT_NE(signature_of({0.0}), signature_of({-0.0})) << "bit for bit";
  EXPECT_NE(signature_of({0}), signature_of({0, 0}));
}

TEST(ContentCache, ForgetsWhatNobodyAsksFor) {
  for (const int kept : {1, 3}) {
    ContentCache<int> cache(kept);
    int made = 0;
    const auto ask = [&](std::uint64_t key) {
      return cache.of(key, [&] { return std::make_unique<int>(++made); });
    };
    EXPECT_EQ(ask(7), 1);
    EXPECT_EQ(ask(7), 1);
    EXPECT_EQ(cache.made(), 1);
    EXPECT_EQ(cache.reused(), 0) << "in the cycle in which it was made";
    for (int cycle = 0; cycle < kept; ++cycle) cache.begin_cycle();
    EXPECT_EQ(ask(7), 1);
    EXPECT_EQ(ask(8), 2);
    EXPECT_EQ(cache.made(), 1);
    EXPECT_EQ(cache.reused(), 1);
    for (int cycle = 0; cycle <= kept; ++cycle) cache.begin_cycle();
    EXPECT_EQ(ask(7), 3);
  }
}

/// Weights of K found again after growth are those that would be made anew.
TEST(ContentCache, IntensitiesAfterGrowthAsWithoutIt) {
  const Solved s = solved(plate_of(20, 40, three_cracks()));
  Model& model = *s.model;
  model.stress_intensities(1.0);
  CrackRegistry registry = model.registry();
  const Crack& crack = registry.cracks()[0];
  const Vec2 further = crack.end_point(1) + 0.04 * crack.end_tangent(1);
  registry.advance(0, 1, further, TipState::active, -1, {1, 0});
  model.lay_cracks(registry);
  find_equilibrium(model, *make_solver(model), 1.0);
  IntensityCache anew;
  const auto expected =
      stress_intensities(model.basis(), model.registry().cracks(), model.material(),
                         model.loads(1.0), model.state(), model.communicator(), anew);
  const auto found = model.stress_intensities(1.0);
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t k = 0; k < found.size(); ++k) {
    EXPECT_EQ(found[k].k1, expected[k].k1);
    EXPECT_EQ(found[k].k2, expected[k].k2);
  }
}

}  // namespace
}  // namespace cdca::testing
