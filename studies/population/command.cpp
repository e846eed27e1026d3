// `fam-studies population --statistic FILE`: anybody's printed statistics of a study like the paper's.
#include "scene/json_node.h"
#include "studies/population/data.h"

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <cmath>

namespace studies {
namespace {

constexpr int most_cases = 1000;

double positive(const scene::JsonNode& node) {
  const double value = node.number();
  if (!(value > 0)) node.refuse("must be > 0");
  if (!(value >= 1e-6 && value <= 1e12)) node.refuse("must be from 1e-6 to 1e12");
  return value;
}

int case_count_in(const scene::JsonNode& node) {
  const int value = node.whole_number();
  if (value < 2 || value > most_cases) node.refuse("must be a whole number from 2 to " + std::to_string(most_cases));
  return value;
}

PopulationRod rod_in(const scene::JsonNode& node) {
  node.allow_keys(
      {"length_mm", "diameter_mm", "planar_bending_Nmm2", "spatial_bending_Nmm2", "planar_cases", "spatial_cases"});
  PopulationRod rod;
  const auto set = [&](const char* key, double& value) {
    if (node.has(key)) value = positive(node.at(key));
  };
  set("length_mm", rod.length_mm);
  set("diameter_mm", rod.diameter_mm);
  set("planar_bending_Nmm2", rod.planar_bending_Nmm2);
  set("spatial_bending_Nmm2", rod.spatial_bending_Nmm2);
  if (!(rod.diameter_mm <= rod.length_mm / 4 && rod.diameter_mm >= rod.length_mm / 1000))
    node.refuse("must be a rod: length_mm from 4 to 1000 times diameter_mm");
  if (node.has("planar_cases")) rod.planar_cases = case_count_in(node.at("planar_cases"));
  if (node.has("spatial_cases")) rod.spatial_cases = case_count_in(node.at("spatial_cases"));
  return rod;
}

// A number within its rounding, or [low, high].
Interval interval_in(const scene::JsonNode& node, double rounding_mm, bool has_sign) {
  Interval interval;
  if (node.is_number()) {
    const double value = node.number();
    interval = {value - rounding_mm, value + rounding_mm};
    if (!has_sign && value < 0) node.refuse("must be >= 0");
  } else {
    const std::vector<scene::JsonNode> ends = node.items();
    if (ends.size() != 2) node.refuse("must be a number or [low, high]");
    interval = {ends[0].number(), ends[1].number()};
    if (!has_sign && interval.low < 0) ends[0].refuse("must be >= 0");
    if (interval.low > interval.high) node.refuse("must be [low, high] with low <= high");
  }
  constexpr double most_mm = 1e6;
  if (!(std::max(std::abs(interval.low), std::abs(interval.high)) <= most_mm)) node.refuse("must be below 1e6 mm");
  if (!has_sign) interval.low = std::max(interval.low, 0.);
  return interval;
}

std::size_t row_in(const scene::JsonNode& node) {
  const scene::JsonNode set = node.at("set"), axis = node.at("axis");
  const bool planar = set.string() == "planar";
  if (!planar && set.string() != "spatial") set.refuse("must be \"planar\" or \"spatial\"");
  const std::string axes = planar ? "xy" : "xyz";
  if (axis.string().size() != 1 || axes.find(axis.string()) == std::string::npos)
    axis.refuse(planar ? "must be \"x\" or \"y\" (planar)" : "must be \"x\", \"y\" or \"z\"");
  return (planar ? 0 : 2) + axes.find(axis.string());
}

void read_row(const scene::JsonNode& node, double rounding_mm, PrintedStudy& study) {
  static constexpr std::array<const char*, in_row> keys = {"mean_mm", "sd_mm", "mae_mm", "mae_sd_mm", "rms_mm"};
  node.allow_keys({"set", "axis", keys[0], keys[1], keys[2], keys[3], keys[4]});
  const std::size_t row = row_in(node);
  for (std::size_t i = 0; i < in_row; ++i) {
    if (study.printed[row * in_row + i]) node.refuse("the row of this set and axis is given twice");
  }
  for (std::size_t i = 0; i < in_row; ++i) {
    if (node.has(keys[i]))
      study.printed[row * in_row + i] = interval_in(node.at(keys[i]), rounding_mm, i == mean_error);
  }
  if (!node.has("mae_mm") && !node.has("rms_mm") && !(node.has("mean_mm") && node.has("sd_mm")))
    node.refuse("must say how large the errors are: mae_mm, rms_mm, or mean_mm and sd_mm");
}

PrintedStudy study_in(const scene::JsonNode& root) {
  root.allow_keys({"title", "rod", "rounding_mm", "rows", "overall"});
  PrintedStudy study;
  if (root.has("title")) study.title = root.at("title").string();
  if (root.has("rod")) study.rod = rod_in(root.at("rod"));
  if (root.has("rounding_mm")) study.rounding_mm = positive(root.at("rounding_mm"));
  const double rounding_mm = study.rounding_mm;
  const scene::JsonNode rows = root.at("rows");
  if (rows.items().empty()) rows.refuse("must hold a row at least");
  for (const scene::JsonNode& row : rows.items()) read_row(row, rounding_mm, study);
  if (root.has("overall")) {
    const scene::JsonNode overall = root.at("overall");
    overall.allow_keys({"mean_mm", "sd_mm"});
    constexpr std::size_t first = row_count * in_row;
    if (overall.has("mean_mm")) study.printed[first] = interval_in(overall.at("mean_mm"), rounding_mm, true);
    if (overall.has("sd_mm")) study.printed[first + 1] = interval_in(overall.at("sd_mm"), rounding_mm, false);
  }
  return study;
}

}  // namespace

PrintedStudy read_printed_study(const std::string& path) {
  PrintedStudy study;
  scene::with_file(path, "statistics", [&](std::istream& input, const std::string& source) {
    const scene::Json json = scene::read_json(input, source);
    study = study_in({json, "", source});
  });
  return study;
}

void add_statistic_option(CLI::App& population, const bool& quick, const bool& quiet, std::function<int()>& chosen) {
  constexpr std::uint64_t few_sets = 300;
  population.add_option_function<std::string>(
      "--statistic",
      [&quick, &quiet, &chosen](const std::string& file) {
        chosen = [&quick, &quiet, file] {
          const PrintedStudy study = read_printed_study(file);
          const Progress::Style progress = quiet ? Progress::Style::quiet : Progress::style_of(stderr);
          fmt::print("{}", answer_csv(study, quick ? few_sets : population_sets, progress));
          return 0;
        };
      },
      "Printed statistics (JSON), or -: judge every mechanism by them, as CSV; no results are written");
}

}  // namespace studies
