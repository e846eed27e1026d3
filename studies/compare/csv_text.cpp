#include "studies/compare/csv_text.h"

#include "scene/scene.h"

#include <charconv>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>

namespace studies {
namespace {

using std::string_view;

std::string printable(string_view text) {
  constexpr std::size_t longest_shown = 60;  // chosen, not measured
  constexpr char hex[] = "0123456789abcdef";
  std::string shown;
  for (const char c : text.substr(0, longest_shown)) {
    const auto byte = static_cast<unsigned char>(c);
    if (c >= ' ' && c <= '~') shown += c;
    else shown += {'\\', 'x', hex[byte / 16], hex[byte % 16]};
  }
  return shown.empty() ? "(nothing)" : text.size() > longest_shown ? shown + "..." : shown;
}

string_view trimmed(string_view text) {
  const char* blanks = " \t\r";
  const std::size_t first = text.find_first_not_of(blanks);
  if (first == string_view::npos) return {};
  text = text.substr(first, text.find_last_not_of(blanks) - first + 1);
  const bool quoted = text.size() >= 2 && text.front() == '"' && text.back() == '"';
  return quoted ? text.substr(1, text.size() - 2) : text;
}

void split(string_view line, std::vector<string_view>& cells) {
  cells.clear();
  while (true) {
    const std::size_t comma = line.find(',');
    cells.push_back(trimmed(line.substr(0, comma)));
    if (comma == string_view::npos) return;
    line.remove_prefix(comma + 1);
  }
}

}  // namespace

std::string text_of_file(const std::string& path, const std::string& what) {
  const auto all_of = [](std::istream& input) { return std::string(std::istreambuf_iterator<char>(input), {}); };
  if (path == "-") return all_of(std::cin);
  std::ifstream file(path, std::ios::binary);
  if (!file || std::filesystem::is_directory(path))
    refuse(path, "(file)", "(unreadable)", "must be a readable file of " + what);
  return all_of(file);
}

void each_csv_line(string_view text, const std::function<void(const CsvLine&)>& take) {
  if (text.starts_with("\xef\xbb\xbf")) text.remove_prefix(3);
  for (CsvLine line{1, {}}; !text.empty(); ++line.number) {
    const std::size_t end = text.find('\n');
    const string_view whole = text.substr(0, end);
    text.remove_prefix(end == string_view::npos ? text.size() : end + 1);
    if (trimmed(whole).empty()) continue;
    split(whole, line.cells);
    take(line);
  }
}

CsvNumber number_of(string_view cell) {
  const string_view digits = cell.starts_with('+') && !cell.starts_with("+-") ? cell.substr(1) : cell;
  double value = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (digits.empty() || error == std::errc::invalid_argument || end != digits.data() + digits.size())
    return {0, "must be a number"};
  if (error == std::errc::result_out_of_range) value = std::strtod(std::string(digits).c_str(), nullptr);
  return {value, std::isfinite(value) ? nullptr : "must be finite"};
}

void refuse(const std::string& source, const std::string& place, string_view value, const std::string& rule) {
  throw scene::SceneError(source + ": " + place + " = " + printable(value) + ": " + rule);
}

}  // namespace studies
