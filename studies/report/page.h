// Fills the words of a page.md with the numbers, tables and pictures of a study.
//
//   {{name}}                          the text of that name
//   {{?check}}words{{/}}              these words where the check holds, else nothing
//   {{?check}}words{{:}}others{{/}}   likewise, the others where it does not hold
//
// A sentence that states a finding is computed, or stands behind a check. Checks do not nest; names stand in the words
// of either branch. The filler is strict: a name that the page knows and nobody set, or the reverse, is an error.
//
// What was timed is marked (<!--t-->...<!--/t-->): it differs from run to run and is not compared in the tests.
#pragma once

#include <filesystem>
#include <map>
#include <stdexcept>
#include <string>

namespace studies {

class PageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

class Page {
 public:
  void set(const std::string& name, const std::string& text);
  void set_time(const std::string& name, const std::string& text);  // marked
  void check(const std::string& name, bool holds);
  void check_time(const std::string& name, bool holds);  // the words, whichever, are marked

  // The page, filled; throws PageError naming the file and the name: unknown, unused, or a check without its end.
  std::string fill(const std::filesystem::path& page_md) const;
  // The same of a text; `source` names it in errors.
  std::string fill_text(const std::string& words, const std::string& source) const;

 private:
  struct Check {
    bool holds, timed;
  };
  std::map<std::string, std::string> texts_;
  std::map<std::string, Check> checks_;
};

// A text of timed numbers, marked: in a paragraph, or a table on lines of its own.
std::string timed(const std::string& text);

// --- Answers ---------------------------------------------------------------------------------------------------------
// What a study answers, in one line each: written beside its page, read by the index of all results.

// Name to one line of Markdown; timed numbers marked.
using Answers = std::map<std::string, std::string>;

inline const std::string answers_file = "answers.json";

std::string answers_json(const Answers& answers);
Answers read_answers(const std::filesystem::path& file);  // empty where there is no such file

}  // namespace studies
