#include "studies/sensing/placed_load.h"

#include "fam/estimator.h"
#include "studies/scenes/sensing_problem.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace studies {
namespace {

constexpr int truths = 50, fixed_places = 98;
constexpr double clearly_lower = 0.05;  // of chi-squared; between two of the fixed places it may well be lower
constexpr double far_deviations = 4;    // one in 16 000 normal numbers is farther off

struct Count {
  int no_answer = 0, unobservable = 0, not_lowest = 0, unfit = 0, far_off = 0;
  double place_nees = 0;
};

// The lowest chi-squared of all fixed places.
double lowest_of_places(scene::EstimationProblem problem) {
  const scene::Unknown place = problem.unknowns.back();
  problem.unknowns.pop_back();
  const double rod_mm = scene::length_mm(problem.scenes[0].scene);
  double lowest = HUGE_VAL;
  for (int i = 1; i <= fixed_places; ++i) {
    scene::put(problem, place, rod_mm * i / fixed_places);
    const fam::Estimate found = fam::Estimator(problem).estimate();
    if (found.converged()) lowest = std::min(lowest, found.chi_squared);
  }
  return lowest;
}

Count judged(Sensing kind, int sensors, double noise, std::uint64_t seed, const std::filesystem::path& cases) {
  SensingProblem problem = sensing_problem(kind, seed, noise, cases, Mismatch::none, sensors);
  Noise random(1'000'000 + seed);
  for (scene::Measurement& measurement : problem.estimation.scenes[0].measurements)
    measurement = noisy(measurement, random);
  const fam::Estimate found = fam::Estimator(problem.estimation).estimate();
  Count count;
  count.no_answer = !found.converged();
  if (!found.converged()) return count;
  count.not_lowest = found.chi_squared > lowest_of_places(problem.estimation) + clearly_lower;
  count.unfit = !found.fits;
  const Eigen::Index place = found.mean.size() - 1;
  count.unobservable = !found.observable.back();
  if (!found.observable.back()) return count;
  const double off = std::abs(found.mean[place] - problem.truth[place]) / found.sd[place];
  count.far_off = off > far_deviations;
  count.place_nees = off * off;
  return count;
}

}  // namespace

PlacedLoads placed_loads(const std::filesystem::path& cases, Progress::Style progress) {
  PlacedLoads result{
      Table({"load", "sensors", "noise, 1/mm", "trials", "no answer", "not at the lowest chi-squared",
             "chi-squared too large", "place not observable", "place over 4 sd off", "NEES of the place"})};
  for (const Sensing kind : {Sensing::placed_force, Sensing::placed_moment}) {
    for (const int sensors : {3, 5, 10, 20}) {
      for (const double noise : words_of(kind).noises) {
        std::vector<Count> counts(truths);
        in_parallel(counts.size(), words_of(kind).name, progress,
                    [&](std::uint64_t i) { counts[i] = judged(kind, sensors, noise, i + 1, cases); });
        Count all;
        for (const Count& one : counts) {
          for (int Count::*number :
               {&Count::no_answer, &Count::unobservable, &Count::not_lowest, &Count::unfit, &Count::far_off})
            all.*number += one.*number;
          all.place_nees += one.place_nees;
        }
        result.trials += truths;
        result.no_answer += all.no_answer;
        result.unobservable += all.unobservable;
        result.not_lowest += all.not_lowest;
        result.far_off += all.far_off;
        const int placed = truths - all.no_answer - all.unobservable;
        result.table.add({kind == Sensing::placed_force ? "force" : "moment", std::to_string(sensors),
                          fmt::format("{:g}", noise), std::to_string(truths), std::to_string(all.no_answer),
                          std::to_string(all.not_lowest), std::to_string(all.unfit), std::to_string(all.unobservable),
                          std::to_string(all.far_off), placed > 0 ? significant(all.place_nees / placed, 2) : "-"});
      }
    }
  }
  return result;
}

}  // namespace studies
