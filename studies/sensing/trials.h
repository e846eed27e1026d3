// Many noisy estimates of problems with known answers, and whether they are as sure as they say.
#pragma once

#include "studies/scenes/sensing_problem.h"

#include "fam/options.h"
#include "studies/report/progress.h"

namespace studies {

struct SensingSettings {
  Sensing kind = Sensing::four_positions;
  double noise = 0.01;
  int truths = 1, noises_each = 1;
  Mismatch mismatch = Mismatch::none;
  int positions = 4;
  double stated = 1;          // the deviations that the estimator is told, over those of the noise
  fam::Options options = {};  // of its model
};

// The share of the trials; errors of the forces alone (of calibration: of the factors).
struct SensingResult {
  int unknowns = 0, trials = 0, not_converged = 0, unobservable = 0, unfit = 0;
  int wrong = 0, wrong_and_fitting = 0;  // a NEES that one in a million exceeds; with a chi-squared that passes
  int place_beyond_3sd = 0, places = 0;
  // Root mean squares of the length of the error of all unknowns that are no places, and of what is predicted of it; of
  // the components of forces across the unloaded rod alone.
  double error = 0, predicted_sd = 0, error_across = 0, predicted_across = 0;
  double nees = 0;  // mean of (x - truth) P^-1 (x - truth) of those counted

  int counted() const { return trials - not_converged - unobservable; }
  double band() const;  // 1.96 deviations of the mean NEES about the number of unknowns
  bool in_band() const;
};

// Every trial starts from nothing known. Seeds: 1, 2, ... of the truths, those and 10^6 of their noise.
SensingResult run_trials(const SensingSettings& settings, const std::filesystem::path& cases,
                         Progress::Style progress = Progress::Style::quiet);

}  // namespace studies
