// What `fam solve` says of random scenes whose growing load it loses, beside the exact reference. Origins stand beside
// the numbers.
#include "exact_reference/solve.h"
#include "fam/batch.h"
#include "fam/path.h"
#include "fam/solve.h"
#include "fam/tolerance.h"
#include "studies/scenes/random_scene.h"
#include "support.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

namespace {

using scene::Equilibrium;
using scene::Status;

Equilibrium solved(const scene::Scene& scene, double share_of_length) {
  fam::Options options;
  options.tolerance_mm = share_of_length * scene::length_mm(scene);
  return fam::solve(scene, options);
}

// Columns next to round and straight, far beyond Euler's load: the branch on which they buckle passes straight ones
// within 1e-8 of a turn. The exact reference, which grows loads, finds nothing next to these shares.
TEST(Limit, OfColumnsNextToRoundAndStraight) {
  for (const auto& [seed, share] :
       {std::pair{101460, 0.219714}, {104216, 0.391565}, {105718, 0.830413}, {107200, 0.193577}}) {
    SCOPED_TRACE(seed);
    const scene::Scene column = studies::random_scene(static_cast<std::uint64_t>(seed));
    const Equilibrium snapped = solved(column, 1e-4);
    EXPECT_EQ(snapped.status, Status::limit_point) << snapped.message;
    ASSERT_TRUE(snapped.limit);
    EXPECT_NEAR(snapped.limit->load_factor / share, 1, 1e-4);
    const Equilibrium stiffer = solved(support::stiffer(column), 1e-4);
    if (stiffer.limit) {
      EXPECT_GT(std::abs(stiffer.limit->load_factor / share - 1), 0.01);
    }
  }
}

TEST(Limit, IsWhyARowOfABatchFails) {
  const scene::Scene rod = studies::random_scene(studies::campaign_seed(4710, 1949));
  EXPECT_EQ(fam::solve_batch(rod, {}, fam::RowMajorMatrix(1, 0)).status[0], Status::limit_point);
}

// A path that cannot start says why as a solve does.
TEST(Limit, IsWhyAPathDoesNotStart) {
  scene::PathRequest request;
  request.scene = studies::random_scene(studies::campaign_seed(4710, 1949));
  request.from = 1;
  request.to = 1.1;
  const scene::Path none = fam::Path::follow(request).points();
  EXPECT_EQ(none.status, scene::PathStatus::not_started);
  EXPECT_EQ(none.message, "limit_point: " + fam::solve(request.scene).message);
  request.from = 0.8;  // it snaps at 0.862570
  EXPECT_NE(fam::Path::follow(request).points().status, scene::PathStatus::not_started);
}

// A soft rod whose path, followed in segments of 4 load lengths, leads to another equilibrium under the full load.
// Limit 1e-6; the exact reference meets the fold at 0.862570.
TEST(Limit, OfASoftRodIsTheExactReferences) {
  const scene::Scene rod = studies::random_scene(studies::campaign_seed(4710, 1949));
  const Equilibrium snapped = solved(rod, 1e-4), exact = exact_reference::solve(rod, {});
  ASSERT_EQ(snapped.status, Status::limit_point) << snapped.message;
  ASSERT_EQ(exact.status, Status::limit_point) << exact.message;
  EXPECT_NEAR(snapped.limit->load_factor, exact.limit->load_factor, 1e-6);
  const Equilibrium stiffer = solved(support::stiffer(rod), 1e-4);
  ASSERT_TRUE(stiffer.limit);
  EXPECT_GT(std::abs(stiffer.limit->load_factor - exact.limit->load_factor), 0.01);
}

void expect_exact_tip(const scene::Scene& scene) {
  const Equilibrium found = solved(scene, 1e-4), exact = exact_reference::solve(scene, {});
  ASSERT_TRUE(exact.converged()) << exact.message;
  ASSERT_TRUE(found.converged()) << found.message;
  const double length_mm = scene::length_mm(scene);
  EXPECT_LT((found.tip().position_B_mm - exact.tip().position_B_mm).norm(), 1e-4 * length_mm);
  const Equilibrium stiffer = solved(support::stiffer(scene), 1e-4);
  if (stiffer.converged()) {
    EXPECT_GT((stiffer.tip().position_B_mm - exact.tip().position_B_mm).norm(), 1e-3 * length_mm);
  }
}

// Who follows the path has no use for a fold with more arcs.
TEST(Limit, TheFirstArcsThatMeetAFoldEndTheGrowth) {
  fam::Problem problem;
  const scene::Scene rod = studies::random_scene(studies::campaign_seed(20260701, 365));
  fam::Options options;
  options.tolerance_mm = 1e-4 * scene::length_mm(rod);
  problem.set(rod, options);
  fam::Run one, another;
  const fam::Found first = solve_to_tolerance(problem, one, another, true);
  EXPECT_EQ(first.status, Status::load_step_too_small);
  EXPECT_TRUE(first.run->engine.nears_fold());
  const int arcs = first.run->arc_count();
  const fam::Found last = solve_to_tolerance(problem, one, another);
  EXPECT_EQ(last.status, Status::load_step_too_small);
  EXPECT_LE(2 * arcs, last.run->arc_count());
}

// Two and four arcs meet one where the path, and so more arcs, know none.
TEST(Limit, AFoldOfFewArcsIsNone) {
  for (const std::uint64_t seed : {202u, 1476u}) {
    const scene::Scene rod = studies::random_scene(seed);
    fam::Problem problem;
    fam::Options options;
    options.tolerance_mm = 1e-5 * scene::length_mm(rod);
    problem.set(rod, options);
    fam::Run one, another;
    EXPECT_TRUE(solve_to_tolerance(problem, one, another, true).run->engine.nears_fold());
    const Equilibrium found = fam::solve(rod, options);
    ASSERT_TRUE(found.converged()) << found.message;
    const auto is_by_path = [](const auto& fact) {
      const auto* text = std::get_if<std::string>(&fact.second);
      return text && text->find("its path followed") != std::string::npos;
    };
    EXPECT_TRUE(std::none_of(found.model.begin(), found.model.end(), is_by_path));
    const Equilibrium exact = exact_reference::solve(rod);
    EXPECT_LT((found.tip().position_B_mm - exact.tip().position_B_mm).norm(), options.tolerance_mm);
  }
}

// Its path, followed by arc length, leads to the full load.
TEST(Limit, IsNoneWhereThePathArrives) {
  expect_exact_tip(studies::random_scene(40160));
}

// The path keeps 1e-4 L, what it arrives at the tolerance asked for.
TEST(Limit, WhereThePathArrivesTheToleranceIsKept) {
  const scene::Scene scene = studies::random_scene(40160);
  const double tolerance_mm = 1e-5 * scene::length_mm(scene);
  const Equilibrium found = solved(scene, 1e-5), exact = exact_reference::solve(scene, {});
  ASSERT_TRUE(found.converged() && exact.converged());
  EXPECT_LE(found.error_estimate_mm, tolerance_mm);
  EXPECT_LT((found.tip().position_B_mm - exact.tip().position_B_mm).norm(), tolerance_mm);
}

// The energy of its sections has a kink where a tendon's path has no length, next to its minimum.
TEST(Limit, IsNoneWhereATendonIsShort) {
  expect_exact_tip(studies::random_scene(95800));
}

TEST(Limit, OfATendonWithoutLength) {
  const Equilibrium collapsed = solved(studies::random_scene(94100), 1e-4);
  EXPECT_EQ(collapsed.status, Status::tendon_collapsed);
  EXPECT_FALSE(collapsed.limit);
  EXPECT_NE(collapsed.message.find("|v + u x r| = 0, at 70 % of the load"), std::string::npos) << collapsed.message;
}

// Rods of a campaign whose loads led FAM to another equilibrium than they lead the exact reference.
void expect_the_exact_branch(std::uint64_t index) {
  const scene::Scene scene = studies::random_scene(studies::campaign_seed(1, index));
  const Equilibrium answer = solved(scene, 1e-3), exact = exact_reference::solve(scene);
  ASSERT_TRUE(answer.converged() && exact.converged());
  EXPECT_LT((answer.tip().position_B_mm - exact.tip().position_B_mm).norm(), 1e-3 * scene::length_mm(scene));
}

// A short soft section at the clamp is a hinge: int sqrt(F/EI) ds is 1.46, below pi/2, and yet the rod has a second
// stable equilibrium 1.59 L away, where Newton's method ends from the unloaded rod (the finite elements have the other
// one).
TEST(LoadGrowth, AHingeAtTheClampIsNotSolvedAtOnce) {
  expect_the_exact_branch(349'653);
}

// A thin strip beside sections three hundred times as stiff in torsion: where Newton's steps do not fall by half its
// end was taken, 0.026 L away.
TEST(LoadGrowth, NewtonStepsThatDoNotFallAreRefused) {
  expect_the_exact_branch(96'054);
}

}  // namespace
