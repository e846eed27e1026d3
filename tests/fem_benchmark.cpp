#include "fem_benchmark.h"

#include "scene/scene_file.h"

#include <gtest/gtest.h>
#include <Eigen/Geometry>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <fstream>
#include <sstream>

namespace fem_benchmark {

namespace {

Eigen::Vector3d vector(const nlohmann::json& json) {
  return {json.at(0).get<double>(), json.at(1).get<double>(), json.at(2).get<double>()};
}

Benchmark benchmark(const nlohmann::json& json) {
  std::istringstream text(json.at("scene").dump());
  Benchmark result{scene::read_scene(text, json.at("scene").at("title")), {}, {}, {}};
  result.tip.X_BS.position_B_mm = vector(json.at("tip_mm"));
  for (int row = 0; row < 3; ++row) {
    result.tip.X_BS.rotation_BS.row(row) = vector(json.at("rotation").at(static_cast<std::size_t>(row)));
  }
  const bool tendons = json.contains("base_own_force_N");
  result.base_force_N = vector(json.at(tendons ? "base_own_force_N" : "base_force_N"));
  result.base_moment_Nmm = vector(json.at(tendons ? "base_own_moment_Nmm" : "base_moment_Nmm"));
  return result;
}

}  // namespace

fem_reference::Options bare(int elements, int order) {
  fem_reference::Options options;
  options.elements = elements;
  options.order = order;
  options.estimate_error = false;
  return options;
}

scene::Equilibrium solved(const scene::Scene& scene, const fem_reference::Options& options) {
  scene::Equilibrium found = fem_reference::solve(scene, options);
  EXPECT_TRUE(found.converged()) << scene.title << ": " << scene::name(found.status) << ": " << found.message;
  if (!found.converged()) found.stations.resize(1);  // lets a failed expectation go on to the next
  return found;
}

std::vector<Benchmark> read_benchmarks(const std::string& file) {
  std::ifstream stream(std::string(TEST_DATA_DIR) + "/" + file);
  EXPECT_TRUE(stream.good()) << file;
  std::vector<Benchmark> result;
  for (const nlohmann::json& json : nlohmann::json::parse(stream)) result.push_back(benchmark(json));
  return result;
}

double error(const scene::Equilibrium& found, const Benchmark& exact) {
  const scene::Pose& tip = found.tip();
  const scene::Pose& right = exact.tip.X_BS;
  return std::max({(tip.position_B_mm - right.position_B_mm).norm() / scene::length_mm(exact.scene),
                   (tip.rotation_BS - right.rotation_BS).norm(),
                   (found.base().force_B_N - exact.base_force_N).norm() / exact.base_force_N.norm(),
                   (found.base().moment_B_Nmm - exact.base_moment_Nmm).norm() / exact.base_moment_Nmm.norm()});
}

scene::Equilibrium fine(const scene::Scene& scene) {
  return solved(scene, bare(160, 3));
}

double largest_error_mm(const scene::Equilibrium& found, const scene::Equilibrium& fine) {
  double largest_mm = 0;
  std::size_t k = 0, compared = 0;
  for (const scene::Station& station : found.stations) {
    while (k < fine.stations.size() && fine.stations[k].s_mm < station.s_mm - 1e-9) ++k;
    if (k == fine.stations.size() || fine.stations[k].s_mm > station.s_mm + 1e-9) continue;
    largest_mm = std::max(largest_mm, (station.X_BS.position_B_mm - fine.stations[k].X_BS.position_B_mm).norm());
    ++compared;
  }
  EXPECT_GE(compared, 41U);
  return largest_mm;
}

Eigen::Vector3d turn(const Eigen::Matrix3d& from, const Eigen::Matrix3d& to) {
  const Eigen::AngleAxisd rotation(Eigen::Matrix3d(from.transpose() * to));
  return rotation.angle() * rotation.axis();
}

}  // namespace fem_benchmark
