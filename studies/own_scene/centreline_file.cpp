#include "studies/own_scene/centreline_file.h"

#include "scene/span.h"
#include "studies/compare/csv_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>

namespace studies {
namespace {

constexpr std::array<const char*, 4> column_names{"s_mm", "x", "y", "z"};

class CentrelineReader {
 public:
  CentrelineReader(std::string source, const scene::Scene& scene)
      : source_(std::move(source)),
        length_mm_(scene::length_mm(scene)),
        most_rows_(static_cast<std::size_t>(scene::max_sections) - scene.sections.size()) {}

  std::vector<CentrelinePoint> read(std::string_view text) {
    bool has_header = false;
    each_csv_line(text, [&](const CsvLine& line) {
      has_header ? read_row(line) : read_header(line);
      has_header = true;
    });
    if (!has_header) refuse(source_, "line 1", "", "must name the columns s_mm, x, y, z");
    if (points_.empty()) refuse(source_, "line 2", "", "must be a row of s_mm, x, y, z");
    return points_;
  }

 private:
  void read_header(const CsvLine& line) {
    for (std::size_t i = 0; i < column_names.size(); ++i) {
      const std::string name = column_names[i];
      const auto is_it = [&](std::string_view cell) { return cell == name || (i > 0 && cell == name + "_mm"); };
      const auto found = std::find_if(line.cells.begin(), line.cells.end(), is_it);
      const std::string place = fmt::format("line {}", line.number);
      if (found == line.cells.end()) refuse(source_, place, all_of(line), "must name a column " + name);
      if (std::find_if(found + 1, line.cells.end(), is_it) != line.cells.end())
        refuse(source_, place, all_of(line), "must name the column " + name + " once");
      columns_[i] = static_cast<std::size_t>(found - line.cells.begin());
    }
    cells_ = line.cells.size();
  }

  static std::string all_of(const CsvLine& line) {
    std::string all;
    for (const std::string_view cell : line.cells) all += (all.empty() ? "" : ",") + std::string(cell);
    return all;
  }

  void read_row(const CsvLine& line) {
    if (line.cells.size() != cells_) {
      refuse(source_, fmt::format("line {}", line.number), fmt::format("{} values", line.cells.size()),
             fmt::format("must have {}, one for each column", cells_));
    }
    if (points_.size() == most_rows_) {
      refuse(source_, fmt::format("line {}", line.number), all_of(line),
             fmt::format("must be one of at most {} rows", most_rows_));
    }
    std::array<double, 4> values{};
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = number(line, i);
    points_.push_back({std::min(values[0], length_mm_), {values[1], values[2], values[3]}});
  }

  double number(const CsvLine& line, std::size_t i) const {
    const std::string_view cell = line.cells[columns_[i]];
    const auto [value, broken_rule] = number_of(cell);
    const auto check = [&](bool holds, const std::string& rule) {
      if (!holds) refuse(source_, fmt::format("line {}, {}", line.number, column_names[i]), cell, rule);
    };
    check(!broken_rule, broken_rule ? broken_rule : "");
    if (i > 0) return value;
    check(value >= 0, "must be >= 0, the clamp");
    check(value <= length_mm_ * (1 + same_station_relative),
          fmt::format("must be <= {}, the rod's length", length_mm_));
    if (!points_.empty())
      check(value > points_.back().s_mm, fmt::format("must be > {}, the row before", points_.back().s_mm));
    return value;
  }

  const std::string source_;
  const double length_mm_;
  const std::size_t most_rows_;
  std::array<std::size_t, 4> columns_{};
  std::size_t cells_ = 0;
  std::vector<CentrelinePoint> points_;
};

}  // namespace

std::vector<CentrelinePoint> read_centreline(const std::string& path, const scene::Scene& scene) {
  return CentrelineReader(path == "-" ? "(standard input)" : path, scene).read(text_of_file(path, "a centreline"));
}

scene::Scene cut_at(const scene::Scene& scene, const std::vector<CentrelinePoint>& places) {
  const double hair_mm = same_station_relative * scene::length_mm(scene);
  std::vector<double> taken;  // where the rod has a station anyway
  for (const scene::Span& span : scene::spans_of(scene)) taken.push_back(span.end_mm);
  scene::Scene cut = scene;
  cut.sections.clear();
  auto place = places.begin();
  double start_mm = 0, last_mm = 0, section_start_mm = 0;
  for (scene::Section section : scene.sections) {
    const double end_mm = section_start_mm + section.length_mm;
    start_mm = section_start_mm;
    for (; place != places.end() && place->s_mm < end_mm; ++place) {
      const auto near = std::lower_bound(taken.begin(), taken.end(), place->s_mm - hair_mm);
      const bool is_taken = near != taken.end() && *near <= place->s_mm + hair_mm;
      if (is_taken || place->s_mm - last_mm <= hair_mm) continue;
      section.length_mm = place->s_mm - start_mm;
      cut.sections.push_back(section);
      start_mm = last_mm = place->s_mm;
    }
    section.length_mm = end_mm - start_mm;
    cut.sections.push_back(section);
    section_start_mm = end_mm;
  }
  return cut;
}

}  // namespace studies
