#include "fem_reference/solve.h"
#include "studies/population/data.h"

#include <algorithm>
#include <cmath>

namespace studies {
namespace {

constexpr int planar_cases_printed = 8;

Interval rounding_of(double value, double unit) {
  const double shown = std::round(value / unit) * unit;
  return {shown - unit / 2, shown + unit / 2};
}

}  // namespace

std::vector<StatisticVector> PopulationSample::sets_of(std::size_t mechanism, std::optional<LoadPrior> prior) const {
  std::vector<StatisticVector> sets;
  const auto& all = of_mechanism[mechanism];
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (all[i] && (!prior || all_load_priors[i % all_load_priors.size()] == *prior)) sets.push_back(*all[i]);
  }
  return sets;
}

PopulationSample sample_population(const PopulationRod& rod, std::uint64_t sets, Progress::Style progress) {
  const std::vector<Mechanism>& mechanisms = all_mechanisms();
  PopulationSample sample;
  sample.of_mechanism.assign(mechanisms.size(), std::vector<std::optional<StatisticVector>>(sets));
  sample.redrawn.resize(sets);
  in_parallel(sets, "population", progress, [&](std::uint64_t i) {
    const LoadSet set = load_set(rod, i);
    sample.redrawn[i] = set.redrawn;
    for (std::size_t m = 0; m < mechanisms.size(); ++m) {
      if (const auto errors = tip_errors_mm(mechanisms[m], rod, set))
        sample.of_mechanism[m][i] = statistics_of(*errors, static_cast<std::size_t>(rod.planar_cases));
    }
  });
  return sample;
}

PrintedStudy as_printed(const StatisticVector& statistics) {
  PrintedStudy study;
  for (std::size_t i = 0; i < statistic_count; ++i) {
    const bool is_rms = i < row_count * in_row && i % in_row == root_mean_square;
    study.printed[i] = rounding_of(statistics[i], is_rms ? 1e-4 : 1e-2);
  }
  return study;
}

std::vector<TwinTrial> trace_back(const PopulationSample& sample, std::uint64_t trials) {
  const std::vector<Mechanism>& mechanisms = all_mechanisms();
  const Targets any = reconciled(printed_study1());  // all statistics given: the clouds are the same for all trials
  std::vector<SetCloud> clouds;
  for (std::size_t m = 0; m < mechanisms.size(); ++m) clouds.emplace_back(sample.sets_of(m), any);
  const PopulationRod rod;
  std::vector<TwinTrial> result(trials);
  for (std::uint64_t trial = 0; trial < trials; ++trial) {
    TwinTrial& twin = result[trial];
    twin.mechanism = trial * 7 % mechanisms.size();  // all of them, neighbours apart
    const LoadSet set = load_set(rod, first_twin + trial);
    const auto errors = tip_errors_mm(mechanisms[twin.mechanism], rod, set);
    if (!errors) continue;
    const Targets targets = reconciled(as_printed(statistics_of(*errors, planar_cases_printed)));
    for (std::size_t m = 0; m < mechanisms.size(); ++m) {
      const double distance = clouds[m].distance_of(targets), own = clouds[m].own(excluded_beyond);
      twin.survivors += distance <= own;
      if (m != twin.mechanism) continue;
      twin.traced_back = distance <= own;
      twin.distance = distance;
      twin.own_999 = own;
    }
  }
  return result;
}

std::vector<TrendCount> count_trends(std::uint64_t sets, Progress::Style progress) {
  const std::vector<Mechanism>& mechanisms = all_mechanisms();
  const PopulationRod rod;
  std::vector<std::vector<MechanismTrend>> trends(sets);
  in_parallel(sets, "trends", progress, [&](std::uint64_t i) {
    const LoadSet set = load_set(rod, i);
    for (const Mechanism& mechanism : mechanisms) trends[i].push_back(trend_of(mechanism, rod, set));
  });
  std::vector<TrendCount> counts(mechanisms.size());
  for (const auto& of_set : trends) {
    for (std::size_t m = 0; m < mechanisms.size(); ++m) {
      const MechanismTrend& t = of_set[m];
      TrendCount& count = counts[m];
      count.sets += t.answered;
      count.under_3_mm += t.under_3_mm;
      count.minimum_near_12 += t.minimum_near_12;
      count.rises += t.rises;
      count.all_three += t.under_3_mm && t.minimum_near_12 && t.rises;
      count.grows_with_torque += t.grows_with_torque;
    }
  }
  return counts;
}

double beam_distance_mm(const PopulationRod& rod, const LoadSet& set, const TipCase& c, Side side, std::string& status,
                        Eigen::Vector3d& beam_tip_mm) {
  fem_reference::Options options;
  options.elements = 50;
  options.estimate_error = false;
  const scene::Equilibrium beam =
      fem_reference::solve(scene_of(rod.length_mm, set.stiffness_of(c), c.load, side), options);
  status = scene::name(beam.status);
  if (!beam.converged()) return NAN;
  beam_tip_mm = beam.tip().position_B_mm;
  return (beam_tip_mm - c.tip_of(side)).norm();
}

// One case of each of many sets, the sides with shear in turn.
std::vector<BeamCheck> check_against_beam(Progress::Style progress) {
  static constexpr std::array sides = {Side::follower, Side::fixed, Side::fixed_moment, Side::fixed_force};
  const PopulationRod rod;
  std::vector<BeamCheck> checks(check_cases);
  in_parallel(check_cases, "beam", progress, [&](std::uint64_t i) {
    const LoadSet set = load_set(rod, first_check + i);
    const std::size_t place = i * 5 % set.cases.size();
    BeamCheck check{first_check + i, place, sides[i / 2 % sides.size()], 0, ""};
    Eigen::Vector3d tip;
    check.distance_mm = beam_distance_mm(rod, set, set.cases[place], check.side, check.status, tip);
    checks[i] = check;
  });
  return checks;
}

std::vector<BeamStatistics> check_statistics(Progress::Style progress) {
  const PopulationRod rod;
  const Mechanism& law = all_mechanisms()[mechanism_at("arcs_12")];
  std::vector<BeamStatistics> checks(check_sets);
  in_parallel(check_sets, "beam", progress, [&](std::uint64_t i) {
    LoadSet set = load_set(rod, i);
    checks[i].set = i;
    checks[i].by_stand_in = statistics_of(*tip_errors_mm(law, rod, set), planar_cases_printed);
    for (TipCase& c : set.cases) {
      std::string status;
      Eigen::Vector3d tip = Eigen::Vector3d::Constant(NAN);
      beam_distance_mm(rod, set, c, Side::follower, status, tip);
      c.tip_mm[static_cast<std::size_t>(Side::follower)] = tip;
    }
    checks[i].by_beam = statistics_of(*tip_errors_mm(law, rod, set), planar_cases_printed);
  });
  return checks;
}

}  // namespace studies
