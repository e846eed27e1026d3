// What a study answers, in one line each: written beside its page, read by the index of all results.
#pragma once

#include <filesystem>
#include <map>
#include <string>

namespace studies {

// Name to one line of Markdown; timed numbers marked (page.h).
using Answers = std::map<std::string, std::string>;

inline const std::string answers_file = "answers.json";

std::string answers_json(const Answers& answers);
Answers read_answers(const std::filesystem::path& file);  // empty where there is no such file

}  // namespace studies
