// The studies: one row each in registry.cpp, which makes its command, its folder of results and its line in --list.
#pragma once

#include "studies/study.h"

#include <span>

namespace studies {

struct Study {
  std::string folder;    // of results/; the sources stand in the folder of the same name
  const char* question;  // that it answers
  const char* time;      // that it takes on two cores
  bool full;             // takes too long for `all`: needs --full, else the committed run stays
  void (*run)(const StudyOptions&);

  std::string command() const;  // the folder with - for _
};

std::span<const Study> all_studies();

// results/README.md from index.md and the answers (answers.json) of the studies whose results are there.
void write_index(const StudyOptions& options);

}  // namespace studies
