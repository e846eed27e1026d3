#include "studies/population/targets.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace studies {
namespace {

// Which of a row's numbers are asked for; the size is the MAE, or the RMS.
struct RowUse {
  bool size, mean, ratio;
  Statistic size_statistic;
};

RowUse use_of(const Targets& targets, std::size_t row) {
  const bool has_mae = targets.of[place_of(row, mean_absolute)].has_value();
  const bool has_rms = targets.of[place_of(row, root_mean_square)].has_value();
  const bool has_mean = targets.of[place_of(row, mean_error)].has_value();
  return {has_mae || has_rms, (has_mae || has_rms) && has_mean, has_mae && has_rms,
          has_mae ? mean_absolute : root_mean_square};
}

double log_of(double error_mm, const Targets& targets) {
  return std::log(std::max(error_mm, targets.least_error_mm));
}

// visit(interval) of each feature, in their order.
template <class Visit>
void for_features(const Targets& targets, Visit&& visit) {
  for (std::size_t row = 0; row < row_count; ++row) {
    const RowUse use = use_of(targets, row);
    if (!use.size) continue;
    const Interval size = *targets.of[place_of(row, use.size_statistic)];
    const double low = std::max(size.low, targets.least_error_mm), high = std::max(size.high, targets.least_error_mm);
    visit(Interval{std::log(low), std::log(high)});
    if (use.mean) {
      const Interval m = *targets.of[place_of(row, mean_error)];
      const double least = std::min(m.low / low, m.low / high), most = std::max(m.high / low, m.high / high);
      visit(Interval{std::clamp(least, -1., 1.), std::clamp(most, -1., 1.)});
    }
    if (use.ratio) {
      const Interval rms = *targets.of[place_of(row, root_mean_square)];
      const double least = std::max(log_of(rms.low, targets) - std::log(high), 0.);
      visit(Interval{least, std::max(log_of(rms.high, targets) - std::log(low), least)});
    }
  }
}

}  // namespace

Eigen::VectorXd features_of(const StatisticVector& set, const Targets& targets) {
  std::vector<double> features;
  for (std::size_t row = 0; row < row_count; ++row) {
    const RowUse use = use_of(targets, row);
    if (!use.size) continue;
    const double size = std::max(set[place_of(row, use.size_statistic)], targets.least_error_mm);
    features.push_back(std::log(size));
    if (use.mean) features.push_back(set[place_of(row, mean_error)] / size);
    if (use.ratio) features.push_back(log_of(set[place_of(row, root_mean_square)], targets) - std::log(size));
  }
  return Eigen::Map<Eigen::VectorXd>(features.data(), static_cast<Eigen::Index>(features.size()));
}

SetCloud::SetCloud(const std::vector<StatisticVector>& sets, const Targets& targets) {
  std::vector<Eigen::VectorXd> points;
  for (const StatisticVector& set : sets) points.push_back(features_of(set, targets));
  const Eigen::Index size = points.front().size();
  mean_ = Eigen::VectorXd::Zero(size);
  for (const Eigen::VectorXd& point : points) mean_ += point / static_cast<double>(points.size());
  Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(size, size);
  for (const Eigen::VectorXd& point : points)
    covariance += (point - mean_) * (point - mean_).transpose() / static_cast<double>(points.size());
  constexpr double shrinkage = 0.1, least_variance = 1e-12;
  const Eigen::VectorXd variances = covariance.diagonal().cwiseMax(least_variance);
  covariance *= 1 - shrinkage;
  covariance.diagonal() = variances;
  precision_ = covariance.ldlt().solve(Eigen::MatrixXd::Identity(size, size));
  for (const Eigen::VectorXd& point : points) own_.push_back(distance(point));
  std::sort(own_.begin(), own_.end());
}

double SetCloud::distance(const Eigen::VectorXd& features) const {
  const Eigen::VectorXd from_mean = features - mean_;
  return std::sqrt(std::max(from_mean.dot(precision_ * from_mean), 0.));
}

// A convex quadratic form over a box: coordinate by coordinate. 15 of them settle to nine digits within 200 rounds.
double SetCloud::distance_of(const Targets& targets) const {
  std::vector<Interval> box;
  for_features(targets, [&](const Interval& interval) { box.push_back(interval); });
  Eigen::VectorXd point(mean_.size());
  for (Eigen::Index i = 0; i < point.size(); ++i) {
    const Interval& bounds = box[static_cast<std::size_t>(i)];
    point[i] = std::clamp(mean_[i], bounds.low, bounds.high);
  }
  for (int round = 0; round < 200; ++round) {
    for (Eigen::Index i = 0; i < point.size(); ++i) {
      const Interval& bounds = box[static_cast<std::size_t>(i)];
      const double slope = precision_.row(i).dot(point - mean_);
      point[i] = std::clamp(point[i] - slope / precision_(i, i), bounds.low, bounds.high);
    }
  }
  return distance(point);
}

double SetCloud::own(double share) const {
  const double place = std::ceil(share * static_cast<double>(own_.size())) - 1;
  return own_[static_cast<std::size_t>(std::max(place, 0.))];
}

double SetCloud::share_farther(double distance) const {
  const auto first = std::upper_bound(own_.begin(), own_.end(), distance);
  return static_cast<double>(own_.end() - first) / static_cast<double>(own_.size());
}

const char* name(PrintVerdict verdict) {
  static constexpr std::array names = {"excluded", "strained", "fits"};
  return names[static_cast<std::size_t>(verdict)];
}

PrintJudgement judge_print(const std::vector<StatisticVector>& sets, const Targets& targets) {
  PrintJudgement result;
  result.sets = sets.size();
  if (sets.empty()) return result;
  const SetCloud cloud(sets, targets);
  result.distance = cloud.distance_of(targets);
  result.own_999 = cloud.own(excluded_beyond);
  result.share_farther = cloud.share_farther(result.distance);
  result.nearest = std::numeric_limits<double>::infinity();
  for (const StatisticVector& set : sets) {
    const double deviation = largest_deviation(set, targets);
    result.within_20 += deviation <= 0.2;
    result.within_50 += deviation <= 0.5;
    result.nearest = std::min(result.nearest, deviation);
  }
  result.verdict = result.distance > result.own_999         ? PrintVerdict::excluded
                   : result.share_farther < 1 - fits_within ? PrintVerdict::strained
                                                            : PrintVerdict::fits;
  return result;
}

}  // namespace studies
