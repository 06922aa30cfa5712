// SPDX-License-Identifier: BSD-3-Clause
/// A run that is left and taken up again, on as many ranks or others, ends as one that is not.
#include "core/base/errors.hpp"
#include "core/simulation/simulation.hpp"
#include "tests/plates.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace cdca::testing {
namespace {

constexpr double h = 0.05;

/// Two cracks in tension that grow in several steps and meet.
CaseSpec growing_cracks() {
  CaseSpec spec = plate({0, 0}, {1.0, 1.2}, 20, 24);
  add_crack(spec, {{0.0, 0.53}, {0.31, 0.56}});
  add_crack(spec, {{0.47, 0.25}, {0.52, 0.9}});
  BoundarySpec top = on_side(Side::top), bottom = on_side(Side::bottom), pin = at_point({0, 0});
  top.displacement[1] = proportional_load(4e-3);
  bottom.displacement[1] = proportional_load(0);
  pin.displacement[0] = proportional_load(0);
  spec.boundaries = {top, bottom, pin};
  spec.solver.tolerance = 1e-11;
  spec.load_factors = {0.4, 0.6, 1.0};
  spec.material.toughness = 1.0;
  spec.growth.criterion = Criterion::hoop;
  spec.growth.fixed_step = true;
  spec.growth.step_length = {1.5, 1.5};
  return spec;
}

/// Two flaws that a load from above closes; they slip, and wings grow from them.
CaseSpec pressed_flaws() {
  CaseSpec spec = growing_cracks();
  spec.cracks.clear();
  add_crack(spec, {{0.21, 0.33}, {0.48, 0.62}});
  add_crack(spec, {{0.55, 0.66}, {0.79, 0.93}});
  for (CrackSpec& crack : spec.cracks)
    crack.contact = {ContactLaw::coulomb, 1e6, 1e5, 0.3, 0.0, 0.0, 0.0};
  spec.boundaries[0].displacement[1] = proportional_load(-4e-3);
  spec.load_factors = {0.5, 0.9, 1.3};
  return spec;
}

/// Collects the rows of tips.csv; leaves the run at its `leave`-th rest.
class Witness final : public Observer {
 public:
  explicit Witness(int leave = -1) : leave_(leave) {}
  void on_step(const StepView& view) override {
    rows.insert(rows.end(), view.cycle_tips.begin(), view.cycle_tips.end());
  }
  bool on_rest(const RestPoint& point) override {
    if (rests++ != leave_) return false;
    kept = point.checkpoint();
    return true;
  }

  std::vector<TipRecord> rows;
  Checkpoint kept;
  int rests = 0;

 private:
  int leave_;
};

Summary run(const CaseSpec& spec, Communicator& ranks, Witness& witness,
            const Checkpoint* from = nullptr) {
  const std::array<Observer*, 1> observers{&witness};
  const Partitioner one_part = [](const PartitionGraph& graph, int) {
    return std::vector<int>(graph.weights.size(), 0);
  };
  return run_simulation(spec, "test", ranks, ranks.size() > 1 ? world_partitioner() : one_part,
                        observers, from);
}

template <class T>
std::vector<T> of_all_ranks(const std::vector<T>& mine) {
  return world().agree(mine, [](const T&, const T&) { return false; });
}

/// Every row, on every rank.
CellFields all_rows(const CellFields& mine) {
  return {of_all_ranks(mine.nodes), of_all_ranks(mine.counts), of_all_ranks(mine.displacement),
          of_all_ranks(mine.force)};
}

/// Rows [n r / R, n (r + 1) / R) of all, on rank r of R: mostly not those of its own cells.
CellFields share_of(const CellFields& all) {
  const auto rank = std::size_t(world().rank()), ranks = std::size_t(world().size());
  const std::size_t n = all.nodes.size(), first = n * rank / ranks, last = n * (rank + 1) / ranks;
  CellFields mine;
  std::size_t at = 0;
  for (std::size_t k = 0; k < n; ++k) {
    const auto count = std::size_t(all.counts[k]);
    if (k >= first && k < last) {
      mine.nodes.push_back(all.nodes[k]);
      mine.counts.push_back(all.counts[k]);
      for (std::size_t i = at; i < at + count; ++i) {
        mine.displacement.push_back(all.displacement[i]);
        mine.force.push_back(all.force[i]);
      }
    }
    at += count;
  }
  return mine;
}

void expect_same_tips(const std::vector<TipRecord>& a, const std::vector<TipRecord>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t t = 0; t < a.size(); ++t) {
    EXPECT_EQ(a[t].step, b[t].step);
    EXPECT_EQ(a[t].cycle, b[t].cycle);
    EXPECT_EQ(a[t].crack, b[t].crack);
    EXPECT_EQ(a[t].end, b[t].end);
    EXPECT_EQ(a[t].state, b[t].state);
    EXPECT_EQ(a[t].mode, b[t].mode);
    EXPECT_NEAR(a[t].k1, b[t].k1, 1e-6);  // of a toughness of 1
    EXPECT_NEAR(a[t].k2, b[t].k2, 1e-6);
    EXPECT_NEAR(a[t].growth, b[t].growth, 1e-4 * h);
  }
}

void expect_same(const Summary& a, const Summary& b) {
  EXPECT_EQ(a.status, b.status);
  EXPECT_EQ(a.message, b.message);
  ASSERT_EQ(a.steps.size(), b.steps.size());
  for (std::size_t k = 0; k < a.steps.size(); ++k) {
    EXPECT_EQ(a.steps[k].step, b.steps[k].step);
    EXPECT_NEAR(a.steps[k].load_factor, b.steps[k].load_factor, 1e-6);
    EXPECT_EQ(a.steps[k].growth_cycles, b.steps[k].growth_cycles);
    EXPECT_EQ(a.steps[k].contact_iterations > 0, b.steps[k].contact_iterations > 0);
    EXPECT_NEAR(a.steps[k].external_work, b.steps[k].external_work,
                1e-6 * a.steps[0].external_work);
    EXPECT_NEAR(a.steps[k].dissipated, b.steps[k].dissipated, 1e-6 * a.steps[0].external_work);
  }
  ASSERT_EQ(a.events.size(), b.events.size());
  for (std::size_t e = 0; e < a.events.size(); ++e) {
    EXPECT_EQ(a.events[e].kind, b.events[e].kind);
    EXPECT_EQ(a.events[e].step, b.events[e].step);
    EXPECT_EQ(a.events[e].cycle, b.events[e].cycle);
    EXPECT_EQ(a.events[e].crack, b.events[e].crack);
    EXPECT_EQ(a.events[e].partner, b.events[e].partner);
  }
  ASSERT_EQ(a.cracks.size(), b.cracks.size());
  for (std::size_t c = 0; c < a.cracks.size(); ++c) {
    ASSERT_EQ(a.cracks[c].points.size(), b.cracks[c].points.size());
    for (std::size_t k = 0; k < a.cracks[c].points.size(); ++k)
      EXPECT_LT((a.cracks[c].points[k] - b.cracks[c].points[k]).norm(), 1e-4 * h);
  }
  expect_same_tips(a.tips, b.tips);
}

/// Leaves the run at some of its rests, all over it, and goes on: written by all ranks and taken up
/// by one, and the other way round.
void expect_same_from_rests(const CaseSpec& spec, int least_rests) {
  SerialCommunicator alone;
  Witness whole;
  const Summary expected = run(spec, alone, whole);
  EXPECT_GE(whole.rests, least_rests);
  const int stride = (whole.rests + 2) / 3;
  for (int rest = stride - 1; rest < whole.rests; rest += stride) {
    const bool all_write = rest / stride % 2 == 0;
    Witness before(rest), after;
    const Summary left = run(spec, all_write ? world() : static_cast<Communicator&>(alone), before);
    const bool was_over = left.steps.size() == expected.steps.size();
    EXPECT_EQ(left.status, was_over ? expected.status : "running");
    Checkpoint& checkpoint = before.kept;
    if (all_write) {
      checkpoint.cells = all_rows(checkpoint.cells);
    } else {
      checkpoint.cells = share_of(checkpoint.cells);
    }
    const Summary right =
        run(spec, all_write ? static_cast<Communicator&>(alone) : world(), after, &checkpoint);
    expect_same(expected, right);
    before.rows.insert(before.rows.end(), after.rows.begin(), after.rows.end());
    expect_same_tips(whole.rows, before.rows);
    EXPECT_EQ(before.rests + after.rests, whole.rests);
    if (::testing::Test::HasFailure()) FAIL() << "at rest " << rest;
  }
}

TEST(RestartParallel, OfGivenLoadStepsGoesOnTheSame) {
  expect_same_from_rests(growing_cracks(), 6);
}

TEST(RestartParallel, OfACriticalLoadingGoesOnTheSame) {
  CaseSpec spec = growing_cracks();
  spec.loading.critical = true;
  spec.loading.max_events = 8;
  expect_same_from_rests(spec, 5);
}

TEST(RestartParallel, WhereFacesTouchGoesOnTheSame) { expect_same_from_rests(pressed_flaws(), 5); }

TEST(RestartParallel, OfACriticalLoadingWhereFacesTouchGoesOnTheSame) {
  CaseSpec spec = pressed_flaws();
  spec.loading.critical = true;
  spec.loading.max_events = 6;
  expect_same_from_rests(spec, 5);
}

TEST(Restart, CanHaveOtherLoadSteps) {
  CaseSpec spec = growing_cracks();
  SerialCommunicator alone;
  Witness before(0), after;
  spec.growth.criterion = Criterion::none;
  run(spec, alone, before);
  EXPECT_EQ(before.kept.progress.load_factor, 0.4);
  spec.load_factors = {0.1, 0.2, 0.3, 0.4, 0.5, 0.9};
  const Summary summary = run(spec, alone, after, &before.kept);
  std::vector<double> factors;
  for (const StepRecord& step : summary.steps) factors.push_back(step.load_factor);
  EXPECT_EQ(factors, (std::vector<double>{0.4, 0.5, 0.9}));
  EXPECT_EQ(summary.steps.back().step, 3);
  spec.load_factors = {0.1, 0.4};
  EXPECT_EQ(run(spec, alone, after, &before.kept).steps.size(), 1u);
}

TEST(Restart, DoesNotDoAStepWithoutLoadTwice) {
  CaseSpec spec = growing_cracks();
  SerialCommunicator alone;
  Witness before(0), after;
  spec.growth.criterion = Criterion::none;
  spec.load_factors = {0.0, 0.1};
  run(spec, alone, before);
  const Summary summary = run(spec, alone, after, &before.kept);
  ASSERT_EQ(summary.steps.size(), 2u);
  EXPECT_EQ(summary.steps.back().load_factor, 0.1);
}

/// Limits that are lower than where the run stands end it.
TEST(Restart, CanHaveLowerLimits) {
  CaseSpec spec = growing_cracks();
  SerialCommunicator alone;
  Witness before(2), after;
  spec.load_factors = {1.0};
  run(spec, alone, before);
  ASSERT_EQ(before.kept.progress.cycles, 3);
  spec.growth.cycles = 2;
  Summary summary = run(spec, alone, after, &before.kept);
  EXPECT_EQ(summary.steps.back().growth_cycles, before.kept.progress.cycles);
  EXPECT_TRUE(std::any_of(summary.events.begin(), summary.events.end(),
                          [](const EventRecord& e) { return e.kind == "unstable"; }));
  spec = growing_cracks();
  spec.loading.critical = true;
  Witness event(2);
  run(spec, alone, event);
  spec.loading.max_events = event.kept.progress.steps;
  summary = run(spec, alone, after, &event.kept);
  EXPECT_EQ(summary.steps.back().step, event.kept.progress.steps + 1);
  EXPECT_EQ(summary.status, "completed");
}

/// A pressed crack that slips has its slip and its tractions afterwards, and slips on.
TEST(RestartParallel, RemembersSlip) {
  CaseSpec spec = plate({0, 0}, {1.0, 1.0}, 20, 20);
  add_crack(spec, {{0.33, 0.51}, {0.66, 0.51}});
  spec.cracks[0].contact = {ContactLaw::coulomb, 1e5, 1e5, 0.2, 0.0, 0.0, 0.0};
  BoundarySpec top = on_side(Side::top), bottom = on_side(Side::bottom);
  top.traction = {proportional_load(1.0), function_load([](double, double) { return -1.0; })};
  bottom.displacement = constant_load(0, 0);
  spec.boundaries = {top, bottom};
  const auto model = built(spec);
  const auto settle = [](Model& m, double factor) {
    find_equilibrium(m, *make_solver(m), factor);
    m.accept_contact();
  };
  settle(*model, 1.0);
  Checkpoint checkpoint = take_checkpoint(*model, {}, {}, {});
  checkpoint.cells = share_of(all_rows(checkpoint.cells));
  Model again(spec, world(), world_partitioner());
  put_back(checkpoint, again);
  EXPECT_EQ(again.state(), model->state());
  const auto &a = model->contact().patches(), &b = again.contact().patches();
  ASSERT_EQ(a.size(), b.size());
  const auto expect_same_patches = [&](double tolerance) {
    for (std::size_t p = 0; p < a.size(); ++p) {
      EXPECT_EQ(a[p].now.state, b[p].now.state);
      EXPECT_EQ(a[p].group, b[p].group);
      EXPECT_EQ(a[p].bodies, b[p].bodies);
      EXPECT_NEAR(a[p].now.normal, b[p].now.normal, tolerance);
      EXPECT_NEAR(a[p].now.tangential, b[p].now.tangential, tolerance);
    }
    double largest = 0.0;
    for (std::size_t p = 0; p < a.size(); ++p) {
      largest = std::max(largest, std::abs(a[p].slip));
      EXPECT_NEAR(a[p].slip, b[p].slip, std::max(tolerance, 1e-14) * 1e-3);
    }
    EXPECT_GT(largest, 1e-4);
  };
  expect_same_patches(0.0);
  settle(*model, 1.1);
  settle(again, 1.1);
  expect_same_patches(1e-7);
}

TEST(RestartParallel, RefusesWhatDoesNotFit) {
  const CaseSpec spec = growing_cracks();
  const auto model = built(spec);
  Checkpoint checkpoint = take_checkpoint(*model, {}, {}, {});
  CaseSpec other = spec;
  other.tip_radius = 3 * h;  // more near-tip unknowns
  Model wider(other, world(), world_partitioner());
  EXPECT_THROW(put_back(checkpoint, wider), IoError);
  other = spec;
  other.cracks[0].contact = {ContactLaw::frictionless, 1e5, 0.0, 0.0, 0.0, 0.0, 0.0};
  Model touching(other, world(), world_partitioner());
  EXPECT_THROW(put_back(checkpoint, touching), IoError);
}

}  // namespace
}  // namespace cdca::testing
