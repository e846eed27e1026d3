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
  // A moment on a node in space, with 20 elements and with 40: from the rod whose moment keeps its axis, and whose
  // moment follows the section; how far these two are apart.
  double from_fixed_mm[2] = {}, from_follower_mm[2] = {}, frames_apart_mm = 0;
  // A small force at the tip of a circle and of a tube: its way by CalculiX over the exact one, at ν = 0 and 0.3.
  double circle_way[2] = {}, tube_way[2] = {};
};

inline const std::string calculix_key = "calculix", abaqus_key = "abaqus";

bool calculix_is_there();
// The tip as CalculiX prints it (seven digits), with its time; the deck and its output in a folder of their own.
ThirdPartyTip solve_by_calculix(const scene::Scene& scene, int elements);
ThirdPartyTip solve_by_calculix(const scene::Scene& scene, const std::string& deck_text, int elements);

std::map<std::string, std::string> third_party_files(const ThirdPartyData& data, const std::filesystem::path& page_md);

}  // namespace studies
