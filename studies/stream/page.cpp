#include "studies/report/page.h"

#include "studies/compare/error_measures.h"
#include "studies/report/chart.h"
#include "studies/report/provenance.h"
#include "studies/report/table.h"
#include "studies/stream/data.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace studies {
namespace {

// Bins of the histogram: ten a decade, from 0.1 µs on.
constexpr int bins_per_decade = 10, decades = 7;
constexpr double first_us = 0.1;

double bin_start_us(int bin) {
  return first_us * std::pow(10, static_cast<double>(bin) / bins_per_decade);
}

std::vector<int> histogram(const StreamData& data) {
  std::vector<int> counts(bins_per_decade * decades);
  for (const double us : data.latency_us) {
    const int bin = static_cast<int>(bins_per_decade * std::log10(us / first_us));
    ++counts[static_cast<std::size_t>(std::clamp(bin, 0, bins_per_decade * decades - 1))];
  }
  return counts;
}

struct Share {
  const char* name;
  double share;
};
constexpr Share shares[] = {{"median", 0.5}, {"p99", 0.99}, {"p9999", 0.9999}, {"worst", 1}};

double latency_us(const StreamData& data, double share) {
  return quantile(data.latency_us, share);
}

}  // namespace

double StreamData::largest_error_mm() const {
  double largest = 0;
  for (const StreamSample& sample : samples) {
    if (!(sample.error_mm() <= largest)) largest = sample.error_mm();
  }
  return largest;
}

// Errors to one digit: the next ones hold the last Newton step, which depends on the solve before.
std::string stream_accuracy_csv(const StreamData& data) {
  Table table({"solve", "tension_1_N", "tension_2_N", "Fx_N", "Fy_N", "Fz_N", "x_mm", "y_mm", "z_mm", "error_mm"});
  for (const StreamSample& s : data.samples) {
    std::vector<std::string> cells{std::to_string(s.solve), fixed(s.tensions_N[0], 4), fixed(s.tensions_N[1], 4)};
    for (const double f : s.force_N) cells.push_back(fixed(f, 5));
    for (const double x : s.tip_mm) cells.push_back(fixed(x, 3));
    cells.push_back(error_text(s.error_mm(), 0));
    table.add(cells);
  }
  return table.csv(
      {fmt::format("Tip of the kept solver, tolerance {:g} mm, against the exact Kirchhoff rod.", data.tolerance_mm)});
}

std::string stream_latency_csv(const StreamData& data) {
  Table table({"from_us", "to_us", "solves"});
  const std::vector<int> counts = histogram(data);
  for (int bin = 0; bin < bins_per_decade * decades; ++bin) {
    const int count = counts[static_cast<std::size_t>(bin)];
    if (count > 0)
      table.add({significant(bin_start_us(bin), 3), significant(bin_start_us(bin + 1), 3), std::to_string(count)});
  }
  std::vector<std::string> head{machine_line()};
  for (const auto& [name, share] : shares) {
    head.push_back(fmt::format("{}: {} us", name, significant(latency_us(data, share), 3)));
  }
  head.push_back(
      "Inputs set, solve, and at the tip compliance and by_load of all tendons and the force. The last bin and the "
      "first hold what lies beyond.");
  return table.csv(head);
}

std::string stream_latency_picture(const StreamData& data) {
  Svg svg(880, 440, "Time of a solve with its Jacobians, one by one",
          "A histogram, both axes logarithmic: number of solves over the time that each took, in microseconds. Two "
          "lines mark the median and the worst. Look at how far the tail reaches to the right.",
          "ten bins a decade; lines: median and worst");
  const std::vector<int> counts = histogram(data);
  const double worst_us = latency_us(data, 1), median_us = latency_us(data, 0.5);
  const double low =
      std::pow(10, std::floor(std::log10(*std::min_element(data.latency_us.begin(), data.latency_us.end()))));
  const double high = std::pow(10, std::ceil(std::log10(worst_us)));
  Panel panel(svg, {80, 80}, 760, 300, {"time of a solve, µs", low, high, true},
              {"solves", 0.5, 2.0 * static_cast<double>(data.latency_us.size()), true});
  panel.frame();
  for (int bin = 0; bin < bins_per_decade * decades; ++bin) {
    const double count = counts[static_cast<std::size_t>(bin)];
    if (count == 0) continue;
    const Point top = panel.at({std::max(bin_start_us(bin), low), count});
    const Point foot = panel.at({std::min(bin_start_us(bin + 1), high), 0.5});
    svg.rectangle(top, foot.x - top.x - 1, foot.y - top.y, colour::sky);
  }
  for (const double us : {median_us, worst_us}) {
    panel.curve({{us, 0.5}, {us, 2.0 * static_cast<double>(data.latency_us.size())}}, {colour::black, 1.2, "4 3"});
    panel.name({us, static_cast<double>(data.latency_us.size())}, time_text(us), colour::black);
  }
  panel.place_names();
  return svg.str();
}

std::map<std::string, std::string> stream_pages(const StreamData& data, const StreamData& of_tube,
                                                const std::filesystem::path& page_md) {
  Page page;
  const auto is_right = [](const StreamData& d) {
    return d.not_converged == 0 && d.largest_error_mm() <= d.tolerance_mm;
  };
  for (const auto& [name, share] : shares) page.set_time(name, time_text(latency_us(data, share)));
  page.set_time("solves", std::to_string(data.latency_us.size()));
  page.set_time("machine", machine_line());
  page.set("length", fmt::format("{:g}", data.length_mm));
  page.set("tolerance", fmt::format("{:g}", data.tolerance_mm));
  page.set("samples", std::to_string(data.samples.size()));
  page.set("error", error_for_reader(data.largest_error_mm()));
  page.set_time("tube_median", time_text(latency_us(of_tube, 0.5)));
  page.set_time("tube_p99", time_text(latency_us(of_tube, 0.99)));
  page.set("tube_tolerance", fmt::format("{:g}", of_tube.tolerance_mm));
  page.set("tube_error", error_for_reader(of_tube.largest_error_mm()));
  page.check("all_right", is_right(data) && is_right(of_tube));
  page.check("slopes", data.without_slopes == 0 && of_tube.without_slopes == 0);
  page.check("no_allocation", data.allocations == 0 && of_tube.allocations == 0);
  const std::string answer = fmt::format(
      "a catheter with gravity, two tendons and a tip force, solved again with its Jacobians: {} in the "
      "median, {} at worst; {} judged solves off by at most {} mm",
      timed(time_text(latency_us(data, 0.5))), timed(time_text(latency_us(data, 1))), data.samples.size(),
      error_text(data.largest_error_mm(), 0));
  return {{"README.md", page.fill(page_md)}, {answers_file, answers_json({{"latency", answer}})}};
}

}  // namespace studies
