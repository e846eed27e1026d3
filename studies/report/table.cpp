#include "studies/report/table.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cassert>

namespace studies {

void Table::add(std::vector<std::string> cells) {
  assert(cells.size() == columns_.size());
  rows_.push_back(std::move(cells));
}

std::string Table::csv(const std::vector<std::string>& head) const {
  std::string text;
  for (const std::string& line : head) text += "# " + line + "\n";
  text += fmt::format("{}\n", fmt::join(columns_, ","));
  for (const auto& row : rows_) text += fmt::format("{}\n", fmt::join(row, ","));
  return text;
}

std::string Table::markdown() const {
  std::string text = fmt::format("| {} |\n|", fmt::join(columns_, " | "));
  for (std::size_t i = 0; i < columns_.size(); ++i) text += i == 0 ? "---|" : "---:|";
  text += "\n";
  for (const auto& row : rows_) text += fmt::format("| {} |\n", fmt::join(row, " | "));
  return text;
}

std::string fixed(double value, int digits) {
  const std::string text = fmt::format("{:.{}f}", value, digits);
  return text.find_first_not_of("-0.") == std::string::npos && text[0] == '-' ? text.substr(1) : text;
}

std::string scientific(double value, int digits) {
  return value == 0 ? "0" : fmt::format("{:.{}e}", value, digits);
}

}  // namespace studies
