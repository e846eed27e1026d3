// What every study driver takes and tells.
#pragma once

#include "scene/scene.h"

#include <filesystem>
#include <string>
#include <vector>

namespace studies {

struct StudyOptions {
  std::filesystem::path output = "results";  // each study writes a folder of its own in it
  std::filesystem::path cases;               // folder of the scene files
  std::filesystem::path data;                // folder of the published numbers
  bool quick = false;                        // the smallest setting that still runs every line
};

// Says on standard error what a study is at.
void progress(const std::string& study, const std::string& what);

// A scene of studies/cases by its file name without ending.
scene::Scene read_case(const StudyOptions& options, const std::string& name);

// results/README.md: the headlines (<study>/headline.md) of the studies whose results are there.
void write_index(const std::filesystem::path& output);

}  // namespace studies
