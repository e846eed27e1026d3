#include "studies/report/page.h"

#include "studies/batch/data.h"
#include "studies/report/provenance.h"
#include "studies/report/table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace studies {
namespace {

const BatchOutcome& outcome_of(const BatchData& data, const std::string& key) {
  const auto found = std::find_if(data.begin(), data.end(), [&](const BatchOutcome& o) { return o.rods.key == key; });
  if (found == data.end()) throw std::logic_error("no rods " + key);
  return *found;
}

std::string rate(const BatchOutcome& outcome, BatchWays way) {
  return rate_text(outcome.rods_per_s(outcome.times[way]));
}

double times_the_solver(const BatchOutcome& o) {
  return o.times[one_by_one].median_us / o.times[arcs_given].median_us;
}

bool all_in_lanes(const BatchOutcome& o) {
  return o.in_lanes == o.rows;
}

// "2.1 to 14": over the cases whose rows all lie in lanes.
std::string gains(const BatchData& data) {
  double least = INFINITY, largest = 0;
  for (const BatchOutcome& o : data) {
    if (!all_in_lanes(o)) continue;
    least = std::min(least, times_the_solver(o)), largest = std::max(largest, times_the_solver(o));
  }
  return significant(least, 2) + " to " + significant(largest, 2);
}

std::string percent(Eigen::Index part, Eigen::Index whole) {
  return fmt::format("{:.3g} %", 100.0 * static_cast<double>(part) / static_cast<double>(whole));
}

void set_rates(Page& page, const BatchData& data) {
  const BatchOutcome& first = outcome_of(data, "S4_follower");
  for (std::size_t way = 0; way < batch_way_count; ++way)
    page.set_time(batch_ways[way].key, rate(first, static_cast<BatchWays>(way)));
  page.set("arcs", std::to_string(first.arcs));
  page.set("error", error_for_reader(first.largest_error_mm()));
  page.set("aim", fmt::format("{:g}", first.rods.aim_mm));
  for (const char* key : {"P2_fixed", "finger", "S4_fixed", "S4_fixed_twice", "catheter", "arm"})
    page.set_time(key, rate(outcome_of(data, key), arcs_given));
  page.set_time("gains", gains(data));
}

// Which cases lie in lanes, and what the exact rod, other units and the Solver say.
void set_findings(Page& page, const BatchData& data) {
  const BatchOutcome &once = outcome_of(data, "S4_fixed"), &twice = outcome_of(data, "S4_fixed_twice");
  Eigen::Index rows = 0, converged = 0, chosen = 0, in_lanes = 0, in_lanes_of_chosen = 0, judged = 0, samples = 0;
  bool same_on_units = true, as_solver = true, within_aims = true;
  for (const BatchOutcome& o : data) {
    rows += o.rows, converged += o.converged, chosen += o.converged_of_chosen;
    in_lanes += o.in_lanes, in_lanes_of_chosen += o.in_lanes_of_chosen;
    judged += o.judged(), samples += static_cast<Eigen::Index>(o.samples.size());
    same_on_units &= o.same_on_units, as_solver &= o.as_solver;
    within_aims &= std::max(o.largest_error_mm(), o.largest_error_of_chosen_mm()) <= o.rods.aim_mm;
  }
  page.set("cases_in_lanes", std::to_string(std::count_if(data.begin(), data.end(), all_in_lanes)));
  page.set("cases", std::to_string(data.size()));
  page.set("rows", std::to_string(data.front().rows));
  page.set("all_rows", std::to_string(rows));
  page.set("in_lanes", std::to_string(in_lanes));
  page.set("in_lanes_of_chosen", std::to_string(in_lanes_of_chosen));
  page.set("converged", std::to_string(converged));
  page.set("converged_of_chosen", std::to_string(chosen));
  page.set("judged", std::to_string(judged));
  page.set("samples", std::to_string(samples));
  page.set("once_left", fmt::format("{} of {}", once.rows - once.in_lanes, once.rows));
  page.set("twice_left", fmt::format("{} of {} ({})", twice.rows - twice.in_lanes, twice.rows,
                                     percent(twice.rows - twice.in_lanes, twice.rows)));
  page.set("agreement", fmt::format("{:g}", batch_agreement));
  page.check("within_aims", within_aims);
  page.check("same_on_units", same_on_units);
  page.check("as_solver", as_solver);
}

std::string answer_for_index(const BatchData& data) {
  const BatchOutcome &space = outcome_of(data, "S4_follower"), &plane = outcome_of(data, "P2_fixed"),
                     &catheter = outcome_of(data, "catheter");
  const auto timed_rate = [](const BatchOutcome& o, BatchWays way) { return timed(rate(o, way)); };
  return fmt::format(
      "on one core {} under follower loads in space, within {} mm, {} with error estimates; {} under a fixed force in "
      "the plane; {} catheters with tendons in space ({} of {} kinds of rods lie wholly in lanes)",
      timed_rate(space, arcs_given), error_for_reader(space.largest_error_mm()), timed_rate(space, with_estimate),
      timed_rate(plane, arcs_given), timed_rate(catheter, arcs_given),
      std::count_if(data.begin(), data.end(), all_in_lanes), data.size());
}

}  // namespace

std::map<std::string, std::string> batch_pages(const BatchData& data, const std::filesystem::path& page_md) {
  Page page;
  set_rates(page, data);
  set_findings(page, data);
  page.set("table", batch_table(data));
  page.set_time("units", batch_units_table(data));
  page.set_time("timed_rows", std::to_string(data.front().timed_rows));
  page.set_time("shared_rows", std::to_string(data.front().shared_rows));
  page.set_time("machine", machine_line());
  return {{"README.md", page.fill(page_md)}, {answers_file, answers_json({{"rods_a_second", answer_for_index(data)}})}};
}

}  // namespace studies
