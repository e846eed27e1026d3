// What the stream gave, and its files as pure functions of it.
#pragma once

#include <Eigen/Core>

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace studies {

// One of the solves that the exact reference judges.
struct StreamSample {
  int solve;
  double tensions_N[2];
  Eigen::Vector3d force_N, tip_mm;
  Eigen::Vector3d exact_tip_mm = Eigen::Vector3d::Zero();

  double error_mm() const { return (tip_mm - exact_tip_mm).norm(); }
};

struct StreamData {
  double length_mm = 0, tolerance_mm = 0;
  std::vector<StreamSample> samples;
  // Of the walk: a time for each solve, with its Jacobians.
  std::vector<double> latency_us;
  int not_converged = 0, without_slopes = 0;  // the latter: a derivative that is not finite
  long allocations = -1;                      // -1: not counted

  double largest_error_mm() const;
};

std::string stream_accuracy_csv(const StreamData& data);
std::string stream_latency_csv(const StreamData& data);
std::string stream_latency_picture(const StreamData& data);
std::map<std::string, std::string> stream_pages(const StreamData& data, const StreamData& of_tube,
                                                const std::filesystem::path& page_md);

}  // namespace studies
