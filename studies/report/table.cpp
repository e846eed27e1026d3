#include "studies/report/table.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cassert>
#include <cmath>
#include <regex>

namespace studies {
namespace {

std::string quoted(const std::string& cell) {
  if (cell.find_first_of(",\"\n") == std::string::npos) return cell;
  std::string text = "\"";
  for (const char c : cell) text += c == '"' ? "\"\"" : std::string(1, c);
  return text + "\"";
}

std::string csv_line(const std::vector<std::string>& cells) {
  std::string line;
  for (const std::string& cell : cells) line += (&cell == &cells.front() ? "" : ",") + quoted(cell);
  return line + "\n";
}

}  // namespace

std::string for_reader(const std::string& text) {
  static const std::regex none("([0-9])e[-+]?0+(?![0-9])"), exponent("([0-9])e\\+?(-?)0*([0-9]+)"),
      minus("(^|[\\s(|>±])-([0-9.])");
  const std::string plain = std::regex_replace(std::regex_replace(text, none, "$1"), exponent, "$1e$2$3");
  return std::regex_replace(plain, minus, "$1−$2");
}

void Table::add(std::vector<std::string> cells) {
  assert(cells.size() == columns_.size());
  rows_.push_back(std::move(cells));
}

std::string Table::csv(const std::vector<std::string>& head) const {
  std::string text;
  for (const std::string& line : head) text += "# " + line + "\n";
  text += csv_line(columns_);
  for (const auto& row : rows_) text += csv_line(row);
  return text;
}

std::string Table::markdown() const {
  std::string text = fmt::format("| {} |\n|", fmt::join(columns_, " | "));
  for (std::size_t i = 0; i < columns_.size(); ++i) text += i == 0 ? "---|" : "---:|";
  text += "\n";
  for (const auto& row : rows_) text += for_reader(fmt::format("| {} |\n", fmt::join(row, " | ")));
  return text;
}

std::string fixed(double value, int digits) {
  const std::string text = fmt::format("{:.{}f}", value, digits);
  return text.find_first_not_of("-0.") == std::string::npos && text[0] == '-' ? text.substr(1) : text;
}

std::string significant(double value, int digits) {
  if (value == 0 || !std::isfinite(value)) return value == 0 ? "0" : "–";
  const double unit = std::pow(10, std::floor(std::log10(std::abs(value))) - digits + 1);
  const double rounded = std::round(value / unit) * unit;
  const int decimals = digits - 1 - static_cast<int>(std::floor(std::log10(std::abs(rounded)) + 1e-12));
  return fixed(rounded, std::max(decimals, 0));
}

std::string time_text(double time_us) {
  if (!std::isfinite(time_us)) return "–";
  if (time_us < 1e3) return significant(time_us, 3) + " µs";
  return time_us < 1e6 ? significant(time_us / 1e3, 3) + " ms" : significant(time_us / 1e6, 3) + " s";
}

std::string scientific(double value, int digits) {
  return value == 0 ? "0" : fmt::format("{:.{}e}", value, digits);
}

std::string error_text(double error_mm, int digits) {
  return scientific(std::max(error_mm, error_floor_mm), digits);
}

std::string error_for_reader(double error_mm) {
  if (!std::isfinite(error_mm)) return "–";
  return error_mm >= 0.00095 ? significant(error_mm, 2) : for_reader(error_text(error_mm, 1));
}

std::string observed_order(int coarse_arcs, double coarse_mm, int fine_arcs, double fine_mm) {
  constexpr double resolved_mm = 1e-8;
  if (!(std::min(coarse_mm, fine_mm) >= resolved_mm)) return "–";
  return fixed(std::log(coarse_mm / fine_mm) / std::log(static_cast<double>(fine_arcs) / coarse_arcs), 2);
}

}  // namespace studies
