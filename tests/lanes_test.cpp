// Lanes of the vector units against the Solver, rod by rod.
#include "support.h"
#include "support_fam.h"

#include "fam/batch_rows.h"
#include "fam/engine.h"
#include "fam/pack.h"
#include "scene/load_visitor.h"
#include "studies/scenes/random_scene.h"

#include <Eigen/Geometry>

#include <cmath>
#include <random>

namespace {

using fam::BatchColumn;
using fam::LaneUnit;
using fam::RowMajorMatrix;
using scene::Frame;
using scene::Status;

// Every number of the loads that is not zero, and rows of random shares of them.
struct Rods {
  std::vector<BatchColumn> columns;
  RowMajorMatrix values;

  Rods(scene::Scene scene, Eigen::Index rows, unsigned seed) {
    std::vector<double> full;
    for (std::size_t load = 0; load < scene.loads.size(); ++load) {
      const std::span<double> numbers = scene::numbers_of(scene.loads[load]);
      for (std::size_t k = 0; k < numbers.size(); ++k) {
        if (numbers[k] == 0) continue;
        columns.push_back({load, static_cast<int>(k)});
        full.push_back(numbers[k]);
      }
    }
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> share(0, 1);
    values.resize(rows, static_cast<Eigen::Index>(columns.size()));
    for (Eigen::Index row = 0; row < rows; ++row) {
      const double all = share(random);
      for (Eigen::Index k = 0; k < values.cols(); ++k)
        values(row, k) = all * share(random) * full[static_cast<std::size_t>(k)];
    }
  }
  scene::Scene of_row(scene::Scene scene, Eigen::Index row) const {
    for (std::size_t k = 0; k < columns.size(); ++k) {
      scene::numbers_of(scene.loads[columns[k].load])[static_cast<std::size_t>(columns[k].component)] =
          values(row, static_cast<Eigen::Index>(k));
    }
    return scene;
  }
};

fam::Options with_arcs(int arcs) {
  fam::Options options;
  options.arcs = arcs;
  return options;
}

// Rods that lanes solve themselves.
int solved_in_lanes(const LaneUnit& unit, const scene::Scene& scene, const Rods& rods, const fam::Options& options) {
  fam::LaneProblem problem(scene, rods.columns, options);
  const fam::RodModel model = problem.choice().rod.model;
  if (!problem.is_solvable(model)) return 0;
  fam::LaneRods& lanes = problem.set(model, scene::cells_per_span(problem.spans(), options.arcs));
  lanes.row_stride = rods.values.outerStride();
  lanes.estimate = true;
  lanes.longest_load_length = fam::longest_load_length;
  lanes.largest_swing_rad = fam::longest_swing_rad;
  std::vector<std::ptrdiff_t> rows;
  for (Eigen::Index row = 0; row < rods.values.rows(); ++row) rows.push_back(row);
  std::vector<fam::LaneTip> tips(rows.size());
  unit.solve(lanes, rods.values.data(), rows, tips.data());
  return static_cast<int>(std::ranges::count_if(tips, [](const fam::LaneTip& tip) { return tip.solved; }));
}

fam::BatchResult solved_by(const LaneUnit& unit, const scene::Scene& scene, const Rods& rods,
                           const fam::Options& options) {
  const Eigen::Index n = rods.values.rows();
  fam::BatchResult result = fam::room_for(n);
  const Eigen::Ref<const RowMajorMatrix> values = rods.values;
  fam::BatchRows(scene, rods.columns, values, options, result, unit).solve(0, n);
  return result;
}

// The largest differences from a Solver of its own for each row: of the tip's position over L and rotation, and of the
// estimate, relative, beyond the round-off. Statuses must be the same.
struct Difference {
  double tip = 0, estimate = 0;
};
Difference from_solver(const fam::BatchResult& batch, const scene::Scene& scene, const Rods& rods,
                       const fam::Options& options) {
  const double length_mm = scene::length_mm(scene);
  Difference largest;
  for (Eigen::Index row = 0; row < rods.values.rows(); ++row) {
    fam::Solver solver = support::kept(rods.of_row(scene, row), options);
    const Status status = solver.solve(fam::Solver::Start::unloaded).status;
    EXPECT_EQ(batch.status[static_cast<std::size_t>(row)], status) << "row " << row;
    if (status != Status::converged || batch.status[static_cast<std::size_t>(row)] != status) continue;
    const Eigen::RowVector4d q = batch.rotation_wxyz.row(row);
    const double position = (batch.position_mm.row(row).transpose() - solver.tip().position_B_mm).norm() / length_mm;
    const double rotation =
        (Eigen::Quaterniond(q[0], q[1], q[2], q[3]).toRotationMatrix() - solver.tip().rotation_BS).norm();
    const double error_mm = solver.error_estimate_mm();
    largest.tip = std::max({largest.tip, position, rotation});
    largest.estimate =
        std::max(largest.estimate, std::abs(batch.error_estimate_mm[row] - error_mm) / (error_mm + 1e-9 * length_mm));
  }
  return largest;
}

// One rod for each thing that the kernel does.
std::vector<std::pair<std::string, scene::Scene>> rods_of_every_kind() {
  using scene::DistributedForce, scene::Force, scene::Gravity, scene::Moment, scene::Tendon;
  const scene::Stiffness round = support::slender(1500, 1000);
  scene::Stiffness strip = round;
  strip.bending_Nmm2 = {1500, 4000};
  strip.axial_N = 3000;
  strip.shear_N = Eigen::Vector2d(900, 1100);
  strip.mass_per_length_kg_per_m = 0.03;
  scene::Stiffness heavy = round;
  heavy.mass_per_length_kg_per_m = 0.03;
  const auto rod = [](const scene::Stiffness& stiffness, std::vector<scene::Load> loads) {
    return support::uniform_rod(40, stiffness, std::move(loads));
  };
  scene::Scene bent = rod(strip, {Force{40, Frame::fixed, {0.1, 0.2, -0.1}, {0, 0}},
                                  Moment{15, Frame::fixed, {3, -4, 5}}, Gravity{{0, 3, -9.81}}});
  bent.sections.push_back(bent.sections.front());
  bent.sections.front().length_mm = 13;
  bent.sections.front().rest_curvature_per_mm = {0.003, 0.002, -0.004};
  bent.sections.back().length_mm = 27;
  return {
      {"follower, in space",
       rod(strip, {Force{40, Frame::follower, {-0.5, 0.8, 0.6}, {0, 0}}, Moment{40, Frame::follower, {10, 20, -15}},
                   Force{25, Frame::follower, {0, 0.3, 0}, {1, -2}},
                   DistributedForce{5, 30, Frame::follower, {0, 0.01, 0.005}}})},
      {"follower, in the x-z plane", rod(strip, {Force{40, Frame::follower, {-0.5, 0, 0.6}, {0, 0}}})},
      {"follower, Kirchhoff",
       rod(round, {Force{40, Frame::follower, {-0.5, 0.8, 0.6}, {0, 0}}, Moment{40, Frame::follower, {10, 20, -15}}})},
      {"fixed, in the plane", rod(round, {Force{40, Frame::fixed, {-0.3, 0.8, 0}, {0, 0}}})},
      {"fixed, in an oblique plane",
       rod(round, {Force{40, Frame::fixed, {0, 0.3, 0}, {0, 0}}, Force{20, Frame::fixed, {0.1, 0, 0}, {0, 0}}})},
      {"fixed, in the plane with straight tendons",
       rod(round, {Force{40, Frame::fixed, {0, 0.4, 0}, {0, 0}}, Tendon{{2, 0}, 3, 40}, Tendon{{-1, 0}, 2, 30}})},
      {"fixed, round",
       rod(round, {Force{40, Frame::fixed, {0.2, 0.3, 0.3}, {0, 0}}, Moment{40, Frame::fixed, {6, 5, -5}}})},
      {"fixed, two sections bent at rest, weight and shear", bent},
      {"fixed off the centreline", rod(strip, {Force{40, Frame::fixed, {-0.2, 0.3, 0.2}, {2, -3}}})},
      {"fixed, distributed", rod(strip, {DistributedForce{5, 35, Frame::fixed, {0.003, 0.008, 0.01}},
                                         DistributedForce{0, 20, Frame::follower, {0, 0.004, -0.003}}})},
      {"fixed, tendons in space",
       rod(heavy, {Force{40, Frame::fixed, {0.1, 0.2, -0.1}, {0, 0}}, Tendon{{2, 0}, 6, 40}, Tendon{{-1, 1.5}, 9, 25},
                   Tendon{{0, -2}, 4, 40}, Gravity{{0, 3, -9.81}}})},
      {"fixed, turned by tendons up to 3 rad", rod(round, {Force{40, Frame::fixed, {0.02, 0.03, -0.02}, {0, 0}},
                                                           Tendon{{4, 0}, 28, 40}, Tendon{{0, -2}, 9, 25}})},
      {"follower, tendons in space, with shear", rod(strip, {Force{40, Frame::follower, {-0.5, 0.8, 0.6}, {0, 0}},
                                                             Tendon{{2, 1}, 9, 40}, Tendon{{0, -2}, 7, 30}})},
      {"fixed, tendons in space, with shear",
       rod(strip, {Force{30, Frame::fixed, {-0.2, 0.3, 0.2}, {1, 1}}, Tendon{{2, 1}, 9, 40}, Gravity{{0, 3, -9.81}}})},
      {"fixed, in the plane with tendons and shear",
       rod(strip, {Force{40, Frame::fixed, {0, 0.4, 0}, {0, 0}}, Tendon{{2, 0}, 8, 40}, Tendon{{-1, 0}, 6, 30}})},
  };
}

// Measured on four units: 2.2e-14, and 5.5e-6 of the estimates, which are small differences of positions.
TEST(Lanes, EveryUnitGivesWhatASolverGives) {
  const fam::Options options = with_arcs(8);
  for (const LaneUnit& unit : fam::lane_units()) {
    for (const auto& [what, scene] : rods_of_every_kind()) {
      const Rods rods(scene, 21, 7);
      const fam::BatchResult batch = solved_by(unit, scene, rods, options);
      EXPECT_EQ(solved_in_lanes(unit, scene, rods, options), 21) << unit.name << ", " << what;
      const Difference difference = from_solver(batch, scene, rods, options);
      EXPECT_LT(difference.tip, 1e-12) << unit.name << ", " << what;
      EXPECT_LT(difference.estimate, 1e-4) << unit.name << ", " << what;
      EXPECT_GT(from_solver(batch, support::stiffer(scene), rods, options).tip, 1e-4) << unit.name << ", " << what;
    }
  }
}

// Measured: 2.7e-14, and 7.7e-6 of the estimates; 4531 of 4704 rods in lanes, the others may buckle.
TEST(Lanes, RandomScenes) {
  const LaneUnit& unit = fam::lane_units().front();
  studies::RandomSceneLimits limits;
  limits.load_max = 1;
  fam::Options options = with_arcs(6);
  options.locate_limit = false;  // a kept solver does not
  Difference largest;
  int rows = 0, in_lanes = 0;
  for (unsigned seed = 600; seed < 900; ++seed) {
    const scene::Scene scene = studies::random_scene(seed, limits);
    const Rods rods(scene, 16, seed);
    if (rods.columns.empty()) continue;
    const Difference difference = from_solver(solved_by(unit, scene, rods, options), scene, rods, options);
    EXPECT_LT(difference.tip, 1e-11) << "seed " << seed;
    EXPECT_LT(difference.estimate, 1e-3) << "seed " << seed;
    in_lanes += solved_in_lanes(unit, scene, rods, options);
    rows += 16;
  }
  EXPECT_GT(in_lanes, rows * 9 / 10);
}

// With arcs chosen for the tolerance: the same statuses, and tips within what Newton's method leaves of it.
TEST(Lanes, ChosenArcsAreThoseOfASolver) {
  for (const auto& [what, scene] : rods_of_every_kind()) {
    const Rods rods(scene, 13, 3);
    fam::Options options;
    options.tolerance_mm = 1e-6;
    const fam::BatchResult batch = fam::solve_batch(scene, rods.columns, rods.values, options);
    for (Eigen::Index row = 0; row < 13; ++row) {
      fam::Solver solver = support::kept(rods.of_row(scene, row), options);
      ASSERT_TRUE(solver.solve(fam::Solver::Start::unloaded).converged());
      const bool meets = solver.error_estimate_mm() <= options.tolerance_mm;
      const auto k = static_cast<std::size_t>(row);
      EXPECT_EQ(batch.status[k], meets ? Status::converged : Status::tolerance_not_met) << what << row;
      if (!meets) continue;
      EXPECT_LT((batch.position_mm.row(row).transpose() - solver.tip().position_B_mm).norm(), 1e-7) << what << row;
      EXPECT_NEAR(batch.error_estimate_mm[row], solver.error_estimate_mm(), 1e-7) << what << row;
    }
  }
}

// A rod of EA = 1e7 N counts as inextensible at 1e-3 mm; the bound on its stretch, 3 F L/EA, is part of the estimate.
TEST(Lanes, WhatTheModelLeavesOutIsInTheEstimate) {
  scene::Stiffness stiffness = support::slender(1500, 1000);
  stiffness.axial_N = 1e7;
  const scene::Scene scene =
      support::uniform_rod(40, stiffness, {scene::Force{40, Frame::follower, {0, 1, 0}, {0, 0}}});
  fam::Options options;
  options.tolerance_mm = 1e-3;
  Rods rods(scene, 1, 1);
  rods.values.setConstant(1);
  const fam::BatchResult batch = fam::solve_batch(scene, rods.columns, rods.values, options);
  fam::Solver solver = support::kept(scene, options);
  ASSERT_TRUE(solver.solve().converged());
  EXPECT_GT(batch.error_estimate_mm[0], 3 * 1 * 40 / 1e7);
  EXPECT_NEAR(batch.error_estimate_mm[0], solver.error_estimate_mm(), 1e-9);
}

// Of one rod of 10 mm with one load of this value.
bool is_in_lanes(const scene::Stiffness& stiffness, const scene::Load& load, double value, int arcs) {
  const scene::Scene scene = support::uniform_rod(10, stiffness, {load});
  Rods rods(scene, 1, 1);
  rods.values.setConstant(value);
  return solved_in_lanes(fam::lane_units().front(), scene, rods, with_arcs(arcs)) == 1;
}

// What lanes cannot be sure of they leave: a second equilibrium from F L^2/EI = (pi/2)^2 = 2.467 on (the bound in use
// is 2.4), turns of an arc beyond 2 rad, loads that overflow.
TEST(Lanes, LeaveWhatIsNotSure) {
  const auto in_lanes = [](const scene::Load& load, double value, int arcs) {
    return is_in_lanes(support::slender(100, 80), load, value, arcs);
  };
  for (const Eigen::Vector3d& direction : {Eigen::Vector3d(-1, 0, 0), Eigen::Vector3d(0, 1, 0)}) {
    const scene::Force force{10, Frame::fixed, direction, {0, 0}};
    const double sign = direction.sum();
    EXPECT_TRUE(in_lanes(force, sign * 2.39, 8));
    EXPECT_FALSE(in_lanes(force, sign * 2.41, 8));
  }
  const scene::Moment moment{10, Frame::follower, {0, 0, 1}};
  EXPECT_TRUE(in_lanes(moment, 19.9, 1));
  EXPECT_FALSE(in_lanes(moment, 20.1, 1));
  EXPECT_TRUE(in_lanes(moment, 20.1, 2));
  EXPECT_FALSE(in_lanes(moment, 1e200, 2));
  EXPECT_FALSE(in_lanes(scene::Moment{10, Frame::fixed, {0, 0, 1}}, 1e160, 2));
  const scene::Force follower{10, Frame::follower, {0, 1, 0}, {0, 0}};
  EXPECT_FALSE(in_lanes(follower, 7, 1));  // sqrt(7/80) 10 = 2.96 > 2.5
  EXPECT_TRUE(in_lanes(follower, 7, 2));
}

// A moment about the stiff axis swings by sqrt((EI_y/GJ - 1)(EI_y/EI_z - 1)) = sqrt(6) times its turn; limit 2 rad.
TEST(Lanes, LeaveArcsThatSwing) {
  scene::Stiffness strip = support::slender(100, 400 / 3.0);
  strip.bending_Nmm2 = {400, 100};
  const scene::Moment moment{10, Frame::follower, {0, 1, 0}};
  const scene::Force force{10, Frame::follower, {1e-6, 1e-6, 1e-6}, {0, 0}};
  const auto in_lanes = [&](double turn_rad) {
    const scene::Scene scene = support::uniform_rod(10, strip, {moment, force});
    Rods rods(scene, 1, 1);
    rods.columns = {{0, 1}};
    rods.values = RowMajorMatrix::Constant(1, 1, turn_rad * 40);
    return solved_in_lanes(fam::lane_units().front(), scene, rods, with_arcs(1)) == 1;
  };
  EXPECT_TRUE(in_lanes(1.99 / std::sqrt(6)));
  EXPECT_FALSE(in_lanes(2.01 / std::sqrt(6)));
}

// A tendon 2 mm off the axis collapses where the rod bends about it: T r/EI = 1/r, T = 25 N.
TEST(Lanes, LeaveTendonsThatCollapse) {
  for (const double side : {2, -2}) {
    const scene::Tendon tendon{{side, 0}, 1, 10};
    EXPECT_TRUE(is_in_lanes(support::slender(100, 80), tendon, 24.9, 8));
    EXPECT_FALSE(is_in_lanes(support::slender(100, 80), tendon, 25.1, 8));
  }
}

// As many places of tendons as lanes hold, and one more; two tendons at one place are one.
TEST(Lanes, LeaveMoreTendonsThanTheyHold) {
  for (const int places : {12, 13}) {
    std::vector<scene::Load> loads{scene::Force{10, Frame::fixed, {0.01, 0.02, 0.03}, {0, 0}}};
    for (int i = 0; i < places + 1; ++i)
      loads.push_back(scene::Tendon{{2.0 - 0.1 * (i % places), 0.1 * (i % places)}, 0.1, 10});
    const scene::Scene scene = support::uniform_rod(10, support::slender(100, 80), loads);
    const Rods rods(scene, 9, 5);
    const LaneUnit& unit = fam::lane_units().front();
    EXPECT_EQ(solved_in_lanes(unit, scene, rods, with_arcs(6)), places == 12 ? 9 : 0);
    EXPECT_LT(from_solver(solved_by(unit, scene, rods, with_arcs(6)), scene, rods, with_arcs(6)).tip, 1e-12);
  }
}

// A tendon at y bends the rod alone to u = T y / EI and its own tangent to 1 - u y; with EI = 100 and y = 2 that is 2/3
// at T = 25/3.
TEST(Lanes, LeaveTendonsFarFromStraight) {
  const scene::Scene scene = support::uniform_rod(
      10, support::slender(100, 80), {scene::Tendon{{2, 0}, 1, 10}, scene::Moment{10, Frame::follower, {1, 0, 0}}});
  Rods rods(scene, 2, 1);
  rods.values << 8.25, 1e-3, 8.42, 1e-3;
  EXPECT_EQ(solved_in_lanes(fam::lane_units().front(), scene, rods, with_arcs(8)), 1);
  rods.values << 8.42, 1e-3, 8.42, 1e-3;
  EXPECT_EQ(solved_in_lanes(fam::lane_units().front(), scene, rods, with_arcs(8)), 0);
}

// What tendons turn and strain the rod by counts where a fixed load may leave a second equilibrium: at most 2 rad by
// T y L / GJ, and 0.1 by T / EA.
TEST(Lanes, LeaveTendonsThatBendTooFar) {
  const auto in_lanes = [](const scene::Stiffness& stiffness, const scene::Load& load, const Eigen::RowVector2d& values,
                           double y_mm = 1) {
    const scene::Scene scene = support::uniform_rod(10, stiffness, {scene::Tendon{{y_mm, 0}, 1, 10}, load});
    Rods rods(scene, 1, 1);
    rods.values = values;
    return solved_in_lanes(fam::lane_units().front(), scene, rods, with_arcs(8)) == 1;
  };
  const scene::Moment moment{10, Frame::fixed, {1, 0, 0}};
  EXPECT_TRUE(in_lanes(support::slender(100, 80), moment, {15.9, 1e-6}));
  EXPECT_FALSE(in_lanes(support::slender(100, 80), moment, {16.1, 1e-6}));
  // A force has an energy, which is convex, whatever they turn, while F L^2 / GJ (6^(-1/2) + 252^(-1/4)) < 1
  // (load_length.h): F = 1.214, a little less by the largest moment of each arc.
  const scene::Force across{10, Frame::fixed, {0, 0, 1}, {0, 0}};
  EXPECT_TRUE(in_lanes(support::slender(100, 80), across, {300, 1}, 0.1));
  EXPECT_FALSE(in_lanes(support::slender(100, 80), across, {300, 1.22}, 0.1));
  scene::Stiffness soft = support::slender(1000, 800);
  soft.axial_N = 100;
  const scene::Force force{10, Frame::fixed, {0, 1, 0}, {0, 0}};
  EXPECT_TRUE(in_lanes(soft, force, {9.9, 1e-6}));
  EXPECT_FALSE(in_lanes(soft, force, {10.1, 1e-6}));
}

void expect_neither_order_nor_threads_nor_company_matter(const scene::Scene& scene) {
  Rods rods(scene, 1300, 11);
  fam::Options options = with_arcs(6);
  const fam::BatchResult one = fam::solve_batch(scene, rods.columns, rods.values, options);
  for (const int threads : {0, 2, 5}) {
    options.threads = threads;
    const fam::BatchResult shared = fam::solve_batch(scene, rods.columns, rods.values, options);
    EXPECT_EQ(shared.position_mm, one.position_mm);
    EXPECT_EQ(shared.rotation_wxyz, one.rotation_wxyz);
    EXPECT_EQ(shared.error_estimate_mm, one.error_estimate_mm);
    EXPECT_EQ(shared.status, one.status);
  }
  const RowMajorMatrix reversed = rods.values.colwise().reverse();
  EXPECT_EQ(fam::solve_batch(scene, rods.columns, reversed, options).position_mm, one.position_mm.colwise().reverse());
  EXPECT_EQ(fam::solve_batch(scene, rods.columns, rods.values.middleRows(700, 3), options).position_mm,
            one.position_mm.middleRows(700, 3));
}
TEST(Lanes, NeitherOrderNorThreadsNorCompanyMatter) {
  const auto rods = rods_of_every_kind();
  for (const std::size_t kind : {7, 10}) expect_neither_order_nor_threads_nor_company_matter(rods[kind].second);
}

// sin t / t and its kin up to 2 rad, against the scalar ones.
TEST(Lanes, CoefficientsOfAScrew) {
  using Pack = fam::Pack<2, 0>;
  for (double angle = 0; angle <= 2; angle += 0.01) {
    Pack squared(0.3);
    squared.value[1] = angle * angle;
    const auto pack = fam::screw_coefficients(squared);
    const fam::ScrewCoefficients scalar = fam::screw_coefficients(angle * angle);
    EXPECT_NEAR(pack.A.value[1], scalar.A, 4e-16) << angle;
    EXPECT_NEAR(pack.B.value[1], scalar.B, 2e-16) << angle;
    EXPECT_NEAR(pack.C.value[1], scalar.C, 2e-16) << angle;
    EXPECT_EQ(pack.A.value[0], fam::screw_coefficients(0.3).A) << angle;
  }
}

}  // namespace
