#include "studies/report/answers.h"

#include <nlohmann/json.hpp>

#include <fstream>

namespace studies {

std::string answers_json(const Answers& answers) {
  return nlohmann::ordered_json(answers).dump(2) + "\n";
}

Answers read_answers(const std::filesystem::path& path) {
  std::ifstream file(path);
  return file ? nlohmann::json::parse(file).get<Answers>() : Answers{};
}

}  // namespace studies
