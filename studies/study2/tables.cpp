#include "studies/report/page.h"
#include "studies/report/provenance.h"
#include "studies/report/table.h"
#include "studies/study2/page.h"
#include "studies/compare/timing_cells.h"

#include <fmt/format.h>

namespace studies {
namespace {

const std::string about_loads =
    "Forces of our own (studies/cases/study2/study2*.json); the paper's are lost. mm, base frame.";

// Smaller errors do not matter on half a metre of catheter and are not told apart but in errors_along.csv.
constexpr double told_mm = 1e-5;

std::string told_text_mm(double error_mm) {
  return error_mm < told_mm ? "< 1e-5" : scientific(error_mm, 1);
}

std::string shapes_csv(const Study2Data& data) {
  Table table({"scene", "method", "s_mm", "x_mm", "y_mm", "z_mm"});
  for (const Study2Row& r : data.rows) {
    for (std::size_t i = 0; i < r.s_mm.size(); ++i) {
      const auto& p = r.positions_mm[i];
      table.add({r.scene, r.method, fixed(r.s_mm[i], 1), fixed(p[0], 4), fixed(p[1], 4), fixed(p[2], 4)});
    }
  }
  return table.csv({about_loads});
}

std::string errors_along_csv(const Study2Data& data) {
  Table table({"scene", "method", "s_mm", "error_mm"});
  for (const Study2Row& r : data.rows) {
    for (std::size_t i = 0; i < r.s_mm.size(); ++i) {
      if (r.method != "exact") table.add({r.scene, r.method, fixed(r.s_mm[i], 1), scientific(r.errors_mm[i], 2)});
    }
  }
  return table.csv({about_loads, "Distance from the exact rod with shear at equal arc lengths."});
}

std::string errors_csv(const Study2Data& data) {
  Table table({"scene", "method", "status", "tip_error_mm", "largest_error_mm", "largest_deflection_mm"});
  for (const Study2Row& r : data.rows) {
    if (r.s_mm.empty()) {
      table.add({r.scene, r.method, r.status, "", "", ""});
      continue;
    }
    table.add({r.scene, r.method, r.status, told_text_mm(r.errors_mm.back()), told_text_mm(largest_error_mm(r)),
               fixed(largest_deflection_mm(r), 4)});
  }
  return table.csv(
      {about_loads, fmt::format("Errors: distance from the exact rod with shear at equal arc lengths, its {} stations.",
                         row(data, "study2", "exact").s_mm.size())});
}

std::string timing_csv(const Study2Data& data) {
  Table table(with_timing_columns({"scene", "method"}));
  for (const Study2Row& r : data.rows) {
    if (!r.s_mm.empty()) table.add(with_timing({r.scene, r.method}, r.timing, fixed, 2));
  }
  return table.csv({machine_line()});
}

const std::vector<std::string> scene_columns = {"forces alone", "weight along −y", "weight along −z"};

}  // namespace

std::map<std::string, std::string> study2_csv(const Study2Data& data) {
  return {{"shapes.csv", shapes_csv(data)},
          {"errors.csv", errors_csv(data)},
          {"errors_along.csv", errors_along_csv(data)},
          {"timing.csv", timing_csv(data)}};
}

std::string errors_table(const Study2Data& data) {
  Table table({"method", scene_columns[0], scene_columns[1], scene_columns[2]});
  for (const char* method : {"fam_published_12", "fam_published_50", "fam", "fam_1e-3", "fam_1e-6",
                             "fam_sixth_order_12", "fe", "exact_kirchhoff"}) {
    std::vector<std::string> cells{study2_label(method)};
    for (const std::string& scene : study2_scenes) {
      const Study2Row& r = row(data, scene, method);
      cells.push_back(r.s_mm.empty() ? r.status : told_text_mm(largest_error_mm(r)));
    }
    table.add(cells);
  }
  std::vector<std::string> cells{"*largest deflection of the exact rod*"};
  for (const std::string& scene : study2_scenes) {
    cells.push_back(scientific(largest_deflection_mm(row(data, scene, "exact")), 1));
  }
  table.add(cells);
  return table.markdown();
}

std::string times_table(const Study2Data& data) {
  Table table({"method", "timed", scene_columns[0], "quartiles", scene_columns[1], scene_columns[2]});
  for (const auto& [method, what] : {std::pair{"fam", "`fam solve`, all of it"},
                                     {"fam_1e-3", "`fam solve`, all of it"},
                                     {"fam_1e-6", "`fam solve`, all of it"},
                                     {"fam_sixth_order_12", "the solve alone"},
                                     {"fam_published_12", "the march alone"},
                                     {"fe", "all but reading the scene"},
                                     {"exact", "all but reading the scene"}}) {
    std::vector<std::string> cells{study2_label(method), what};
    for (const std::string& scene : study2_scenes) {
      const Study2Row& r = row(data, scene, method);
      const Timing& t = r.timing;
      cells.push_back(r.s_mm.empty() ? r.status : significant(t.median_us, 3));
      if (scene != "study2") continue;
      cells.push_back(t.has_spread() ? significant(t.lower_quartile_us, 3) + " … " + significant(t.upper_quartile_us, 3)
                                     : "–");
    }
    table.add(cells);
  }
  return timed(table.markdown());
}

}  // namespace studies
