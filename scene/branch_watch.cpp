#include "scene/branch_watch.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace scene {
namespace {

constexpr double share_of_zero = 0.8;  // chosen, not measured
// Of the square of log_growth, which is 4 F L^2/EI of a round rod: pushed so far one is not critical. Of 10 000 random
// walks those of 8 ended on another branch without it.
constexpr double beyond_slack = 1;
// To a fifth or so. None of 11 800 scenes of fam is led astray with 0.7, 1.5 or 3, which take 0.59, 0.56 and 0.54 of
// the time that all steps take near one.
constexpr double critical_fall = 1.5;
// Of the way ahead, by which a fold's load may shift; chosen, not measured. Of 17 000 strips, columns and arches none
// is taken for one that snaps with three in a row, but of 29 487 steps of random walks two with four; with six none.
constexpr double fold_shift = 0.1;
constexpr int fold_sightings = 6;

}  // namespace

double log_fall(const Determinant& from, const Determinant& to) {
  const double fall = from.log_size - to.log_size;
  return std::min(fall, fall - (from.log_growth - to.log_growth));
}

bool has_fallen(const Determinant& start, const Determinant& now) {
  return start.negative != now.negative || !(log_fall(start, now) < critical_fall);
}

bool BranchWatch::has_left(const Determinant& now) const {
  return points_ > 0 && now.negative != last_.determinant.negative;
}

double BranchWatch::longest_step(double from_load_factor) const {
  double longest = std::numeric_limits<double>::infinity();
  if (points_ < 2 || before_.determinant.negative != last_.determinant.negative) return longest;
  const auto &before = before_.determinant, &last = last_.determinant;
  const double step = last_.load_factor - before_.load_factor, since = last_.load_factor - from_load_factor;
  const double fall = std::expm1(log_fall(before, last)) / step;
  if (fall > 0) longest = share_of_zero / fall + share_of_zero * since;
  const double taut = last.log_growth * last.log_growth;  // as the tension
  const double slackening = (before.log_growth * before.log_growth - taut) / step;
  if (slackening > 0) longest = std::min(longest, (taut + beyond_slack) / slackening + since);
  return longest;
}

// With x from the last load on, the determinant over the last one is 1 - slope x - bend x^2.
double BranchWatch::longest_bent_step(double from_load_factor) const {
  constexpr double none = std::numeric_limits<double>::infinity();
  const Determinant& last = last_.determinant;
  if (points_ < 3 || before_.determinant.negative != last.negative || earlier_.determinant.negative != last.negative)
    return none;
  const double step = last_.load_factor - before_.load_factor, two = last_.load_factor - earlier_.load_factor;
  const double fall = std::expm1(log_fall(before_.determinant, last)) / step;
  const double bend = (fall - std::expm1(log_fall(earlier_.determinant, last)) / two) / (two - step);
  if (!(bend > 0)) return none;
  const double slope = fall + bend * step;
  const double zero = 2 / (slope + std::sqrt(slope * slope + 4 * bend));
  return share_of_zero * (zero + last_.load_factor - from_load_factor);
}

bool BranchWatch::nears_fold_before(double load_factor) const {
  return fold_.times_held >= fold_sightings && fold_.load_factor + fold_shift * fold_.ahead < load_factor;
}

void BranchWatch::keep(double load_factor, const Determinant& now) {
  earlier_ = before_;
  before_ = last_;
  last_ = {load_factor, now};
  ++points_;
  look_for_fold();
}

// Over a short step any line leads to about the same load as the last one: foretold anew from at most half as far.
void BranchWatch::look_for_fold() {
  const bool falls = points_ > 1 && before_.determinant.negative == last_.determinant.negative;
  const double fall = falls ? std::expm1(2 * log_fall(before_.determinant, last_.determinant)) : 0;
  if (!(fall > 0)) {
    fold_ = {};
    return;
  }
  const double ahead = (last_.load_factor - before_.load_factor) / fall, load_factor = last_.load_factor + ahead;
  const bool is_held = std::abs(load_factor - fold_.load_factor) <= fold_shift * fold_.ahead;
  if (is_held && ahead > fold_.ahead / 2) return;
  fold_ = {load_factor, ahead, is_held ? fold_.times_held + 1 : 0};
}

}  // namespace scene
