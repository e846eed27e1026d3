#include "studies/report/table.h"
#include "studies/segmentation/ablation.h"

#include <algorithm>
#include <cmath>

namespace studies {
namespace {

std::string yes(bool value) {
  return value ? "yes" : "no";
}

std::string without_commas(std::string name) {
  std::replace(name.begin(), name.end(), ',', ';');
  return name;
}

std::string ablation_csv(const AblationData& data) {
  Table table({"group", "variant", "arcs", "error_mm", "error_fe_mm", "bias_rad", "scatter_rad", "largest_relative",
               "sums_mm", "moment_drift"});
  for (const AblationRow& row : data.rows) {
    for (const AblationPoint& p : row.points) {
      table.add({row.group, without_commas(row.name), std::to_string(p.arcs), one_digit(p.error_mm), one_digit(p.fe_mm),
                 one_digit(p.bias_rad), one_digit(p.scatter_rad), one_digit(p.largest_relative), one_digit(p.sums_mm),
                 one_digit(p.drift)});
    }
  }
  return table.csv({"P4 (our loads). One digit each, absolute values; 1e-12 stands for that and less.",
                    "error: against the exact Kirchhoff rod; error_fe: against finite elements with shear and stretch; "
                    "the other columns: ablation.md."});
}

std::string trends_csv(const AblationData& data) {
  Table table({"variant", "against", "minimum_arcs", "minimum_mm", "at_12_mm", "at_500_mm", "at_5000_mm",
               "largest_12_to_500_mm", "minimum_near_12", "under_3_mm", "rises_beyond_500"});
  for (const AblationRow& row : data.rows) {
    for (const bool fe : {false, true}) {
      const Trend t = trend(row, fe ? &AblationPoint::fe_mm : &AblationPoint::error_mm);
      table.add({without_commas(row.name), fe ? "fe" : "exact", std::to_string(t.minimum_arcs), one_digit(t.minimum_mm),
                 one_digit(t.at_12_mm), one_digit(t.at_500_mm), one_digit(t.at_5000_mm),
                 one_digit(t.largest_12_to_500_mm), yes(t.minimum_near_12()), yes(t.under_3_mm()), yes(t.rises())});
    }
  }
  return table.csv({"P4 (our loads). near 12: 8 to 30; rises: the error of 5000 arcs is more than twice that of 500."});
}

std::string cancellation_csv(const AblationData& data) {
  Table table({"arcs", "angle_rad", "single", "double"});
  for (const Cancellation& c : data.cancellations) {
    table.add(
        {std::to_string(c.arcs), one_digit(c.angle_rad), one_digit(c.single_precision), one_digit(c.double_precision)});
  }
  return table.csv({"Relative error of (1 - cos t)/t^2 as written, at t = 2.3 rad / arcs. One digit."});
}

void census_cells(const Census& c, const std::string& against, Table& table) {
  const bool any = c.all_three > 0;
  table.add({c.search, against, std::to_string(c.curves), std::to_string(c.rise), std::to_string(c.under_3_mm),
             std::to_string(c.minimum_near_12), std::to_string(c.all_three), any ? one_digit(c.smallest_all) : "–",
             any ? one_digit(c.largest_all) : "–"});
}

std::string census_csv(const AblationData& data) {
  Table table({"search", "against", "curves", "rise", "under_3_mm", "minimum_near_12", "all_three",
               "smallest_tolerance_of_those", "largest_tolerance_of_those"});
  for (const Census& c : data.censuses) census_cells(c, c.against, table);
  return table.csv({"P4 (our loads). 41 absolute tolerances from 1e-4 to 1e-2 rad, evenly in their logarithm."});
}

}  // namespace

// Weak arithmetic is chaotic, and more digits would not come out again under other compilers.
std::string one_digit(double value) {
  constexpr double round_off = 1e-12;
  return std::isfinite(value) ? scientific(std::max(std::abs(value), round_off), 0) : "–";
}

std::string census_table(const AblationData& data) {
  Table table({"search", "against", "tolerances", "rise beyond 500", "under 3 mm", "minimum near 12", "all three",
               "from, rad", "to, rad"});
  for (const Census& c : data.censuses) census_cells(c, c.against == "fe" ? "FE" : c.against, table);
  return table.markdown();
}

std::string trend_table(const AblationData& data) {
  Table table({"weakness", "off by at N = 12, mm", "500", "5000", "least at N", "minimum near 12", "under 3 mm",
               "rises beyond 500"});
  for (const AblationRow& row : data.rows) {
    if (row.group == "tolerance") continue;
    const Trend t = trend(row, &AblationPoint::error_mm);
    table.add({row.name, one_digit(t.at_12_mm), one_digit(t.at_500_mm), one_digit(t.at_5000_mm),
               std::to_string(t.minimum_arcs), yes(t.minimum_near_12()), yes(t.under_3_mm()), yes(t.rises())});
  }
  return table.markdown();
}

std::string tolerance_table(const AblationData& data) {
  const std::vector<std::string> tolerances = {"1e-02", "3e-03", "1e-03", "1e-04", "1e-05", "1e-06", "1e-08"};
  std::vector<std::string> columns = {"off by at N = 5000, mm; tolerance"};
  for (const std::string& tolerance : tolerances) columns.push_back(for_reader(tolerance));
  Table table(columns);
  for (const char* search : {"golden section", "bisection", "Brent", "secant root", "radius, golden"}) {
    std::vector<std::string> cells{search};
    for (const std::string& tolerance : tolerances) {
      cells.push_back(one_digit(data.point(std::string(search) + " " + tolerance, 5000).error_mm));
    }
    table.add(cells);
  }
  return table.markdown();
}

std::string mechanism_table(const AblationData& data) {
  Table table({"at N = 5000", "tip error, mm", "bias, rad", "bias × L/2, mm", "scatter, rad", "largest relative error",
               "lost in sums, mm", "drift of the moment"});
  for (const char* name : {"sound: double, root of dPi/dtheta", "single precision", "single, unsafe", "golden section",
                           "single, golden, expanded Pi", "golden section 1e-03", "golden section 3e-03",
                           "bisection 1e-03", "Brent 1e-03", "force not turned in the arc"}) {
    const AblationPoint& p = data.point(name, 5000);
    table.add({name, one_digit(p.error_mm), one_digit(p.bias_rad), one_digit(data.length_mm / 2 * p.bias_rad),
               one_digit(p.scatter_rad), one_digit(p.largest_relative), one_digit(p.sums_mm), one_digit(p.drift)});
  }
  return table.markdown();
}

std::map<std::string, std::string> ablation_tables(const AblationData& data) {
  return {{"ablation.csv", ablation_csv(data)},
          {"trends.csv", trends_csv(data)},
          {"cancellation.csv", cancellation_csv(data)},
          {"census.csv", census_csv(data)}};
}

}  // namespace studies
