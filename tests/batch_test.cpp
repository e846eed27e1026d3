// Many rods of one kind: row by row what a Solver gives, in any order.
#include "support.h"

#include "fam/solve.h"
#include "fam/solver.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <cmath>
#include <random>

namespace {

using fam::BatchColumn;
using fam::RowMajorMatrix;
using scene::Frame;
using scene::Status;

// Gravity, a fixed force on the tip and a tendon: all that a column may name.
scene::Scene catheter(double force_z_N = 0.3) {
  scene::Stiffness stiffness = support::slender(1500, 1000);
  stiffness.mass_per_length_kg_per_m = 0.03;
  return support::uniform_rod(
      40, stiffness,
      {scene::Gravity{{0, 0, -9.81}}, scene::Force{40, Frame::fixed, {0.1, 0.2, force_z_N}, {0, 0}},
       scene::Tendon{{1, 0}, 1, 40}, scene::Moment{25, Frame::follower, {0, 0, 5}}});
}

const std::vector<BatchColumn> columns{{1, 1}, {2, 0}, {1, 0}, {3, 2}, {0, 2}};

RowMajorMatrix random_values(Eigen::Index rows) {
  std::mt19937 random(15);
  std::uniform_real_distribution<double> unit(-1, 1);
  RowMajorMatrix values(rows, 5);
  for (Eigen::Index row = 0; row < rows; ++row) {
    values.row(row) << 0.5 * unit(random), 2 + 2 * unit(random), 0.5 * unit(random), 20 * unit(random),
        9.81 * unit(random);
  }
  return values;
}

fam::Solver solver_of(const scene::Scene& scene, const fam::Options& options = {}) {
  return std::get<fam::Solver>(fam::Solver::make(scene, options));
}

// The force is too large for lanes, which end Newton's method elsewhere (lanes_test.cpp).
TEST(Batch, EachRowIsWhatASolverGives) {
  const RowMajorMatrix values = random_values(30);
  const fam::BatchResult batch = fam::solve_batch(catheter(3), columns, values);
  ASSERT_EQ(batch.position_mm.rows(), 30);
  ASSERT_EQ(batch.rotation_wxyz.rows(), 30);
  ASSERT_EQ(batch.status.size(), 30u);
  double spread_mm = 0;
  for (Eigen::Index k = 0; k < values.rows(); ++k) {
    fam::Solver solver = solver_of(catheter(3));
    solver.set_force_N(1, {values(k, 2), values(k, 0), 3});  // z stays the scene's
    solver.set_tension_N(2, values(k, 1));
    solver.set_moment_Nmm(3, {0, 0, values(k, 3)});
    solver.set_acceleration_m_per_s2(0, {0, 0, values(k, 4)});
    ASSERT_EQ(solver.solve(fam::Solver::Start::unloaded).status, Status::converged);
    EXPECT_EQ(batch.status[static_cast<std::size_t>(k)], Status::converged);
    EXPECT_EQ(batch.position_mm.row(k), solver.tip().position_B_mm.transpose()) << k;
    const auto q = batch.rotation_wxyz.row(k);
    EXPECT_GE(q[0], 0);
    EXPECT_LT((Eigen::Quaterniond(q[0], q[1], q[2], q[3]).toRotationMatrix() - solver.tip().rotation_BS).norm(), 1e-14);
    EXPECT_EQ(batch.error_estimate_mm[k], solver.error_estimate_mm()) << k;
    spread_mm = std::max(spread_mm, (batch.position_mm.row(k) - batch.position_mm.row(0)).norm());
  }
  EXPECT_GT(spread_mm, 1);  // the values did arrive
}

// A view of some columns of a wider matrix, whose rows lie farther apart; small loads, which lanes solve.
TEST(Batch, ValuesMayBeAPartOfAWiderMatrix) {
  const RowMajorMatrix wide = random_values(20) / 10;
  const std::span<const BatchColumn> two(columns.data() + 3, 2);
  const fam::BatchResult of_part = fam::solve_batch(catheter(), two, wide.rightCols(2));
  const fam::BatchResult of_copy = fam::solve_batch(catheter(), two, RowMajorMatrix(wide.rightCols(2)));
  EXPECT_EQ(of_part.position_mm, of_copy.position_mm);
  EXPECT_EQ(of_part.error_estimate_mm, of_copy.error_estimate_mm);
}

TEST(Batch, OrderAndCompanyOfTheRowsDoNotMatter) {
  const RowMajorMatrix values = random_values(20);
  const RowMajorMatrix reversed = values.colwise().reverse();
  const fam::BatchResult forth = fam::solve_batch(catheter(), columns, values);
  const fam::BatchResult back = fam::solve_batch(catheter(), columns, reversed);
  EXPECT_EQ(forth.position_mm, back.position_mm.colwise().reverse());
  EXPECT_EQ(forth.rotation_wxyz, back.rotation_wxyz.colwise().reverse());
  EXPECT_EQ(forth.error_estimate_mm, back.error_estimate_mm.reverse());
  const fam::BatchResult alone = fam::solve_batch(catheter(), columns, values.middleRows(7, 1));
  EXPECT_EQ(alone.position_mm.row(0), forth.position_mm.row(7));
}

// A cantilever with a moment is an arc of a circle: tip at (sin a, 1 - cos a) L / a, a = M L / EI.
TEST(Batch, ArcsOfCircles) {
  const scene::Scene rod =
      support::uniform_rod(100, support::slender(1500, 1000), {scene::Moment{100, Frame::follower, {0, 0, 0}}});
  RowMajorMatrix moments_Nmm(4, 1);
  moments_Nmm << 1, 10, 30, -60;
  const std::vector<BatchColumn> moment_z{{0, 2}};
  // Largest errors of the position, mm, and of the quaternion, which has w >= 0 whatever the turns.
  const auto worst = [&](const scene::Scene& scene) {
    const fam::BatchResult batch = fam::solve_batch(scene, moment_z, moments_Nmm);
    Eigen::Vector2d errors = Eigen::Vector2d::Zero();
    for (Eigen::Index k = 0; k < 4; ++k) {
      const double angle = moments_Nmm(k) * 100 / 1500;
      const Eigen::RowVector3d tip_mm(100 * std::sin(angle) / angle, 100 * (1 - std::cos(angle)) / angle, 0);
      Eigen::RowVector4d q(std::cos(angle / 2), 0, 0, std::sin(angle / 2));
      if (q[0] < 0) q = -q;
      errors[0] = std::max(errors[0], (batch.position_mm.row(k) - tip_mm).norm());
      errors[1] = std::max(errors[1], (batch.rotation_wxyz.row(k) - q).norm());
    }
    return errors;
  };
  const Eigen::Vector2d errors = worst(rod);
  EXPECT_LT(errors[0], 1e-9);  // round-off: an arc is the exact answer
  EXPECT_LT(errors[1], 1e-11);
  const Eigen::Vector2d twin = worst(support::stiffer(rod));
  EXPECT_GT(twin[0], 1);
  EXPECT_GT(twin[1], 0.01);
}

TEST(Batch, ARowThatFailsSaysSoAndTheOthersStay) {
  const scene::Scene rod =
      support::uniform_rod(100, support::slender(1500, 1000), {scene::Force{100, Frame::fixed, {0, 0, 0}, {0, 0}}});
  const std::vector<BatchColumn> force_y{{0, 1}};
  RowMajorMatrix forces_N(3, 1);
  forces_N << 0.05, 5, 0.1;  // one arc cannot resolve 5 N: sqrt(5 / 1500) 100 = 5.8 > 2.5
  fam::Options one_arc;
  one_arc.arcs = 1;
  const fam::BatchResult batch = fam::solve_batch(rod, force_y, forces_N, one_arc);
  EXPECT_EQ(batch.status[0], Status::converged);
  EXPECT_EQ(batch.status[1], Status::arc_not_converged);
  EXPECT_EQ(batch.status[2], Status::converged);
  EXPECT_TRUE(batch.position_mm.row(1).array().isNaN().all());
  EXPECT_TRUE(batch.rotation_wxyz.row(1).array().isNaN().all());
  EXPECT_TRUE(std::isnan(batch.error_estimate_mm[1]));
  EXPECT_GT(batch.position_mm(2, 1), batch.position_mm(0, 1));
}

TEST(Batch, OptionsAreThoseOfASolver) {
  const RowMajorMatrix values = random_values(3);
  fam::Options strict;
  strict.tolerance_mm = 1e-200;  // no arcs reach it
  EXPECT_EQ(fam::solve_batch(catheter(), columns, values.topRows(1), strict).status[0], Status::tolerance_not_met);

  fam::Options bare;
  bare.arcs = 8;
  bare.estimate_error = false;
  const fam::BatchResult fixed = fam::solve_batch(catheter(), columns, values, bare);
  EXPECT_EQ(fixed.error_estimate_mm, Eigen::VectorXd::Zero(3));
  bare.estimate_error = true;
  EXPECT_GT(fam::solve_batch(catheter(), columns, values, bare).error_estimate_mm.minCoeff(), 0);
  EXPECT_EQ(fam::solve_batch(catheter(), columns, values, bare).position_mm, fixed.position_mm);

  fam::Options published;
  published.law = fam::Law::published;
  for (const Status status : fam::solve_batch(catheter(), columns, values, published).status)
    EXPECT_EQ(status, Status::unsupported);
}

// A rod coiled out of a plane, which bounds ask more arcs for than a kept solver reserves.
TEST(Batch, ARowThatBoundsGiveUpIsWhatSolveGives) {
  scene::Scene coil = support::uniform_rod(250, support::slender(3190, 2280), {scene::Gravity{{0, 0, -0.01}}});
  coil.sections[0].rest_curvature_per_mm = {0, 0.05, 0};
  coil.sections.push_back(support::uniform_rod(150, support::slender(736, 526), {}).sections[0]);
  coil.sections[1].rest_curvature_per_mm = {0.01, 0, 0.02};
  for (scene::Section& section : coil.sections) {
    scene::Stiffness stiffness = scene::stiffness_of(section);
    stiffness.mass_per_length_kg_per_m = 4e-3;
    section.cross_section = stiffness;
  }
  fam::Options options;
  options.tolerance_mm = 4e-4;
  options.reserved_arcs = 64;
  fam::Solver solver = solver_of(coil, options);
  ASSERT_FALSE(solver.solve().converged() && solver.error_estimate_mm() <= options.tolerance_mm);

  RowMajorMatrix values(2, 1);
  values << -0.01, -0.02;
  const fam::BatchResult batch = fam::solve_batch(coil, std::vector<BatchColumn>{{0, 2}}, values, options);
  const scene::Equilibrium alone = fam::solve(coil, options);
  ASSERT_TRUE(alone.converged() && batch.status[0] == Status::converged && batch.status[1] == Status::converged);
  EXPECT_EQ(batch.position_mm.row(0).transpose(), alone.tip().position_B_mm);
  EXPECT_EQ(batch.error_estimate_mm[0], alone.error_estimate_mm);
  EXPECT_LE(batch.error_estimate_mm.maxCoeff(), options.tolerance_mm);
}

// A twist of 120 rad beside a small force: more arcs than a kept solver reserves.
TEST(Batch, ARowThatTakesMoreArcsThanReservedIsWhatSolveGives) {
  const scene::Scene wound = support::uniform_rod(10, support::slender(5, 5),
                                                  {scene::Moment{6, Frame::follower, {-200, -3, -3}},
                                                   scene::Force{0.6, Frame::follower, {-1, -0.3, -0.04}, {0, 0}}});
  EXPECT_EQ(solver_of(wound, {}).solve().status, Status::tolerance_not_met);
  RowMajorMatrix values(2, 1);
  values << -200, -100;
  const fam::BatchResult batch = fam::solve_batch(wound, std::vector<BatchColumn>{{0, 0}}, values);
  const scene::Equilibrium alone = fam::solve(wound);
  ASSERT_TRUE(alone.converged() && batch.status[0] == Status::converged && batch.status[1] == Status::converged);
  EXPECT_EQ(batch.position_mm.row(0).transpose(), alone.tip().position_B_mm);
}

TEST(Batch, NothingToChangeAndNothingToSolve) {
  const fam::BatchResult same = fam::solve_batch(catheter(), {}, RowMajorMatrix(2, 0));
  EXPECT_EQ(same.position_mm.row(0), same.position_mm.row(1));
  EXPECT_EQ(fam::solve_batch(catheter(), columns, RowMajorMatrix(0, 5)).status.size(), 0u);
}

std::string refused(const std::vector<BatchColumn>& named, const RowMajorMatrix& values) {
  try {
    fam::solve_batch(catheter(), named, values);
  } catch (const scene::SceneError& error) {
    return error.what();
  }
  return "";
}

TEST(Batch, WrongInputIsNamed) {
  RowMajorMatrix values = RowMajorMatrix::Ones(4, 2);
  EXPECT_EQ(refused({{1, 0}, {2, 0}}, values), "");
  EXPECT_EQ(refused({{1, 0}, {9, 0}}, values),
            "columns[1].load = 9: must name one of the scene's 4 loads, counted from 0");
  EXPECT_EQ(refused({{1, 0}, {1, 3}}, values), "columns[1].component = 3: must be 0, 1 or 2");
  EXPECT_EQ(refused({{1, -1}, {1, 1}}, values), "columns[0].component = -1: must be 0, 1 or 2");
  EXPECT_EQ(refused({{1, 0}, {2, 1}}, values), "columns[1].component = 1: must be 0, the tension of a tendon");
  EXPECT_EQ(refused({{1, 0}, {1, 0}}, values), "columns[1] = {1, 0}: the column is given twice");
  EXPECT_EQ(refused({{1, 0}}, values), "values = 2 columns: must have 1, one for each of columns");
  values(3, 1) = -0.5;
  EXPECT_EQ(refused({{1, 0}, {2, 0}}, values), "values[3][1] = -0.5: must be >= 0");
  EXPECT_EQ(refused({{1, 0}, {1, 1}}, values), "");
  values(3, 1) = std::nan("");
  EXPECT_EQ(refused({{1, 0}, {1, 1}}, values), "values[3][1] = nan: must be finite");
  values(2, 0) = -INFINITY;
  EXPECT_EQ(refused({{1, 0}, {1, 1}}, values), "values[2][0] = -inf: must be finite");
}

}  // namespace
