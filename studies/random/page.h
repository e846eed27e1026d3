// Tables, picture and page of the random scenes as pure functions of what was found.
#pragma once

#include "studies/random/outcomes.h"
#include "studies/random/promise.h"

#include <filesystem>
#include <map>

namespace studies {

struct RandomData {
  std::vector<RandomOutcome> outcomes;
  std::vector<Promise> promises, estimates;
};

// File name to content: counts.csv (outcomes by kind of load and method) and failures.csv (every listed outcome).
std::map<std::string, std::string> outcome_tables(const std::vector<RandomOutcome>& outcomes);
// promise.csv (every scene), tolerances.csv, kinds.csv, unsolved.csv, promise.svg.
std::map<std::string, std::string> promise_tables(const std::vector<Promise>& promises);
// estimates.csv (by kind) and estimates_low.csv: every estimate below half the error.
std::map<std::string, std::string> estimate_tables(const std::vector<Promise>& promises);

// All of these, README.md from page.md, and answers.json.
std::map<std::string, std::string> random_files(const RandomData& data, const std::filesystem::path& page_md);

}  // namespace studies
