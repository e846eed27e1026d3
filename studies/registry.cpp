#include "studies/registry.h"

#include "studies/report/output_file.h"
#include "studies/report/page.h"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <regex>

namespace studies {

// A row a study: folder and function (void f(const StudyOptions&), in studies/f/f.cpp), the question it answers, the
// time it takes, whether it runs with --full only. In the order in which they run.
// clang-format off
#define STUDY_ROWS(row) \
  row(study1, "How good is FAM beside finite elements on the paper's cases?", "20 s", false) \
  row(fe_verification, "How sure are the finite elements that stand in for Abaqus?", "10 s", false) \
  row(benchmarks, "Do all methods give the numbers that others have published?", "40 s", false) \
  row(segmentation, "How many arcs shall I take?", "20 s", false) \
  row(torsion, "What does torsion cost, in error and in time?", "10 s", false) \
  row(study2, "How good is FAM on a catheter?", "10 s", false) \
  row(work_precision, "Which method is fastest at my accuracy?", "5 min", false) \
  row(stability, "Where does each method fail?", "1 min", false) \
  row(model_choice, "Which model does my scene need?", "3 min", false) \
  row(paths, "Where does it snap, and where to?", "1 min", false) \
  row(stream, "How fast is a kept solver on a stream of loads?", "10 s", false) \
  row(batch, "How many rods a second?", "1 min", false) \
  row(third_party, "What does a finite element code say that we did not write?", "2 min", false) \
  row(population, "What could have made the printed numbers?", "3 min", false) \
  row(sensing, "What does the rod touch, and how sure are we?", "40 s", false) \
  row(limits, "Why is there no answer?", "30 min", true) \
  row(walks, "Does a kept solver stay on its branch?", "15 min", true) \
  row(campaign, "How rarely is an answer wrong?", "4 h", true) \
  row(random, "Is an answer ever wrong without saying so?", "30 min", true)
// clang-format on

#define DECLARE(function, question, time, full) void function(const StudyOptions&);
STUDY_ROWS(DECLARE)

#define ROW(function, question, time, full) Study{#function, question, time, full, function},
std::span<const Study> all_studies() {
  static const Study studies[] = {STUDY_ROWS(ROW)};
  return studies;
}

std::string Study::command() const {
  std::string name = folder;
  std::replace(name.begin(), name.end(), '_', '-');
  return name;
}

void write_index(const StudyOptions& options) {
  std::ifstream file(options.pages / "index.md");
  const std::string words(std::istreambuf_iterator<char>(file), {});
  Page page;
  std::map<std::string, Answers> answers;
  for (const Study& study : all_studies())
    answers[study.folder] = read_answers(options.output / study.folder / answers_file);
  static const std::regex name("\\{\\{(\\w+)\\.(\\w+)\\}\\}");
  std::map<std::string, std::string> wanted;
  for (std::sregex_iterator at(words.begin(), words.end(), name), end; at != end; ++at) {
    const Answers& of_study = answers[(*at)[1]];
    const auto answer = of_study.find((*at)[2]);
    wanted[(*at)[1].str() + "." + (*at)[2].str()] =
        answer == of_study.end() ? "*not run yet: `fam-studies " + (*at)[1].str() + "`*" : answer->second;
  }
  for (const auto& [key, text] : wanted) page.set(key, text);
  write_file(options.output / "README.md", page.fill_text(words, (options.pages / "index.md").string()));
}

}  // namespace studies
