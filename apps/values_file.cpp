#include "apps/values_file.h"

#include "scene/load_visitor.h"
#include "studies/compare/csv_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <string_view>

namespace apps {
namespace {

using std::string_view;

class Reader {
 public:
  Reader(std::string source, const scene::Scene& scene) : source_(std::move(source)), scene_(scene) {}

  Values read(string_view text) {
    studies::each_csv_line(text, [this](const studies::CsvLine& line) {
      line_ = line.number;
      if (names_.empty()) read_header(line.cells);
      else read_row(line.cells);
    });
    if (names_.empty()) refuse("line 1", "", "must name the columns, such as 0.x or 2.tension");
    const auto columns = static_cast<Eigen::Index>(columns_.size());
    const auto rows = static_cast<Eigen::Index>(numbers_.size()) / columns;
    return {columns_, Eigen::Map<const fam::RowMajorMatrix>(numbers_.data(), rows, columns)};
  }

 private:
  [[noreturn]] void refuse(const std::string& place, string_view value, const std::string& rule) const {
    studies::refuse(source_, place, value, rule);
  }

  std::string place(std::size_t column) const {
    const std::string name = column < names_.size() ? " (" + names_[column] + ")" : "";
    return fmt::format("line {}, column {}{}", line_, column + 1, name);
  }

  void read_header(const std::vector<string_view>& fields) {
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

  void read_row(const std::vector<string_view>& fields) {
    if (fields.size() != names_.size()) {
      refuse(fmt::format("line {}", line_), fmt::format("{} values", fields.size()),
             fmt::format("must have {}, one for each column", names_.size()));
    }
    for (std::size_t i = 0; i < fields.size(); ++i) numbers_.push_back(number(fields[i], i));
  }

  double number(string_view field, std::size_t i) const {
    const auto [value, broken_rule] = studies::number_of(field);
    if (broken_rule) refuse(place(i), field, broken_rule);
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
  return Reader(path == "-" ? "(standard input)" : path, scene).read(studies::text_of_file(path, "values"));
}

}  // namespace apps
