// What the batch study asked for and measured, and its files as pure functions of it.
#pragma once

#include "fam/batch.h"
#include "studies/compare/stopwatch.h"

#include <array>
#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <vector>

namespace studies {

// Rods of one scene that differ in some numbers of its loads.
struct BatchCase {
  std::string key, name;  // in CSV files; on the page
  std::string scene;      // of studies/cases
  scene::RodModel model;
  double scale;   // of the numbers in the scene file: those of a row are random shares of the numbers so scaled
  double aim_mm;  // the sample's tips are within it; the tolerance asked for where arcs are chosen
  std::vector<fam::BatchColumn> columns;
};

// How the rows are solved.
struct BatchWay {
  std::string key, name;  // in CSV files; on the page
  std::string colour;
};
enum BatchWays { arcs_given, with_estimate, arcs_chosen, one_by_one };
constexpr std::size_t batch_way_count = 4;
extern const std::array<BatchWay, batch_way_count> batch_ways;

// One of the rows that the exact reference judges.
struct BatchSample {
  Eigen::Index row;
  std::vector<double> values;
  Eigen::Vector3d tip_mm, tip_of_chosen_mm, exact_tip_mm;  // NaN where not converged

  double error_mm() const { return (tip_mm - exact_tip_mm).norm(); }
  double error_of_chosen_mm() const { return (tip_of_chosen_mm - exact_tip_mm).norm(); }
};

// What is the same on every machine, and below it the times.
struct BatchOutcome {
  BatchCase rods;
  double length_mm = 0;
  int arcs = 0;  // the fewest that bring the sample within the aim
  Eigen::Index rows = 0, converged = 0, in_lanes = 0;
  Eigen::Index converged_of_chosen = 0, in_lanes_of_chosen = 0;
  std::vector<BatchSample> samples;
  bool same_on_units = false, as_solver = false;  // every tip, within batch_agreement of the length

  Eigen::Index timed_rows = 0, shared_rows = 0;  // the latter by one thread and by two
  std::array<Timing, batch_way_count> times;
  std::vector<std::pair<std::string, Timing>> unit_times;  // arcs given
  Timing one_thread, two_threads;

  double largest_error_mm() const;  // of those that converged here and there; so are the next two
  double largest_error_of_chosen_mm() const;
  int judged() const;
  double rods_per_s(const Timing& timing) const { return 1e6 * static_cast<double>(timed_rows) / timing.median_us; }
};

constexpr double batch_agreement = 1e-11;  // fam/batch.h

using BatchData = std::vector<BatchOutcome>;

std::string batch_accuracy_csv(const BatchData& data);
std::string batch_samples_csv(const BatchData& data);
std::string batch_times_csv(const BatchData& data);
std::string batch_picture(const BatchData& data);
std::string batch_table(const BatchData& data);  // of the page
std::string batch_units_table(const BatchData& data);
std::string rate_text(double rods_per_s);  // "12.3 million"
std::map<std::string, std::string> batch_pages(const BatchData& data, const std::filesystem::path& page_md);

}  // namespace studies
