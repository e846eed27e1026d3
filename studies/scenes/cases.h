// The scene files of studies/cases and the names of Study I's load cases.
#pragma once

#include "scene/scene.h"

#include <filesystem>
#include <string>
#include <vector>

namespace studies {

// A scene of the folder by its path without ending ("study1/P4_follower").
scene::Scene read_case(const std::filesystem::path& cases, const std::string& name);

// The names of all scene files of a folder ("robots"), sorted.
std::vector<std::string> cases_in(const std::filesystem::path& cases, const std::string& folder);

// P1..P8 (planar) and S1..S8 (spatial); files study1/P1_follower.json, study1/P1_fixed.json, ...
std::vector<std::string> study1_cases();
std::vector<std::string> study1_cases(bool planar);
bool is_planar(const std::string& load_case);

// The load of a case file as this kind, null if it is of another: a study knows which kinds its own files hold. Only
// the studies that tests/load_kind names ask so; all else answers for every kind (scene/load_visitor.h).
template <class Kind, class AnyLoad>
auto* known_load(AnyLoad& load) {
  return std::get_if<Kind>(&load);
}

}  // namespace studies
