#include "studies/report/table.h"

#include "studies/batch/data.h"
#include "studies/report/page.h"
#include "studies/report/provenance.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace studies {
namespace {

std::string yes(bool holds) {
  return holds ? "yes" : "no";
}

const char* model_text(scene::RodModel model) {
  return model == scene::RodModel::reissner ? "with shear and stretch" : "Kirchhoff";
}

// In thousands.
std::string rate_cell(const BatchOutcome& outcome, const Timing& timing) {
  return timed(significant(outcome.rods_per_s(timing) / 1000, 3));
}

double ratio(const Timing& slow, const Timing& fast) {
  return slow.median_us / fast.median_us;
}

}  // namespace

std::string rate_text(double rods_per_s) {
  if (rods_per_s >= 999'500) return significant(rods_per_s / 1e6, 3) + " million";
  return significant(rods_per_s / 1e3, 3) + " thousand";
}

double BatchOutcome::largest_error_mm() const {
  double largest = 0;
  for (const BatchSample& sample : samples) largest = std::fmax(largest, sample.error_mm());
  return largest;
}

double BatchOutcome::largest_error_of_chosen_mm() const {
  double largest = 0;
  for (const BatchSample& sample : samples) largest = std::fmax(largest, sample.error_of_chosen_mm());
  return largest;
}

int BatchOutcome::judged() const {
  return static_cast<int>(
      std::count_if(samples.begin(), samples.end(), [](const BatchSample& s) { return std::isfinite(s.error_mm()); }));
}

std::string batch_accuracy_csv(const BatchData& data) {
  Table table({"rods", "scene", "scale", "model", "aim_mm", "arcs", "rows", "converged", "in_lanes", "judged",
               "error_mm", "error_over_L", "converged_arcs_chosen", "in_lanes_arcs_chosen", "error_arcs_chosen_mm",
               "same_on_units", "as_solver"});
  for (const BatchOutcome& o : data) {
    const double error_mm = o.largest_error_mm();
    table.add({o.rods.key, o.rods.scene, fmt::format("{:g}", o.rods.scale), model_text(o.rods.model),
               fmt::format("{:g}", o.rods.aim_mm), std::to_string(o.arcs), std::to_string(o.rows),
               std::to_string(o.converged), std::to_string(o.in_lanes), std::to_string(o.judged()),
               error_text(error_mm, 1), scientific(error_mm / o.length_mm, 1), std::to_string(o.converged_of_chosen),
               std::to_string(o.in_lanes_of_chosen), error_text(o.largest_error_of_chosen_mm(), 1),
               yes(o.same_on_units), yes(o.as_solver)});
  }
  return table.csv(
      {"Tips of fam::solve_batch against the exact rod of the same model: the largest error of the judged rows.",
       "arcs: the fewest within aim_mm. arcs_chosen: by fam::solve_batch for the tolerance aim_mm.",
       fmt::format("same_on_units: each tip differs by less than {:g} L from that of the widest unit; as_solver: from "
                   "that of a Solver.",
                   batch_agreement)});
}

std::string batch_samples_csv(const BatchData& data) {
  Table table({"rods", "row", "values", "x_mm", "y_mm", "z_mm", "error_mm", "error_arcs_chosen_mm"});
  for (const BatchOutcome& o : data) {
    for (const BatchSample& s : o.samples) {
      std::string values;
      for (const double value : s.values) values += (values.empty() ? "" : " ") + significant(value, 6);
      std::vector<std::string> cells{o.rods.key, std::to_string(s.row), values};
      for (const double x : s.tip_mm) cells.push_back(fixed(x, 4));
      cells.push_back(error_text(s.error_mm(), 1));
      cells.push_back(error_text(s.error_of_chosen_mm(), 1));
      table.add(cells);
    }
  }
  return table.csv({"Values of the loads in N and N mm, in the order of the scene's loads; weights stay."});
}

std::string batch_times_csv(const BatchData& data) {
  Table table({"rods", "what", "rows", "median_us", "lower_quartile_us", "upper_quartile_us", "repeats"});
  for (const BatchOutcome& o : data) {
    const auto add = [&](const std::string& what, Eigen::Index rows, const Timing& t) {
      table.add({o.rods.key, what, std::to_string(rows), significant(t.median_us, 4),
                 significant(t.lower_quartile_us, 4), significant(t.upper_quartile_us, 4), std::to_string(t.repeats)});
    };
    for (std::size_t way = 0; way < batch_way_count; ++way) add(batch_ways[way].key, o.timed_rows, o.times[way]);
    for (const auto& [unit, timing] : o.unit_times) add(unit, o.timed_rows, timing);
    add("1 thread", o.shared_rows, o.one_thread);
    add("2 threads", o.shared_rows, o.two_threads);
  }
  return table.csv({machine_line(), "Times of all rows. Units and threads: arcs given, no estimate."});
}

std::string batch_table(const BatchData& data) {
  Table table({"rods", "arcs", "tip error, mm", "rows in lanes", "arcs given", "and estimate", "arcs chosen",
               "Solver, row by row", "two threads over one"});
  for (const BatchOutcome& o : data) {
    std::vector<std::string> cells{fmt::format("{}, {}", o.rods.name, model_text(o.rods.model)), std::to_string(o.arcs),
                                   error_for_reader(o.largest_error_mm()), fmt::format("{} of {}", o.in_lanes, o.rows)};
    for (const Timing& timing : o.times) cells.push_back(rate_cell(o, timing));
    cells.push_back(timed(significant(ratio(o.one_thread, o.two_threads), 3)));
    table.add(cells);
  }
  return table.markdown();
}

std::string batch_units_table(const BatchData& data) {
  std::vector<std::string> head{"rods"};
  for (const auto& [unit, timing] : data.front().unit_times) head.push_back(unit);
  Table table(head);
  for (const BatchOutcome& o : data) {
    std::vector<std::string> cells{o.rods.name};
    for (const auto& [unit, timing] : o.unit_times) cells.push_back(significant(o.rods_per_s(timing) / 1000, 3));
    table.add(cells);
  }
  return table.markdown();
}

}  // namespace studies
