// What every study driver takes.
#pragma once

#include "studies/compare/stopwatch.h"
#include "studies/report/progress.h"

#include <filesystem>
#include <string>

namespace studies {

struct StudyOptions {
  std::filesystem::path output = "results";  // each study writes a folder of its own in it
  std::filesystem::path cases;               // folder of the scene files
  std::filesystem::path data;                // folder of the published numbers
  std::filesystem::path pages;               // folder of the studies' folders with their page.md
  std::filesystem::path committed;           // results/ as the project holds it
  bool quick = false;                        // the smallest setting that still runs every line
  Progress::Style progress = Progress::Style::lines;
  std::size_t (*allocations)() = nullptr;  // so far, where the program counts them
};

// The time of a solve; with --quick one run, of which nothing is claimed.
inline Timing time_of(const StudyOptions& options, const std::function<void()>& work, double budget_s = 0.05) {
  return options.quick ? measure(work, 0, 1) : measure(work, budget_s);
}

}  // namespace studies
