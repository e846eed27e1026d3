#include "apps/values_file.h"

#include "scene/load_visitor.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <string_view>

namespace apps {
namespace {

using std::string_view;

// For an error message: one line of printable ASCII, cut where it is long.
std::string printable(string_view text) {
  std::string shown;
  for (const char c : text.substr(0, 60)) {
    if (c >= ' ' && c <= '~') shown += c;
    else shown += fmt::format("\\x{:02x}", static_cast<unsigned char>(c));
  }
  return shown.empty() ? "(nothing)" : text.size() > 60 ? shown + "..." : shown;
}

string_view trimmed(string_view text) {
  const char* blanks = " \t\r";
  const std::size_t first = text.find_first_not_of(blanks);
  if (first == string_view::npos) return {};
  text = text.substr(first, text.find_last_not_of(blanks) - first + 1);
  const bool quoted = text.size() >= 2 && text.front() == '"' && text.back() == '"';
  return quoted ? text.substr(1, text.size() - 2) : text;
}

std::vector<string_view> fields_of(string_view line) {
  std::vector<string_view> fields;
  while (true) {
    const std::size_t comma = line.find(',');
    fields.push_back(trimmed(line.substr(0, comma)));
    if (comma == string_view::npos) return fields;
    line.remove_prefix(comma + 1);
  }
}

class Reader {
 public:
  Reader(std::string source, const scene::Scene& scene) : source_(std::move(source)), scene_(scene) {}

  Values read(string_view text) {
    if (text.starts_with("\xef\xbb\xbf")) text.remove_prefix(3);
    while (!text.empty()) {
      const std::size_t end = text.find('\n');
      const string_view line = text.substr(0, end);
      text.remove_prefix(end == string_view::npos ? text.size() : end + 1);
      ++line_;
      if (trimmed(line).empty()) continue;
      if (names_.empty()) read_header(line);
      else read_row(line);
    }
    if (names_.empty()) refuse("line 1", "", "must name the columns, such as 0.x or 2.tension");
    const auto columns = static_cast<Eigen::Index>(columns_.size());
    const auto rows = static_cast<Eigen::Index>(numbers_.size()) / columns;
    return {columns_, Eigen::Map<const fam::RowMajorMatrix>(numbers_.data(), rows, columns)};
  }

 private:
  [[noreturn]] void refuse(const std::string& place, string_view value, const std::string& rule) const {
    throw scene::SceneError(source_ + ": " + place + " = " + printable(value) + ": " + rule);
  }

  std::string place(std::size_t column) const {
    const std::string name = column < names_.size() ? " (" + names_[column] + ")" : "";
    return fmt::format("line {}, column {}{}", line_, column + 1, name);
  }

  void read_header(string_view line) {
    const std::vector<string_view> fields = fields_of(line);
    for (std::size_t i = 0; i < fields.size(); ++i) {
      const fam::BatchColumn column = column_named(fields[i], i);
      for (const fam::BatchColumn& other : columns_) {
        if (other.load == column.load && other.component == column.component)
          refuse(place(i), fields[i], "the column is given twice");
      }
      columns_.push_back(column);
    }
    names_.assign(fields.begin(), fields.end());
  }

  // "0.x", or "2.tension".
  fam::BatchColumn column_named(string_view name, std::size_t i) const {
    std::size_t load = 0;
    const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), load);
    if (error == std::errc::invalid_argument || end == name.data() + name.size() || *end != '.')
      refuse(place(i), name, "must be <load>.<component>, such as 0.x or 2.tension");
    if (error != std::errc() || load >= scene_.loads.size()) {
      refuse(place(i), name, fmt::format("must name one of the scene's {} loads, counted from 0", scene_.loads.size()));
    }
    const string_view component(end + 1, static_cast<std::size_t>(name.data() + name.size() - end - 1));
    if (scene::tendon_of(scene_.loads[load])) {
      if (component != "tension") refuse(place(i), name, "the component of a tendon must be tension");
      return {load, 0};
    }
    constexpr std::array<string_view, 3> axes{"x", "y", "z"};
    const auto axis = std::find(axes.begin(), axes.end(), component);
    if (axis == axes.end()) {
      refuse(place(i), name,
             fmt::format("the component of a {} must be x, y or z", scene::kind_name(scene_.loads[load])));
    }
    return {load, static_cast<int>(axis - axes.begin())};
  }

  void read_row(string_view line) {
    const std::vector<string_view> fields = fields_of(line);
    if (fields.size() != names_.size()) {
      refuse(fmt::format("line {}", line_), fmt::format("{} values", fields.size()),
             fmt::format("must have {}, one for each column", names_.size()));
    }
    for (std::size_t i = 0; i < fields.size(); ++i) numbers_.push_back(number(fields[i], i));
  }

  double number(string_view field, std::size_t i) const {
    const string_view digits = field.starts_with('+') && !field.starts_with("+-") ? field.substr(1) : field;
    double value = 0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    if (digits.empty() || error == std::errc::invalid_argument || end != digits.data() + digits.size())
      refuse(place(i), field, "must be a number");
    if (error == std::errc::result_out_of_range) value = std::strtod(std::string(digits).c_str(), nullptr);
    if (!std::isfinite(value)) refuse(place(i), field, "must be finite");
    if (value < 0 && scene::tendon_of(scene_.loads[columns_[i].load])) refuse(place(i), field, "must be >= 0");
    return value;
  }

  const std::string source_;
  const scene::Scene& scene_;
  std::size_t line_ = 0;
  std::vector<std::string> names_;
  std::vector<fam::BatchColumn> columns_;
  std::vector<double> numbers_;  // row by row
};

}  // namespace

Values read_values_file(const std::string& path, const scene::Scene& scene) {
  const auto all_of = [](std::istream& input) { return std::string(std::istreambuf_iterator<char>(input), {}); };
  if (path == "-") return Reader("(standard input)", scene).read(all_of(std::cin));
  std::ifstream file(path, std::ios::binary);
  if (!file || std::filesystem::is_directory(path))
    throw scene::SceneError(path + ": (file) = (unreadable): must be a readable file of values");
  return Reader(path, scene).read(all_of(file));
}

}  // namespace apps
