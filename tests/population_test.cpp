// The study `population`: its own march against fam's published law, its rod against the beam of finite elements,
// printed statistics as intervals, and known mechanisms traced back.
#include "commands.h"
#include "fam/solve.h"
#include "studies/population/data.h"

#include <gtest/gtest.h>

#include <fstream>

using namespace studies;
using Eigen::Vector3d;

namespace {

const PopulationRod rod;

const Mechanism& mechanism(const std::string& key) {
  return all_mechanisms()[mechanism_at(key)];
}

// fam's own, of the same case.
Vector3d library_tip_mm(const LoadSet& set, const TipCase& c, int arcs, fam::TwistOrder order) {
  fam::Options options;
  options.law = fam::Law::published;
  options.model = fam::RodModel::kirchhoff;
  options.arcs = arcs;
  options.twist_order = order;
  options.estimate_error = false;
  const scene::Equilibrium answer =
      fam::solve(scene_of(rod.length_mm, set.stiffness_of(c), c.load, Side::follower), options);
  return answer.converged() ? answer.tip().position_B_mm : Vector3d::Constant(NAN);
}

// Largest distance of the study's march from the library, mm, over 9 sets; infinite where one has no answer.
double march_distance_mm(const ProgramSlips& slips, int arcs) {
  double largest = 0;
  for (std::uint64_t i = 0; i < 9; ++i) {
    const LoadSet set = load_set(rod, i);
    for (const TipCase& c : set.cases) {
      const scene::Stiffness& s = set.stiffness_of(c);
      Vector3d tip;
      if (!published_tip({rod.length_mm, s.bending_Nmm2[0], s.torsion_Nmm2, c.load.force_N, c.load.moment_Nmm}, arcs,
                         slips, tip))
        return HUGE_VAL;
      const double distance_mm = (tip - library_tip_mm(set, c, arcs, slips.order)).norm();
      if (!std::isfinite(distance_mm)) return HUGE_VAL;
      largest = std::max(largest, distance_mm);
    }
  }
  return largest;
}

ProgramSlips weak(const Weakness& weakness) {
  ProgramSlips slips;
  slips.weakness = weakness;
  return slips;
}

// Measured: 7e-14 mm with 12 arcs. A search of the study's own ends elsewhere within its tolerance.
TEST(Population, MarchWithoutSlipsIsTheLibrarys) {
  constexpr double limit_mm = 1e-11;
  EXPECT_LT(march_distance_mm({}, 12), limit_mm);
  EXPECT_LT(march_distance_mm({}, 3), limit_mm);
  EXPECT_LT(march_distance_mm({.order = fam::TwistOrder::twist_bend}, 12), limit_mm);
  EXPECT_LT(march_distance_mm(weak({.tolerance = 1e-12}), 12), 1e-8);
  const double single_mm = march_distance_mm(weak({.single_precision = true}), 12);
  EXPECT_LT(single_mm, 1e-3);
  EXPECT_GT(single_mm, 1e-7);
}

// Twins: every slip moves a tip by far more than the march may differ.
TEST(Population, SlipsAreSeen) {
  for (const Mechanism& m : all_mechanisms()) {
    const bool slips = m.slips.without_torsion || m.slips.distal_plane || m.slips.middle_arm ||
                       m.slips.weakness.straight_in_arc || m.slips.weakness.straight_to_next ||
                       m.slips.weakness.tolerance > 0;
    if (slips) {
      EXPECT_GT(march_distance_mm(m.slips, m.arcs), 1e-3) << m.key;
    }
  }
}

// The rod that stands in for finite elements and the deal.II beam of 50 quadratic elements, on some of the cases of
// results/population/beam_cases.csv.
double largest_beam_distance_mm(double stiffer) {
  double largest = 0;
  const Side sides[] = {Side::follower, Side::fixed, Side::fixed_moment, Side::fixed_force};
  for (std::uint64_t i = 0; i < 8; ++i) {
    LoadSet set = load_set(rod, first_check + i);
    const TipCase c = set.cases[i * 2];
    set.planar_stiffness.bending_Nmm2 *= stiffer;
    set.spatial_stiffness.bending_Nmm2 *= stiffer;
    std::string status;
    Vector3d tip;
    const double distance_mm = beam_distance_mm(rod, set, c, sides[i / 2], status, tip);
    EXPECT_EQ(status, "converged") << i;
    largest = std::max(largest, distance_mm);
  }
  return largest;
}

TEST(Population, StandInIsTheBeam) {
  EXPECT_LT(largest_beam_distance_mm(1), beam_limit_mm);
  EXPECT_GT(largest_beam_distance_mm(1.05), 100 * beam_limit_mm);
}

TEST(Population, SidesHaveTheFramesOfTheirNames) {
  const auto frames = [](Side side) {
    const scene::Scene scene = scene_of(40, {}, {}, side);
    return std::pair(std::get<scene::Force>(scene.loads[0]).frame, std::get<scene::Moment>(scene.loads[1]).frame);
  };
  using scene::Frame;
  EXPECT_EQ(frames(Side::follower), std::pair(Frame::follower, Frame::follower));
  EXPECT_EQ(frames(Side::follower_kirchhoff), std::pair(Frame::follower, Frame::follower));
  EXPECT_EQ(frames(Side::fixed), std::pair(Frame::fixed, Frame::fixed));
  EXPECT_EQ(frames(Side::fixed_kirchhoff), std::pair(Frame::fixed, Frame::fixed));
  EXPECT_EQ(frames(Side::fixed_moment), std::pair(Frame::follower, Frame::fixed));
  EXPECT_EQ(frames(Side::fixed_force), std::pair(Frame::fixed, Frame::follower));
}

TEST(Population, SetsAreWhatTheyAreSaidToBe) {
  for (std::uint64_t i = 0; i < 12; ++i) {
    const LoadSet set = load_set(rod, i);
    ASSERT_EQ(set.cases.size(), 16U);
    EXPECT_EQ(set.prior, all_load_priors[i % 3]);
    EXPECT_NEAR(set.planar_stiffness.bending_Nmm2[0], 750, 1e-9);
    EXPECT_NEAR(set.spatial_stiffness.bending_Nmm2[0], 1500, 1e-9);
    for (std::size_t k = 0; k < 16; ++k) {
      const TipCase& c = set.cases[k];
      EXPECT_EQ(c.load.planar, k < 8);
      const double moved = (c.tip_of(Side::follower) - Vector3d(40, 0, 0)).norm() / 40;
      EXPECT_GE(moved, 0.0499);
      EXPECT_LE(moved, 1.001);
      if (k < 8) {
        EXPECT_EQ(c.tip_of(Side::fixed)[2], 0);
      }
    }
  }
}

// The paper's planar x: by mean -0.27 and SD 0.90 one RMS is 0.88; printed is 0.4865.
TEST(Population, RowsThatContradictThemselvesAreIntervals) {
  const Targets targets = reconciled(printed_study1());
  const Interval rms = *targets.of[place_of(0, root_mean_square)];
  EXPECT_LE(rms.low, 0.4865);
  EXPECT_GE(rms.high, std::sqrt(0.27 * 0.27 + 7 / 8. * 0.90 * 0.90));
  const Interval mean = *targets.of[place_of(0, mean_error)];
  EXPECT_NEAR(mean.high - mean.low, 0.01, 1e-12);  // as printed

  // Of eight numbers that are consistent nothing is left but the rounding and the two ways of taking an SD.
  const LoadSet set = load_set(rod, 0);
  const StatisticVector own = statistics_of(*tip_errors_mm(mechanism("arcs_3"), rod, set), 8);
  const Targets consistent = reconciled(as_printed(own));
  EXPECT_LT(largest_deviation(own, consistent), 1e-9);
  for (std::size_t row = 0; row < row_count; ++row) {
    const Interval taken = *consistent.of[place_of(row, root_mean_square)];
    EXPECT_LE(taken.high, own[place_of(row, root_mean_square)] * std::sqrt(8 / 7.) + 0.011) << row;
    EXPECT_GE(taken.low, own[place_of(row, root_mean_square)] - 0.011) << row;
  }
}

// Errors whose statistics are known by hand.
TEST(Population, StatisticsAreThoseOfTheErrors) {
  std::vector<Vector3d> errors(16, Vector3d(1, -2, 0));
  errors[0] = {-1, -2, 0};
  const StatisticVector s = statistics_of(errors, 8);
  EXPECT_DOUBLE_EQ(s[place_of(0, mean_error)], 0.75);
  EXPECT_DOUBLE_EQ(s[place_of(0, mean_absolute)], 1);
  EXPECT_DOUBLE_EQ(s[place_of(0, root_mean_square)], 1);
  EXPECT_NEAR(s[place_of(0, deviation)], std::sqrt(0.5), 1e-15);
  EXPECT_DOUBLE_EQ(s[place_of(3, mean_error)], -2);
  EXPECT_NEAR(s[row_count * in_row], (6 + 8 - 32 + 0) / 40., 1e-15);
}

// Known mechanisms and loads are traced back, here over 600 sets and in 40 trials (the study: 10 000 and 100).
class TracedBack : public testing::Test {
 protected:
  static const PopulationSample& sample() {
    static const PopulationSample once = sample_population(rod, 600, Progress::Style::quiet);
    return once;
  }
};

TEST_F(TracedBack, MechanismIsAmongThoseLeft) {
  const std::vector<TwinTrial> trials = trace_back(sample(), 40);
  const auto traced = std::count_if(trials.begin(), trials.end(), [](const TwinTrial& t) { return t.traced_back; });
  EXPECT_GE(traced, 38);
}

// Twins that must fail: of the law with 50 arcs no set has errors ten times as large, nor all of one sign and size.
TEST_F(TracedBack, OtherErrorsAreExcluded) {
  const std::vector<StatisticVector> sets = sample().sets_of(mechanism_at("arcs_50"), LoadPrior::deflection);
  StatisticVector large = sets[1], alike = sets[1];
  for (double& value : large) value *= 10;
  for (std::size_t row = 0; row < row_count; ++row) {
    const double size = alike[place_of(row, mean_absolute)];
    alike[place_of(row, mean_error)] = alike[place_of(row, root_mean_square)] = size;
    alike[place_of(row, deviation)] = alike[place_of(row, absolute_deviation)] = 0;
  }
  EXPECT_NE(judge_print(sets, reconciled(as_printed(sets[1]))).verdict, PrintVerdict::excluded);
  EXPECT_EQ(judge_print(sets, reconciled(as_printed(large))).verdict, PrintVerdict::excluded);
  EXPECT_EQ(judge_print(sets, reconciled(as_printed(alike))).verdict, PrintVerdict::excluded);
}

// Of intervals that hold two sets, the nearest point is no farther than either.
TEST_F(TracedBack, IntervalsCountByTheirNearestPoint) {
  const std::vector<StatisticVector> sets = sample().sets_of(mechanism_at("arcs_12"));
  const Targets any = reconciled(printed_study1());
  const SetCloud cloud(sets, any);
  for (std::size_t i = 0; i + 1 < 200; ++i) {
    Targets both;
    for (std::size_t k = 0; k < statistic_count; ++k)
      both.of[k] = Interval{std::min(sets[i][k], sets[i + 1][k]), std::max(sets[i][k], sets[i + 1][k])};
    const double nearest = cloud.distance_of(both);
    EXPECT_LE(nearest, cloud.distance(features_of(sets[i], any)) + 1e-9) << i;
    EXPECT_LE(nearest, cloud.distance(features_of(sets[i + 1], any)) + 1e-9) << i;
  }
}

// Whatever thread takes which set.
TEST_F(TracedBack, RepeatsToTheBit) {
  const PopulationSample again = sample_population(rod, 30, Progress::Style::quiet);
  for (std::size_t m = 0; m < all_mechanisms().size(); ++m) {
    for (std::size_t i = 0; i < 30; ++i) EXPECT_EQ(again.of_mechanism[m][i], sample().of_mechanism[m][i]);
  }
}

// --- The command -----------------------------------------------------------------------------------------------------

commands::Outcome judged(const std::string& json) {
  std::ofstream(commands::scratch() / "printed.json") << json;
  return commands::run("cd " + commands::scratch().string() + " && " + commands::fam_studies,
                       "population --quick --quiet --statistic printed.json");
}

TEST(PopulationCommand, WrongStatisticsAreRefusedInOneLine) {
  const std::vector<std::pair<std::string, std::string>> wrong = {
      {R"({"rows": []})", "rows = []: must hold a row at least"},
      {R"({})", "rows = (missing): the key is required"},
      {R"({"rows": [{"set": "plane", "axis": "x", "rms_mm": 1}]})",
       R"(rows[0].set = "plane": must be "planar" or "spatial")"},
      {R"({"rows": [{"set": "planar", "axis": "x", "mean_mm": 1}]})", "must say how large the errors are"},
      {R"({"rows": [{"set": "planar", "axis": "x", "rms_mm": -1}]})", "rows[0].rms_mm = -1: must be >= 0"},
      {R"({"rows": [{"set": "planar", "axis": "x", "rms_mm": [2, 1]}]})", "low <= high"},
      {R"({"rows": [{"set": "planar", "axis": "x", "rms_mm": 1, "rms": 1}]})", "rows[0].rms = 1: unknown key"},
      {R"({"rod": {"planar_cases": 1}, "rows": []})", "rod.planar_cases = 1: must be a whole number from 2"},
      {R"({"rod": {"length_mm": 0}, "rows": []})", "rod.length_mm = 0: must be > 0"},
      {R"({"rows": [{"set": "planar", "axis": "x", "rms_mm": 1}, {"set": "planar", "axis": "x", "rms_mm": 1}]})",
       "given twice"}};
  for (const auto& [json, line] : wrong) {
    const commands::Outcome refused = judged(json);
    EXPECT_EQ(refused.exit_status, 2) << json;
    EXPECT_NE(refused.err.find(line), std::string::npos) << refused.err;
    EXPECT_EQ(refused.err.rfind("printed.json: ", 0), 0U) << refused.err;
    EXPECT_EQ(std::count(refused.err.begin(), refused.err.end(), '\n'), 1) << refused.err;
  }
}

TEST(PopulationCommand, PageSaysHowManySets) {
  const std::string page = commands::contents(std::string(TEST_DATA_DIR) + "/../../docs/population.md");
  EXPECT_EQ(population_sets, 10'000U);
  EXPECT_NE(page.find("10 000"), std::string::npos);
  EXPECT_NE(page.find("| 0.005: two decimals |"), std::string::npos);
  EXPECT_EQ(PrintedStudy().rounding_mm, 0.005);
}

// Errors of a micrometre are none of a program without torsion.
TEST(PopulationCommand, JudgesStatistics) {
  const commands::Outcome answer =
      judged(R"({"rows": [{"set": "spatial", "axis": "y", "mean_mm": 0, "mae_mm": [0.0005, 0.002]}]})");
  EXPECT_EQ(answer.exit_status, 0) << answer.err;
  const std::size_t from = answer.out.find("\nno_torsion_12,all,300,");
  ASSERT_NE(from, std::string::npos);
  const std::string row = answer.out.substr(from, answer.out.find('\n', from + 1) - from);
  EXPECT_EQ(row.substr(row.rfind(',') + 1), "excluded") << row;
}

}  // namespace
