// Random scenes that end without an answer, and why; the study's files as pure functions of it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace studies {

// The population: 100 000 general random scenes and 10 000 rods that buckle (random_scene.h).
constexpr std::uint64_t limit_scenes = 110'000;
std::uint64_t limit_seed(std::uint64_t index);

// A scene that fam::solve, asked for 1e-4 L, gives no answer to.
struct Unanswered {
  std::uint64_t seed = 0;
  bool has_energy = true;
  std::string status;
  double load_factor = 0;  // of limit_point
  std::string judge;       // status of the exact reference, asked on a sample; empty: not asked
  double judge_factor = 0;

  bool is_limit() const { return status == "limit_point"; }
  bool collapsed() const { return status == "tendon_collapsed"; }
  bool is_numerical() const { return !is_limit() && !collapsed(); }
};

// Load factors that agree: the exact reference's is located to 1e-9, FAM's as its tolerance allows.
constexpr double same_factor = 1e-3;

std::string unanswered_csv(const std::vector<Unanswered>& scenes);
std::vector<Unanswered> read_unanswered(const std::filesystem::path& file);
std::map<std::string, std::string> limit_files(const std::vector<Unanswered>& scenes,
                                               const std::filesystem::path& page_md);

}  // namespace studies
