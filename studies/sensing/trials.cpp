#include "studies/sensing/trials.h"

#include "fam/estimator.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>

namespace studies {
namespace {

constexpr std::uint64_t noise_seeds = 1'000'000;

// What one in a million of chi-squared numbers exceeds (Wilson and Hilferty).
double one_in_a_million(int degrees) {
  const double part = 2 / (9.0 * degrees);
  return degrees * std::pow(1 - part + 4.753 * std::sqrt(part), 3);
}

void state(scene::Measurement& measurement, double factor) {
  if (auto* position = std::get_if<scene::PositionMeasurement>(&measurement.value)) position->sd_mm *= factor;
  if (auto* rotation = std::get_if<scene::RotationMeasurement>(&measurement.value)) rotation->sd_rad *= factor;
}

// The true unknowns; of two contacts in the order in which they were found, for either may be called the first.
Eigen::VectorXd nearest_truth(const fam::Estimate& found, const SensingProblem& problem) {
  const auto& unknowns = problem.estimation.unknowns;
  const Eigen::Index half = problem.truth.size() / 2;
  const auto is_place = [](const scene::Unknown& unknown) { return unknown.kind == scene::Unknown::Kind::place; };
  const bool contacts = std::count_if(unknowns.begin(), unknowns.end(), is_place) == 2;
  if (!contacts || found.mean[half - 1] <= found.mean[2 * half - 1]) return problem.truth;
  Eigen::VectorXd swapped(2 * half);
  swapped << problem.truth.tail(half), problem.truth.head(half);
  return swapped;
}

// Sums, not yet means.
void count(const fam::Estimate& found, const SensingProblem& problem, SensingResult& sum) {
  ++sum.trials;
  if (!found.converged()) {
    ++sum.not_converged;
    return;
  }
  if (!found.unobservable.empty()) {
    ++sum.unobservable;
    return;
  }
  const Eigen::VectorXd off = found.mean - nearest_truth(found, problem);
  const double nees = off.dot(found.covariance.ldlt().solve(off));
  sum.nees += nees;
  sum.unfit += !found.fits;
  if (nees > one_in_a_million(sum.unknowns)) {
    ++sum.wrong;
    sum.wrong_and_fitting += found.fits;
  }
  for (Eigen::Index i = 0; i < off.size(); ++i) {
    if (problem.estimation.unknowns[static_cast<std::size_t>(i)].kind == scene::Unknown::Kind::place) {
      ++sum.places;
      sum.place_beyond_3sd += std::abs(off[i]) > 3 * found.sd[i];
      continue;
    }
    sum.error += off[i] * off[i];
    sum.predicted_sd += found.sd[i] * found.sd[i];
    const scene::Unknown& unknown = problem.estimation.unknowns[static_cast<std::size_t>(i)];
    if (unknown.kind == scene::Unknown::Kind::component && unknown.component > 0) {
      sum.error_across += off[i] * off[i];
      sum.predicted_across += found.sd[i] * found.sd[i];
    }
  }
}

SensingResult of_truth(const SensingSettings& settings, std::uint64_t seed, const std::filesystem::path& cases) {
  const SensingProblem problem =
      sensing_problem(settings.kind, seed, settings.noise, cases, settings.mismatch, settings.positions);
  SensingResult sum;
  sum.unknowns = static_cast<int>(problem.truth.size());
  Noise noise(noise_seeds + seed);
  for (int i = 0; i < settings.noises_each; ++i) {
    scene::EstimationProblem trial = problem.estimation;
    for (scene::MeasuredScene& measured : trial.scenes) {
      for (scene::Measurement& measurement : measured.measurements) {
        measurement = noisy(measurement, noise);
        state(measurement, settings.stated);
      }
    }
    count(fam::Estimator(trial, settings.options).estimate(), problem, sum);
  }
  return sum;
}

}  // namespace

double SensingResult::band() const {
  return 1.96 * std::sqrt(2.0 * unknowns / counted());
}

bool SensingResult::in_band() const {
  return std::abs(nees - unknowns) <= band();
}

SensingResult run_trials(const SensingSettings& settings, const std::filesystem::path& cases,
                         Progress::Style progress) {
  std::vector<SensingResult> parts(static_cast<std::size_t>(settings.truths));
  in_parallel(parts.size(), words_of(settings.kind).name, progress,
              [&](std::uint64_t i) { parts[i] = of_truth(settings, i + 1, cases); });
  SensingResult all;
  all.unknowns = parts[0].unknowns;
  for (const SensingResult& part : parts) {
    for (int SensingResult::*number :
         {&SensingResult::trials, &SensingResult::not_converged, &SensingResult::unobservable, &SensingResult::unfit,
          &SensingResult::wrong, &SensingResult::wrong_and_fitting, &SensingResult::place_beyond_3sd,
          &SensingResult::places})
      all.*number += part.*number;
    for (double SensingResult::*number :
         {&SensingResult::error, &SensingResult::predicted_sd, &SensingResult::error_across,
          &SensingResult::predicted_across, &SensingResult::nees})
      all.*number += part.*number;
  }
  for (double SensingResult::*number : {&SensingResult::error, &SensingResult::predicted_sd,
                                        &SensingResult::error_across, &SensingResult::predicted_across})
    all.*number = std::sqrt(all.*number / all.counted());
  all.nees /= all.counted();
  return all;
}

}  // namespace studies
