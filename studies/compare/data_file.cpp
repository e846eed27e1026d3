#include "studies/compare/data_file.h"

#include "scene/scene.h"

#include <cmath>
#include <fstream>
#include <sstream>

namespace studies {
namespace {

std::vector<std::string> cells_of(const std::string& line, std::size_t columns) {
  std::vector<std::string> cells;
  std::stringstream rest(line);
  std::string cell;
  while (cells.size() + 1 < columns && std::getline(rest, cell, ',')) cells.push_back(cell);
  if (std::getline(rest, cell)) cells.push_back(cell);
  cells.resize(columns);
  return cells;
}

}  // namespace

Printed printed(const std::string& text) {
  if (text.find_first_of("0123456789") == std::string::npos) throw scene::SceneError("'" + text + "' is no number");
  const std::size_t exponent = text.find_first_of("eE");
  const std::string mantissa = text.substr(0, exponent);
  const std::size_t point = mantissa.find('.');
  const int decimals = point == std::string::npos ? 0 : static_cast<int>(mantissa.size() - point) - 1;
  return {std::stod(text), decimals - (exponent == std::string::npos ? 0 : std::stoi(text.substr(exponent + 1)))};
}

Printed shifted(const Printed& number, int power, int factor) {
  return {number.value * std::pow(10, power) * factor, number.decimals - power};
}

std::vector<DataRow> data_rows(const std::filesystem::path& file) {
  std::ifstream input(file);
  if (!input) throw scene::SceneError(file.string() + ": cannot be read");
  std::vector<DataRow> rows;
  std::vector<std::string> head;
  for (std::string line; std::getline(input, line);) {
    if (line.empty() || line[0] == '#') continue;
    if (head.empty()) {
      std::stringstream names(line);
      for (std::string name; std::getline(names, name, ',');) head.push_back(name);
      continue;
    }
    const std::vector<std::string> cells = cells_of(line, head.size());
    DataRow& row = rows.emplace_back();
    for (std::size_t i = 0; i < head.size(); ++i) row[head[i]] = cells[i];
  }
  return rows;
}

}  // namespace studies
