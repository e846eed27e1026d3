// What CalculiX makes of our scenes, beside the exact reference; the study's files as pure functions of it.
#pragma once

#include "scene/scene.h"

#include <filesystem>
#include <map>
#include <vector>

namespace studies {

struct ThirdPartyTip {
  std::string load_case, method;
  int elements = 0;  // 0: not counted
  std::string status;
  double load_share = 1;  // that it reached
  Eigen::Vector3d position_mm = Eigen::Vector3d::Zero();
  double error_over_L = 0;  // distance from the exact tip
  double time_us = 0;
};

struct ThirdPartyData {
  bool has_calculix = false;
  std::vector<ThirdPartyTip> tips;
  double moment_error_mm = 0, moment_frames_apart_mm = 0;  // of the small moment in space
};

inline const std::string calculix_key = "calculix", abaqus_key = "abaqus";

bool calculix_is_there();
// The tip as CalculiX prints it (seven digits), with its time; the deck and its output in a folder of their own.
ThirdPartyTip solve_by_calculix(const scene::Scene& scene, int elements);

std::map<std::string, std::string> third_party_files(const ThirdPartyData& data, const std::filesystem::path& page_md);

}  // namespace studies
