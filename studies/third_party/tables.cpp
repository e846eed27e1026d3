#include "studies/report/table.h"

#include "studies/compare/error_measures.h"
#include "studies/methods/registry.h"
#include "studies/report/chart.h"
#include "studies/report/page.h"
#include "studies/third_party/data.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace studies {
namespace {

constexpr int all_elements[] = {5, 10, 20, 40};

const ThirdPartyTip* tip_of(const ThirdPartyData& data, const std::string& name, const std::string& method, int n) {
  for (const ThirdPartyTip& tip : data.tips) {
    if (tip.load_case == name && tip.method == method && tip.elements == n) return &tip;
  }
  return nullptr;
}

// In order; those that CalculiX was given, or those left out.
std::vector<std::string> names_of(const ThirdPartyData& data, bool left_out) {
  std::vector<std::string> names;
  for (const ThirdPartyTip& tip : data.tips) {
    if (tip.method == "exact" && (tip_of(data, tip.load_case, calculix_key, 0) != nullptr) == left_out)
      names.push_back(tip.load_case);
  }
  return names;
}

std::string tips_csv(const ThirdPartyData& data) {
  Table table({"case", "method", "elements", "status", "load_share", "x_mm", "y_mm", "z_mm", "error_over_L"});
  for (const ThirdPartyTip& tip : data.tips) {
    const bool has_tip = tip.status == "converged";
    std::vector<std::string> row{tip.load_case, tip.method, std::to_string(tip.elements), tip.status,
                                 fixed(tip.load_share, 3)};
    const int digits = tip.method == calculix_key ? 7 : 4;  // --quick reads CalculiX's again
    for (const double x : tip.position_mm) row.push_back(has_tip ? fixed(x, digits) : "");
    row.push_back(has_tip ? scientific(std::max(tip.error_over_L, 1e-12), 1) : "");
    table.add(row);
  }
  return table.csv(
      {"Tips by CalculiX (as it prints them), FAM automatic, our finite elements and the exact reference."});
}

std::string timing_csv(const ThirdPartyData& data) {
  Table table({"case", "method", "elements", "time_us"});
  for (const ThirdPartyTip& tip : data.tips)
    table.add({tip.load_case, tip.method, std::to_string(tip.elements), significant(tip.time_us, 3)});
  return table.csv();
}

std::string error_cell(const ThirdPartyTip* tip) {
  if (!tip) return "–";
  if (tip->status == "converged") return error_for_reader(std::max(tip->error_over_L, 1e-12));
  return tip->status == "not_converged" ? fmt::format("stops at {:.0f} %", 100 * tip->load_share) : tip->status;
}

std::string error_table(const ThirdPartyData& data) {
  Table table({"case", "CalculiX, 5", "10", "20", "40 elements", "FAM automatic", "FE"});
  for (const std::string& name : names_of(data, false)) {
    std::vector<std::string> row{name};
    for (const int n : all_elements) row.push_back(error_cell(tip_of(data, name, calculix_key, n)));
    for (const char* key : {"fam", "fe"}) row.push_back(error_cell(tip_of(data, name, key, 0)));
    table.add(row);
  }
  return table.markdown();
}

std::string time_table(const ThirdPartyData& data) {
  Table table({"", "median", "longest"});
  const auto add = [&](const std::string& name, const std::string& method, int n) {
    std::vector<double> times;
    for (const ThirdPartyTip& tip : data.tips) {
      if (tip.method == method && tip.elements == n && tip.status == "converged") times.push_back(tip.time_us);
    }
    if (!times.empty()) table.add({name, time_text(quantile(times, 0.5)), time_text(quantile(times, 1))});
  };
  for (const int n : all_elements) add(fmt::format("CalculiX, {} elements", n), calculix_key, n);
  for (const char* key : {"fam", "fe", "exact"}) add(method_row(key).name, key, 0);
  return timed(table.markdown());
}

std::string abaqus_table(const ThirdPartyData& data) {
  Table table({"case", "elements", "Abaqus"});
  for (const ThirdPartyTip& tip : data.tips) {
    if (tip.method == abaqus_key) table.add({tip.load_case, std::to_string(tip.elements), error_cell(&tip)});
  }
  return table.markdown();
}

std::string convergence_picture(const ThirdPartyData& data) {
  const bool any_stops = std::any_of(data.tips.begin(), data.tips.end(), [](const ThirdPartyTip& tip) {
    return tip.method == calculix_key && tip.status == "not_converged";
  });
  Svg svg(760, 520, "CalculiX: distance of the tip from the exact one", "A curve a scene, both axes logarithmic.",
          any_stops ? "crosses at the upper edge: CalculiX did not converge" : "");
  constexpr double most = 2;
  Panel panel(svg, {80, 66}, 520, 390, {"elements", 4, 50, true}, {"distance / length", 1e-5, most, true});
  panel.frame();
  const std::string* colours[] = {&colour::blue, &colour::orange, &colour::green, &colour::purple, &colour::black};
  std::size_t i = 0;
  for (const std::string& name : names_of(data, false)) {
    std::vector<Point> points;
    const std::string& colour = *colours[i++ % 5];
    for (const int n : all_elements) {
      const ThirdPartyTip* tip = tip_of(data, name, calculix_key, n);
      if (!tip) continue;
      if (tip->status == "converged") points.push_back({static_cast<double>(n), tip->error_over_L});
      else panel.failure({static_cast<double>(n), 0.8 * most}, colour);
    }
    if (points.empty()) continue;
    panel.curve(points, {colour, 1.4, ""});
    panel.dots(points, colour, 2.4);
    panel.name(points.back(), name, colour);
  }
  panel.place_names();
  return svg.str();
}

std::string joined(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text.empty() ? "none" : text;
}

}  // namespace

std::map<std::string, std::string> third_party_files(const ThirdPartyData& data, const std::filesystem::path& page_md) {
  std::vector<double> finest, moved;
  std::vector<std::string> unsolved, growing;
  for (const std::string& name : names_of(data, false)) {
    const ThirdPartyTip *coarse = tip_of(data, name, calculix_key, 20), *fine = tip_of(data, name, calculix_key, 40);
    if (!fine) continue;
    if (fine->status != "converged") {
      unsolved.push_back(fmt::format("{} at {:.0f} %", name, 100 * fine->load_share));
      continue;
    }
    finest.push_back(fine->error_over_L);
    if (coarse->status != "converged") continue;
    moved.push_back(std::abs(fine->error_over_L - coarse->error_over_L));
    if (fine->error_over_L > coarse->error_over_L) growing.push_back(name);
  }
  const auto share = [&](double q) { return finest.empty() ? "–" : error_for_reader(quantile(finest, q)); };
  Page page;
  page.check("calculix", data.has_calculix);
  page.set("solved", std::to_string(finest.size()));
  page.set("given", std::to_string(names_of(data, false).size()));
  page.set("median", share(0.5));
  page.set("moved", moved.empty() ? "–" : error_for_reader(quantile(moved, 0.5)));
  page.set("worst", share(1));
  page.check("all_solved", unsolved.empty());
  page.set("unsolved", joined(unsolved));
  page.check("grows", !growing.empty());
  page.set("growing", joined(growing));
  page.set("left_out", joined(names_of(data, true)));
  page.set("from_fixed_20", fixed(data.from_fixed_mm[0], 3));
  page.set("from_fixed_40", fixed(data.from_fixed_mm[1], 3));
  page.set("from_follower_40", fixed(data.from_follower_mm[1], 3));
  page.set("frames_apart", fixed(data.frames_apart_mm, 4));
  const auto percent_off = [](double way) { return fmt::format("{:+.2f} %", 100 * (way - 1)); };
  page.set("circle_hard", percent_off(data.circle_way[0]));
  page.set("circle_soft", percent_off(data.circle_way[1]));
  page.set("tube_hard", percent_off(data.tube_way[0]));
  page.set("tube_soft", percent_off(data.tube_way[1]));
  const auto finest_of = [&](const std::string& name) { return error_cell(tip_of(data, name, calculix_key, 40)); };
  for (const char* name : {"P4", "P4_thin", "P8", "P8_thin", "S1_follower", "S2_follower"})
    page.set(name, finest_of(name));
  page.set("table", error_table(data));
  page.set("times", time_table(data));
  const bool has_abaqus = std::any_of(data.tips.begin(), data.tips.end(),
                                      [](const ThirdPartyTip& tip) { return tip.method == abaqus_key; });
  page.check("abaqus", has_abaqus);
  page.set("abaqus_table", abaqus_table(data));
  const std::string answer =
      data.has_calculix ? fmt::format(
                              "CalculiX with 40 elements ends {} L from the exact tip in the median and solves "
                              "{} of {} scenes",
                              share(0.5), finest.size(), names_of(data, false).size())
                        : "*ccx is not installed*";
  return {{"tips.csv", tips_csv(data)},
          {"timing.csv", timing_csv(data)},
          {"convergence.svg", convergence_picture(data)},
          {"README.md", page.fill(page_md)},
          {answers_file, answers_json({{"calculix", answer}})}};
}

}  // namespace studies
