// The certificate of another method's answer, beside the exact reference's distance from it.
#include "exact_reference/certificate.h"
#include "exact_reference/solve.h"
#include "fam/solve.h"
#include "scene/scene_file.h"
#include "studies/campaign/judged.h"
#include "studies/campaign/kinds.h"
#include "studies/compare/error_measures.h"
#include "studies/methods/rk4_method.h"
#include "studies/scenes/random_scene.h"
#include "support.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

namespace {

using exact_reference::Certificate;
using exact_reference::certify;
using scene::Equilibrium;

Equilibrium by_fam(const scene::Scene& scene, double tolerance, int arcs = 0) {
  fam::Options options;
  options.tolerance_mm = tolerance * scene::length_mm(scene);
  options.arcs = arcs;
  return fam::solve(scene, options);
}

// An independent origin of the distance: the exact reference's own solve, which grows the loads, to 1e-9 L.
TEST(Certificate, TellsTheDistanceFromTheExactShape) {
  int certified = 0;
  for (std::uint64_t index = 0; index < 100; ++index) {
    const scene::Scene scene = studies::random_scene(studies::campaign_seed(11, index));
    const double length_mm = scene::length_mm(scene);
    const Equilibrium answer = by_fam(scene, 1e-3);
    if (!answer.converged()) continue;
    const Certificate certificate = certify(scene, answer, 1e-7);
    if (!certificate.is_near(1e-2) || certificate.branch == Certificate::Branch::doubtful) continue;
    const Equilibrium exact = exact_reference::solve(scene, {exact_reference::RodModel::reissner, 1e-9});
    if (!exact.converged()) continue;
    ++certified;
    EXPECT_NEAR(certificate.position, studies::largest_distance_mm(answer, exact) / length_mm, 3e-5) << index;
  }
  EXPECT_GE(certified, 85);  // of 100; 89 when this was written: the others are doubted, or have no answer
}

TEST(Certificate, SeesAStifferRod) {
  for (const std::string& load_case : support::study1_cases()) {
    for (const std::string frame : {"fixed", "follower"}) {
      const scene::Scene scene = support::study1_scene(load_case, frame);
      const Certificate right = certify(scene, by_fam(scene, 1e-6), 1e-9);
      EXPECT_TRUE(right.found) << load_case << frame << ": " << right.message;
      EXPECT_LE(right.position, 2e-6) << load_case << frame;
      const Certificate stiffer = certify(scene, by_fam(support::stiffer(scene), 1e-6), 1e-9);
      EXPECT_GT(stiffer.position, 1e-3) << load_case << frame;  // 0.005 to 0.1 of the length
    }
  }
}

// Moments fixed in space alone leave one equilibrium, however large (the equations from the clamp are an initial value
// problem); with a force beside them, or a moment that follows, there may be others.
TEST(Certificate, KnownMomentsLeaveOneEquilibrium) {
  const std::vector<scene::Load> moments = {scene::Moment{20, scene::Frame::fixed, {30, -20, 10}},
                                            scene::Moment{40, scene::Frame::fixed, {20, 140, -90}}};
  const auto certified = [&](const std::vector<scene::Load>& more) {
    std::vector<scene::Load> loads = moments;
    loads.insert(loads.end(), more.begin(), more.end());
    const scene::Scene scene = support::uniform_rod(40, scene::Stiffness{500, {750, 300}, {}, {}, 0}, loads);
    return certify(scene, by_fam(scene, 1e-6), 1e-9);
  };
  const Certificate alone = certified({});
  EXPECT_TRUE(alone.found) << alone.message;
  EXPECT_LE(alone.position, 2e-6);
  EXPECT_EQ(alone.branch, Certificate::Branch::alone);
  EXPECT_NE(certified({scene::Force{40, scene::Frame::fixed, {-0.1, 0.2, 0}}}).branch, Certificate::Branch::alone);
  EXPECT_NE(certified({scene::Moment{30, scene::Frame::follower, {1, 2, 3}}}).branch, Certificate::Branch::alone);
}

// Equilibria that plain shooting found on these scenes, 0.2 to 1.8 L from those that the growing load leads to (exact
// reference).
TEST(Certificate, DoubtsEquilibriaOnOtherBranches) {
  int found = 0;
  for (const std::uint64_t index : {115, 147, 295, 539, 775, 835, 895, 1045, 1073, 1105}) {
    const scene::Scene scene = studies::random_scene(studies::campaign_seed(7, index));
    const Equilibrium answer = studies::rk4_method({200, true})->solve(scene);
    if (!answer.converged()) continue;
    const Certificate certificate = certify(scene, answer, 1e-7);
    found += certificate.found && certificate.position < 1e-3;
    EXPECT_EQ(certificate.branch, Certificate::Branch::doubtful) << index;
  }
  EXPECT_GE(found, 8);
}

// Of these stable ones of the audit (plain shooting's, 0.1 to 0.2 L off) neither energy nor determinant tells; FAM's
// answers are those that the exact reference's growing load leads to.
TEST(Certificate, WalksBackFromTheRightBranchAlone) {
  for (const std::uint64_t index : {26'367, 26'391, 40'433}) {
    const scene::Scene scene = studies::random_scene(studies::campaign_seed(2, index));
    const Certificate other = certify(scene, studies::rk4_method({200, true})->solve(scene), 1e-7);
    EXPECT_TRUE(other.found) << index;
    EXPECT_EQ(other.branch, Certificate::Branch::doubtful) << index;
    const Certificate right = certify(scene, by_fam(scene, 1e-6), 1e-7);
    EXPECT_EQ(right.branch, Certificate::Branch::walked) << index;
    EXPECT_LE(right.position, 2e-6) << index;
  }
}

constexpr double column_mm = 100, column_Nmm2 = 1500;
constexpr double euler_N = 2.4674011002723395 * column_Nmm2 / (column_mm * column_mm);  // pi^2/4

// Pressed by twice Euler's load.
scene::Scene column(double aside_N) {
  return support::uniform_rod(column_mm, support::slender(column_Nmm2, 1000),
                              {scene::Force{column_mm, scene::Frame::fixed, {-2 * euler_N, aside_N, 0}}});
}

// So many sections that a path back takes too much work.
scene::Scene in_sections(scene::Scene scene, int count) {
  scene.sections.front().length_mm /= count;
  scene.sections.resize(static_cast<std::size_t>(count), scene.sections.front());
  return scene;
}

TEST(Certificate, HasSignsAloneWhereThePathBackTakesTooMuchWork) {
  const scene::Scene bent = in_sections(column(1e-3 * euler_N), 70), straight = in_sections(column(0), 70);
  const Certificate by_signs = certify(bent, by_fam(bent, 1e-6), 1e-8);
  EXPECT_EQ(by_signs.branch, Certificate::Branch::signs);
  EXPECT_LE(by_signs.position, 2e-6);
  EXPECT_FALSE(by_signs.holds(1e-2));
  EXPECT_EQ(certify(straight, by_fam(straight, 1e-6), 1e-8).branch, Certificate::Branch::doubtful);
}

// Of a rod soft in torsion under some EI/L^2 two stable equilibria lie 8e-4 L apart, with the same signs: plain
// shooting ends on the one that the growing load does not lead to.
TEST(Certificate, DoesNotHoldBySignsAlone) {
  const scene::Scene scene = studies::random_scene(studies::campaign_seed(2, 39'029));
  const Equilibrium other = studies::rk4_method({200, true})->solve(scene);
  const Certificate certificate = certify(scene, other, 1e-7);
  EXPECT_TRUE(certificate.is_near(3e-4));
  EXPECT_EQ(certificate.branch, Certificate::Branch::signs);
  EXPECT_FALSE(certificate.holds(3e-4));
  const auto exact = exact_reference::solve(scene, {exact_reference::RodModel::reissner, 1e-9});
  EXPECT_GT(studies::largest_distance_mm(other, exact) / scene::length_mm(scene), 5e-4);
}

// Straight: a true equilibrium, unstable; bent: the right one; bent to the other side: stable, but none that the load
// leads to.
TEST(Certificate, DoubtsAnUnstableColumn) {
  const scene::Scene pushed = column(1e-3 * euler_N);
  EXPECT_TRUE(certify(pushed, by_fam(pushed, 1e-6), 1e-8).holds(1e-5));
  Equilibrium mirrored = by_fam(column(-1e-3 * euler_N), 1e-6);  // stable too, and the determinant's sign is the same
  const Certificate straight = certify(column(0), by_fam(column(0), 1e-6), 1e-8);
  EXPECT_TRUE(straight.found);
  EXPECT_EQ(straight.branch, Certificate::Branch::doubtful);
  const Certificate other_side = certify(pushed, mirrored, 1e-8);
  EXPECT_GT(other_side.position, 1e-4);
  EXPECT_EQ(other_side.branch, Certificate::Branch::doubtful);
}

TEST(Certificate, NeedsAStationWhereLoadsStand) {
  scene::Scene scene =
      support::uniform_rod(40, support::slender(1500, 1000), {scene::Force{17.3, scene::Frame::fixed, {0, 0.3, 0}}});
  Equilibrium answer = by_fam(scene, 1e-6);
  EXPECT_TRUE(certify(scene, answer, 1e-8).holds(1e-5));
  std::erase_if(answer.stations, [](const scene::Station& s) { return std::abs(s.s_mm - 17.3) < 1e-6; });
  const Certificate certificate = certify(scene, answer, 1e-8);
  EXPECT_FALSE(certificate.found);
  EXPECT_NE(certificate.message.find("no station"), std::string::npos) << certificate.message;
}

// A coil of thousands of turns, along which the errors of a march add up to 7e-2 L at a tolerance of 1e-9: the exact
// reference said "converged" and blamed FAM's answer, the nearer one.
TEST(Judged, AReferenceThatIsNoBetterDoesNotJudge) {
  const scene::Scene scene = studies::random_scene(studies::campaign_seed(1, 313'088));
  const auto exact = exact_reference::solve(scene, {exact_reference::RodModel::reissner, 1e-9});
  EXPECT_EQ(exact.status, scene::Status::not_converged);
  EXPECT_NE(exact.message.find("differ by"), std::string::npos) << exact.message;
  fam::Options options;
  options.tolerance_mm = 1e-4 * scene::length_mm(scene);
  EXPECT_FALSE(studies::judged(scene, fam::solve(scene, options), 3e-4, true).by_exact());
}

// The worst answers to a million random scenes (tests/data/campaign), 1e-4 L asked for: no place of a rod is farther
// off the exact reference's than 3e-4 L, the campaign's limit; that of a stiffer twin is.
TEST(Judged, WorstOfAMillion) {
  int count = 0;
  for (const auto& file : std::filesystem::directory_iterator(std::string(TEST_DATA_DIR) + "/campaign")) {
    const scene::Scene scene = scene::read_scene_file(file.path().string());
    const Equilibrium exact = exact_reference::solve(scene, {exact_reference::RodModel::reissner, 1e-9});
    ASSERT_TRUE(exact.converged()) << file.path();
    const auto off = [&](const scene::Scene& asked) {
      const Equilibrium found = by_fam(asked, 1e-4);
      EXPECT_TRUE(found.converged()) << file.path();
      return studies::largest_distance_mm(found, exact) / scene::length_mm(scene);
    };
    EXPECT_LT(off(scene), 3e-4) << file.path();
    EXPECT_GT(off(support::stiffer(scene)), 3e-4) << file.path();
    ++count;
  }
  EXPECT_EQ(count, 13);
}

// Where the certificate judges, errors up to its tolerance are its own: a rod under an end moment (index 968 073) is a
// circle, which one arc holds to round-off. The worst coil is off by more than it estimates.
TEST(Judged, ItsOwnErrorIsNotTheAnswers) {
  const studies::CampaignKind& random = studies::campaign_kind("random");
  const auto has_share = [&](std::uint64_t index) {
    const std::vector<studies::Measure> measures = random.outcome(1, index).measures;
    return std::any_of(measures.begin(), measures.end(), [](const auto& m) { return m.name == "error / estimate"; });
  };
  const scene::Scene scene = studies::random_scene(studies::campaign_seed(1, 968'073));
  EXPECT_GT(studies::judged(scene, by_fam(scene, 1e-4), 3e-4, false).position, 3e-9);
  EXPECT_LT(studies::judged(scene, by_fam(scene, 1e-4), 3e-4, true).position, 3e-9);
  EXPECT_FALSE(has_share(968'073));
  EXPECT_TRUE(has_share(292'988));
}

}  // namespace

// Steps that shrink end within round-off of the fold: on the first of these scenes the search from there met another
// one, at 18.5 % of the load, on the second none. FAM's path is the independent origin.
TEST(ExactLimit, IsTheFoldThatTheLoadMeets) {
  for (const std::uint64_t seed : {102872, 100048}) {
    const scene::Scene scene = studies::random_scene(seed);
    const Equilibrium exact = exact_reference::solve(scene), fam = by_fam(scene, 1e-6);
    ASSERT_TRUE(exact.limit && fam.limit) << seed << " " << exact.message << " " << fam.message;
    EXPECT_NEAR(exact.limit->load_factor, fam.limit->load_factor, 1e-5) << seed;
    const Equilibrium stiffer = exact_reference::solve(support::stiffer(scene));
    EXPECT_TRUE(!stiffer.limit || std::abs(stiffer.limit->load_factor - fam.limit->load_factor) > 1e-3) << seed;
  }
}
