// Rods under moments fixed in space alone, whose moments are known before the shape is. Origins stand beside the
// numbers.
#include "exact_reference/solve.h"
#include "fam/solver.h"
#include "support.h"
#include "support_fam.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <tuple>

namespace {

using Eigen::Vector3d;
using scene::Frame;
using support::slender;
using support::uniform_rod;

Vector3d solved_tip_mm(const scene::Scene& scene, double tolerance_mm) {
  fam::Options options;
  options.tolerance_mm = tolerance_mm;
  const scene::Equilibrium result = fam::solve(scene, options);
  EXPECT_TRUE(result.converged()) << scene.title << " " << result.message;
  return result.converged() ? result.tip().position_B_mm : Vector3d::Constant(INFINITY);
}

// A rod that a soft section winds up by 250 turns, under two moments fixed in space.
scene::Scene wound_rod() {
  scene::Section stiff, soft, flat;
  stiff.length_mm = 12, soft.length_mm = 10, flat.length_mm = 18;
  stiff.cross_section = slender(750, 500);
  soft.cross_section = slender(700, 0.3);
  flat.cross_section = scene::Stiffness{150, {750, 200}, {}, {}};
  return {"wound",
          {stiff, soft, flat},
          {scene::Moment{25, Frame::fixed, {15, -20, 30}}, scene::Moment{40, Frame::fixed, {40, 10, -25}}}};
}

// R' = R [K^-1 R^T M], r' = R e_x from the clamp, where M is known before the shape: classical Runge-Kutta on the
// frame's columns, 4e5 steps a section, which holds 1e-8 L.
Vector3d tip_from_clamp_mm(const scene::Scene& scene) {
  using State = Eigen::Matrix<double, 3, 4>;  // R, r
  State y;
  y << Eigen::Matrix3d::Identity(), Vector3d::Zero();
  std::vector<double> cuts{0, 12, 22, 25, 40};
  for (std::size_t k = 0; k + 1 < cuts.size(); ++k) {
    const double middle = (cuts[k] + cuts[k + 1]) / 2;
    const scene::Stiffness& stiffness = scene::stiffness_of(scene.sections[middle < 12 ? 0 : middle < 22 ? 1 : 2]);
    const Vector3d K(stiffness.torsion_Nmm2, stiffness.bending_Nmm2[0], stiffness.bending_Nmm2[1]);
    Vector3d M = Vector3d::Zero();
    for (const scene::Load& load : scene.loads) {
      const auto& moment = std::get<scene::Moment>(load);
      if (moment.at_mm > middle) M += moment.value_Nmm;
    }
    const auto slope = [&](const State& at) {
      const Eigen::Matrix3d R = at.leftCols<3>();
      const Vector3d u = (R.transpose() * M).cwiseQuotient(K);
      State by;
      for (int column = 0; column < 3; ++column) by.col(column) = -R * Vector3d(Vector3d::Unit(column).cross(u));
      by.col(3) = R.col(0);
      return by;
    };
    constexpr int steps = 400'000;
    const double h = (cuts[k + 1] - cuts[k]) / steps;
    for (int step = 0; step < steps; ++step) {
      const State a = slope(y), b = slope(y + h / 2 * a), c = slope(y + h / 2 * b), d = slope(y + h * c);
      y += h / 6 * (a + 2 * b + 2 * c + d);
    }
  }
  return y.col(3);
}

// Nothing grows: a march from the clamp tells where Newton's method starts.
TEST(KnownMoments, AreSolvedAtOnce) {
  const scene::Scene scene = wound_rod();
  const Vector3d exact_mm = tip_from_clamp_mm(scene);
  const double limit_mm = 1e-6 * 40;
  EXPECT_LT((solved_tip_mm(scene, limit_mm) - exact_mm).norm(), limit_mm);
  fam::Options fine;
  fine.arcs = 32'000;
  const scene::Equilibrium once = fam::solve(scene, fine);
  ASSERT_TRUE(once.converged()) << once.message;
  for (const auto& [name, value] : once.model) {
    if (name == "load_steps") {
      EXPECT_EQ(std::get<int>(value), 1);
    }
    if (name == "newton_iterations") {
      EXPECT_LE(std::get<int>(value), 3);  // 2 measured
    }
  }
  EXPECT_GT((solved_tip_mm(support::stiffer(scene), limit_mm) - exact_mm).norm(), 100 * limit_mm);
}

// In the plane a circle, however often it goes round.
TEST(KnownMoments, InThePlane) {
  const double turn_rad = 300, radius_mm = 40 / turn_rad;
  const scene::Scene scene =
      uniform_rod(40, slender(750, 500), {scene::Moment{40, Frame::fixed, {0, 0, 750 / radius_mm}}});
  const Vector3d exact_mm = radius_mm * Vector3d(std::sin(turn_rad), 1 - std::cos(turn_rad), 0);
  EXPECT_LT((solved_tip_mm(scene, 1e-8) - exact_mm).norm(), 1e-8);
  EXPECT_GT((solved_tip_mm(support::stiffer(scene), 1e-8) - exact_mm).norm(), 1e-3);
}

TEST(KnownMoments, OnArcsTooLong) {
  fam::Options options;
  for (const int arcs : {6, 300}) {
    options.arcs = arcs;
    const scene::Equilibrium result = fam::solve(wound_rod(), options);
    EXPECT_EQ(result.status, scene::Status::arc_not_converged);
    EXPECT_EQ(result.message, "the arcs are too long for the turns of the rod, or these too many for round-off, with " +
                                  std::to_string(arcs) + " arcs");
  }
}

// The tangent of a straight round rod turns about the moment by |M|/EI, whatever GJ is.
Vector3d tip_of_round_rod_mm(double length_mm, double bending_Nmm2, const Vector3d& moment_Nmm) {
  const double turn_rad = moment_Nmm.norm() * length_mm / bending_Nmm2;
  const Vector3d axis = moment_Nmm.normalized(), along = axis[0] * axis, across = Vector3d::UnitX() - along;
  return length_mm * (along + std::sin(turn_rad) / turn_rad * across +
                      (1 - std::cos(turn_rad)) / turn_rad * axis.cross(Vector3d::UnitX()));
}

// Turns of up to 46 rad, which more arcs from too few of them led astray by 1.5 mm.
TEST(KnownMoments, OfASolverThatGoesOn) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> any_Nmm(-400, 400);
  const fam::Options options{.tolerance_mm = 1e-6};
  Vector3d moment_Nmm(200, 400, 299);
  auto made =
      fam::Solver::make(uniform_rod(100, slender(1500, 1000), {scene::Moment{100, Frame::fixed, moment_Nmm}}), options);
  ASSERT_TRUE(std::holds_alternative<fam::Solver>(made));
  fam::Solver& solver = std::get<fam::Solver>(made);
  for (int i = 0; i < 100; ++i) {
    ASSERT_TRUE(solver.solve().converged());
    EXPECT_LT((solver.tip().position_B_mm - tip_of_round_rod_mm(100, 1500, moment_Nmm)).norm(), 1e-6) << i;
    EXPECT_GT((solver.tip().position_B_mm - tip_of_round_rod_mm(100, 1.05 * 1500, moment_Nmm)).norm(), 1e-2) << i;
    EXPECT_LE(solver.error_estimate_mm(), 1e-6);
    EXPECT_EQ(solver.s_mm().size(), 2u) << "one arc is exact";
    moment_Nmm = i == 0 ? Vector3d(200, 400, 300) : Vector3d(any_Nmm(random), any_Nmm(random), any_Nmm(random));
    solver.set_moment_Nmm(0, moment_Nmm);
  }
}

// With a tendon a start is needed; limit: the tolerance, beside a solve a thousand times as tight.
TEST(KnownMoments, WithATendonASolverTakesNoShapeOfTooFewArcs) {
  const double tolerance_mm = 1e-3;
  for (const auto& [from, to, tension_N, to_mm] :
       {std::tuple{Vector3d(265, 102, 372), Vector3d(248, -364, -291), 3., 50.},
        {Vector3d(289, 87, 215), Vector3d(-305, 139, -373), 2., 100.},
        {Vector3d(278, -222, -373), Vector3d(-295, 389, -64), 5., 50.}}) {
    scene::Scene rod = uniform_rod(100, slender(1500, 1000),
                                   {scene::Moment{100, Frame::fixed, from}, scene::Tendon{{1.5, 0}, tension_N, to_mm}});
    auto made = fam::Solver::make(rod, {.tolerance_mm = tolerance_mm});
    ASSERT_TRUE(std::holds_alternative<fam::Solver>(made));
    fam::Solver& solver = std::get<fam::Solver>(made);
    ASSERT_TRUE(solver.solve().converged());
    solver.set_moment_Nmm(0, to);
    std::get<scene::Moment>(rod.loads[0]).value_Nmm = to;
    ASSERT_TRUE(solver.solve().converged());
    EXPECT_LT((solver.tip().position_B_mm - solved_tip_mm(rod, 1e-6)).norm(), tolerance_mm);
    EXPECT_GT((solver.tip().position_B_mm - solved_tip_mm(support::stiffer(rod), 1e-6)).norm(), 100 * tolerance_mm);
  }
}

// A force comes and goes in a kept solver: the moments are known, are not, and are again. The exact reference grows the
// same loads one after the other.
TEST(KnownMoments, OfASolverWhoseForceComesAndGoes) {
  scene::Scene scene =
      uniform_rod(40, scene::Stiffness{500, {750, 300}, {}, {}},
                  {scene::Moment{40, Frame::fixed, {20, 40, -50}}, scene::Force{40, Frame::fixed, Vector3d::Zero()}});
  auto made = fam::Solver::make(scene, {});
  ASSERT_TRUE(std::holds_alternative<fam::Solver>(made));
  fam::Solver& solver = std::get<fam::Solver>(made);
  std::vector<scene::Scene> way;
  for (const double size : {0.0, 1.0, 5.0, 0.0}) {
    const Vector3d force_N = size * Vector3d(-0.3, 1, 0.5);
    solver.set_force_N(1, force_N);
    std::get<scene::Force>(scene.loads[1]).value_N = force_N;
    if (size == 0) way.clear();
    way.push_back(scene);
    ASSERT_TRUE(solver.solve(fam::Solver::Start::last_solution).converged()) << size;
    const scene::Equilibrium exact = exact_reference::solve_along(way);
    ASSERT_TRUE(exact.converged()) << exact.message;
    EXPECT_LT((solver.tip().position_B_mm - exact.tip().position_B_mm).norm(), 1e-3 * 40) << size;
    const scene::Equilibrium stiffer = exact_reference::solve(support::stiffer(scene));
    EXPECT_GT((solver.tip().position_B_mm - stiffer.tip().position_B_mm).norm(), 1e-3 * 40) << size;
  }
}

}  // namespace
