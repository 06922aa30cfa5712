// SPDX-License-Identifier: BSD-3-Clause
#include "tests/verification/reference_solve.hpp"

#include "core/cells/gauss.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace cdca::testing {

namespace {

constexpr double elements_per_crack = 20.0;
constexpr double elements_of_room = 8.0;
constexpr double enriched_elements = 4.2;  // no node lies at just this distance
constexpr double margin = 2.0;             ///< of an infinite plane, in longest half lengths
constexpr double rim_change = 2e-5;        ///< of K, between two rims of an infinite plane
constexpr int most_solves = 12;

void add_traction(CaseSpec& spec, Side side, const Field& traction) {
  BoundarySpec b = on_side(side);
  b.traction = field_load(traction);
  spec.boundaries.push_back(b);
}

/// Bending moment: sigma_yy = 1 - 2x on both ends of the plate 0 <= x <= 1.
void bend(CaseSpec& spec) {
  pull(spec, {0, 0, 0});  // the supports
  add_traction(spec, Side::top, [](const Vec2& x) { return Vec2(0, 1 - 2 * x.x()); });
  add_traction(spec, Side::bottom, [](const Vec2& x) { return Vec2(0, 2 * x.x() - 1); });
}

/// sigma_yy = slope x on both ends.
void pull_aslant(CaseSpec& spec, double slope) {
  pull(spec, {0, 0, 0});  // the supports
  add_traction(spec, Side::top, [=](const Vec2& x) { return Vec2(0, slope * x.x()); });
  add_traction(spec, Side::bottom, [=](const Vec2& x) { return Vec2(0, -slope * x.x()); });
}

/// tau = 1 along the top, bottom held.
void shear_held_plate(CaseSpec& spec) {
  spec.material.poisson = 0.25;
  BoundarySpec held = on_side(Side::bottom);
  held.displacement = constant_load(0, 0);
  spec.boundaries.push_back(held);
  add_traction(spec, Side::top, [](const Vec2&) { return Vec2(1, 0); });
}

ContactSpec touching_faces(const CaseSpec& spec, const ReferenceGrid& grid, double friction) {
  ContactSpec contact;
  contact.law = friction > 0.0 ? ContactLaw::coulomb : ContactLaw::frictionless;
  const double side = (grid.upper.x() - grid.lower.x()) / grid.nx;
  contact.normal_stiffness = grid.contact_stiffness * spec.material.young / side;
  contact.tangential_stiffness = contact.normal_stiffness / 100;
  contact.friction = friction;
  return contact;
}

double largest_change(const std::vector<StressIntensity>& a,
                      const std::vector<StressIntensity>& b) {
  double change = 0.0, largest = 0.0;
  for (std::size_t k = 0; k < a.size(); ++k) {
    change = std::max({change, std::abs(a[k].k1 - b[k].k1), std::abs(a[k].k2 - b[k].k2)});
    largest = std::max({largest, std::abs(a[k].k1), std::abs(a[k].k2)});
  }
  return change / largest;
}

void settle_rim(SolvedReference& s, const EquilibriumSolver& solver) {
  for (; s.solves < most_solves; ++s.solves) {
    s.rim->take_jumps(*s.model);
    find_equilibrium(*s.model, solver, 1.0);
    const auto tips = tips_of(*s.model);
    const double change = largest_change(s.tips, tips);
    s.tips = tips;
    if (change < rim_change) return;
  }
  throw std::runtime_error("the rim of the infinite plane does not settle");
}

}  // namespace

double ReferenceGrid::cost(const ReferenceGeometry& g) const {
  return double(nx) * ny * std::max(nx, ny) * (g.infinite ? 1.5 : 1);
}

ReferenceGrid grid_of(const ReferenceGeometry& g) {
  ReferenceGrid grid{g.lower, g.upper};
  if (g.infinite) {
    grid.lower = grid.upper = g.cracks.at(0).points.at(0);
    for (const auto& crack : g.cracks) {
      for (const Vec2& x : crack.points) {
        grid.lower = grid.lower.cwiseMin(x);
        grid.upper = grid.upper.cwiseMax(x);
      }
    }
    grid.lower.array() -= margin * g.longest();
    grid.upper.array() += margin * g.longest();
  }
  const double h = std::min(g.shortest() / elements_per_crack, g.room() / elements_of_room);
  const Vec2 size = grid.upper - grid.lower;
  grid.nx = int(std::ceil(size.x() / h - 1e-9));
  grid.ny = int(std::ceil(size.y() / h - 1e-9));
  grid.tip_radius = enriched_elements * h;
  return grid;
}

CaseSpec spec_of(const ReferenceGeometry& g, const ReferenceLoad& load, const ReferenceGrid& grid) {
  CaseSpec spec = plate(grid.lower, grid.upper, grid.nx, grid.ny);
  spec.tip_radius = grid.tip_radius;
  spec.solver.tolerance = 1e-8;
  for (const auto& crack : g.cracks) add_crack(spec, crack.points);
  if (load.friction) {
    for (CrackSpec& crack : spec.cracks) crack.contact = touching_faces(spec, grid, *load.friction);
  }
  if (g.infinite) return spec;
  switch (load.kind) {
    case ReferenceLoad::Kind::stress: pull(spec, load.stress); break;
    case ReferenceLoad::Kind::slope: pull_aslant(spec, load.slope); break;
    case ReferenceLoad::Kind::bending: bend(spec); break;
    case ReferenceLoad::Kind::edge_shear: shear_held_plate(spec); break;
  }
  return spec;
}

std::vector<StressIntensity> tips_of(const Model& model) { return model.stress_intensities(1.0); }

SolvedReference solve_reference(const ReferenceGeometry& g, const ReferenceLoad& load,
                                const ReferenceGrid& grid) {
  SolvedReference s;
  s.spec = std::make_unique<CaseSpec>(spec_of(g, load, grid));
  if (g.infinite) {
    const Material material{s.spec->material.young, s.spec->material.poisson,
                            s.spec->domain.plane_strain};
    s.rim = load.kind == ReferenceLoad::Kind::slope
                ? std::make_unique<PlaneRim>(material, sloping_tension(material, load.slope))
                : std::make_unique<PlaneRim>(material, load.stress);
    s.rim->hold(*s.spec);
  }
  s.model = built(*s.spec);
  const auto solver = make_solver(*s.model);
  find_equilibrium(*s.model, *solver, 1.0);
  s.tips = tips_of(*s.model);
  if (g.infinite) settle_rim(s, *solver);
  return s;
}

Voigt mean_stress(const Model& model, const Vec2& x) {
  // the rectangle covers parts of two columns and two rows: integrate each of the four on its own
  const Vec2 low = model.grid().to_grid(x).array() - 0.5;
  Voigt sum = Voigt::Zero();
  for (const GaussPoint& p : gauss_points(3)) {
    for (const GaussPoint& q : gauss_points(3)) {
      for (const bool right : {false, true}) {
        for (const bool upper : {false, true}) {
          const Vec2 border(std::ceil(low.x()), std::ceil(low.y()));
          const Vec2 from(right ? border.x() : low.x(), upper ? border.y() : low.y());
          const Vec2 to(right ? low.x() + 1 : border.x(), upper ? low.y() + 1 : border.y());
          const Vec2 at = from + Vec2(p.x, q.x).cwiseProduct(to - from);
          const double weight = p.weight * q.weight * (to - from).prod();
          if (weight < 1e-9) continue;
          sum +=
              weight * model.material().stress(model.field_at(model.grid().from_grid(at)).gradient);
        }
      }
    }
  }
  return sum;
}

const StressIntensity& tip_at(const SolvedReference& solved, const Vec2& at) {
  const double limit = 1e-3 * solved.model->grid().smallest_side();
  for (const StressIntensity& tip : solved.tips) {
    const Crack& crack = solved.model->registry().cracks()[std::size_t(tip.crack)];
    if ((crack.end_point(tip.end) - at).norm() < limit) return tip;
  }
  throw std::runtime_error("the reference names a tip that is not there");
}

}  // namespace cdca::testing
