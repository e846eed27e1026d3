#include "studies/benchmarks/cases.h"

#include "scene/load_visitor.h"

#include "studies/compare/error_measures.h"
#include "studies/compare/matching_digits.h"
#include "studies/report/table.h"
#include "studies/scenes/cases.h"

#include <algorithm>
#include <numbers>

namespace studies {
namespace {

using std::numbers::pi;

// Displacement of the tip towards the clamp and across, over `unit`.
Observe shortening_and_deflection(double length_mm, double unit_mm = 1) {
  return [=](const scene::Equilibrium& result, const auto&) -> std::vector<double> {
    const Eigen::Vector3d& tip = result.tip().position_B_mm;
    return {(length_mm - tip.x()) / unit_mm, tip.y() / unit_mm};
  };
}

std::vector<double> tip_xy(const scene::Equilibrium& result, const std::vector<Printed>&) {
  const Eigen::Vector3d& tip = result.tip().position_B_mm;
  return {tip.x(), tip.y()};
}

std::vector<double> tip_angle(const scene::Equilibrium& result, const std::vector<Printed>&) {
  return {result.tip_angle_rad};
}

// The point of the centreline nearest to the published one, among 4000 along the rod.
std::vector<double> nearest_point(const scene::Equilibrium& result, const std::vector<Printed>& published) {
  Eigen::Vector3d nearest = result.tip().position_B_mm;
  const Eigen::Vector3d wanted(published[0].value, published[1].value, 0);
  for (int i = 0; i <= 4000; ++i) {
    const Eigen::Vector3d p = position_at_mm(result, result.stations.back().s_mm * i / 4000);
    if ((p - wanted).norm() < (nearest - wanted).norm()) nearest = p;
  }
  return {nearest.x(), nearest.y()};
}

Benchmark rollup(const StudyOptions& options) {
  Benchmark b{"rollup",
              "Roll-up by one and two turns",
              {"two_turns", 1},
              50,
              {{"sze", "Sze, Liu & Lo 2004, end moment", "published"},
               {"closed", "circle of two turns (Simo & Vu-Quoc 1986, ex. 7.1)", "closed form"}}};
  const scene::Scene one = benchmark_scene(options, "rollup_one_turn");
  const scene::Scene two = benchmark_scene(options, "rollup_two_turns");
  b.families = {{"tip", "M / M_max", [=](double m) { return scaled(one, m); }, shortening_and_deflection(12)},
                {"two_turns", "M / 4π", [=](double m) { return scaled(two, m); }, shortening_and_deflection(1)},
                {"angle", "M / 4π", [=](double m) { return scaled(two, m); }, tip_angle}};
  for (const DataRow& row : data_rows(options.data / "02_sze2004_end_moment_published.csv")) {
    b.points.push_back(benchmark_point(b.sources[0], "tip", "M/M_max = " + row.at("M_over_Mmax"),
                                       std::stod(row.at("M_over_Mmax")),
                                       {printed(row.at("minus_U_pub")), printed(row.at("W_pub"))}));
  }
  b.points.push_back(benchmark_point(b.sources[1], "two_turns", "M L/EI = 4π", 1, {{1, 12}, {0, 12}}));
  b.points.push_back(benchmark_point(b.sources[1], "angle", "M L/EI = 4π, angle", 1, {{4 * pi, 12}}));
  return b;
}

Benchmark elastica(const StudyOptions& options) {
  Benchmark b{"elastica",
              "Transverse elastica, fixed tip force",
              {"tip", 10},
              50,
              {{"mattiasson", "Mattiasson 1981, as quoted", "published"},
               {"sze", "Sze, Liu & Lo 2004, end shear", "published", 10, "shell elements"},
               {"closed", "elliptic integrals, 40-digit arithmetic", "closed form"}}};
  const scene::Scene base = benchmark_scene(options, "elastica");  // alpha = F L^2/EI = 4, L = 10
  const auto at = [=](double alpha) { return scaled(base, alpha / 4); };
  b.families = {{"tip", "F L²/EI", at, shortening_and_deflection(10, 10)}, {"angle", "F L²/EI", at, tip_angle}};
  std::map<std::string, std::map<std::string, Printed>> mattiasson;
  for (const DataRow& row : data_rows(options.data / "01_mattiasson_published.csv")) {
    mattiasson[row.at("alpha")][row.at("quantity")] = printed(row.at("published"));
  }
  for (const char* alpha : {"1", "2", "5", "10"}) {
    const auto& of = mattiasson[alpha];
    const std::string label = std::string("F L²/EI = ") + alpha;
    b.points.push_back(benchmark_point(b.sources[0], "tip", label, std::stod(alpha), {of.at("u/L"), of.at("w/L")}));
    if (of.count("theta")) {
      b.points.push_back(benchmark_point(b.sources[0], "angle", label + ", theta", std::stod(alpha), {of.at("theta")}));
    }
  }
  for (const DataRow& row : data_rows(options.data / "01_sze2004_end_shear_published.csv")) {  // L = 10
    const double alpha = 4 * std::stod(row.at("P_over_Pmax"));
    b.points.push_back(
        benchmark_point(b.sources[1], "tip", "F L²/EI = " + fixed(alpha, 1), alpha,
                        {shifted(printed(row.at("minus_U_pub")), -1), shifted(printed(row.at("W_pub")), -1)}));
  }
  add_points(b, b.sources[2], "tip", options,
             {"01_cantilever_dead_tip_load_elliptic.csv",
              "alpha",
              "F L²/EI",
              {0.1, 1, 5, 10, 25, 100},
              {"u_over_L", "w_over_L"}});
  return b;
}

// Every eighth point that was read off the curves of Simo & Vu-Quoc.
void add_simo(Benchmark& b, const StudyOptions& options) {
  std::map<std::string, int> counts;
  for (const DataRow& row : data_rows(options.data / "05_simo1986_follower_digitised.csv")) {
    const std::string& quantity = row.at("quantity");
    if (counts[quantity]++ % 8 != 0) continue;
    const double load_kN = std::stod(row.at("P_kN"));
    const std::string family = quantity == "-u_axial" ? "axial" : "transverse";
    b.points.push_back(benchmark_point(b.sources[0], family, family + ", P = " + fixed(load_kN, 1) + " kN", load_kN,
                                       {printed(row.at("digitised"))}, 100));
  }
}

// The shapes of Argyris & Symeonidis bend to -y, ours to +y.
void add_argyris(Benchmark& b, const StudyOptions& options, const std::function<scene::Scene(double)>& at) {
  int points = 0;
  for (const DataRow& row : data_rows(options.data / "05_argyris1981_follower_shapes_digitised.csv")) {
    const double load_kN = std::stod(row.at("P_kN"));
    const std::string family = "shape_" + row.at("P_kN");
    if (b.families.back().name != family) {
      b.families.push_back({family, "P, kN", at, nearest_point, load_kN, load_kN, 1, true, false});
      points = 0;
    }
    b.points.push_back(benchmark_point(b.sources[1], family,
                                       "P = " + row.at("P_kN") + " kN, point " + std::to_string(++points), load_kN,
                                       {printed(row.at("x")), shifted(printed(row.at("y")), 0, -1)}, 100));
  }
}

Benchmark follower(const StudyOptions& options) {
  Benchmark b{"follower",
              "Cantilever under a follower force",
              {"tip", 40},
              50,
              {{"simo", "Simo & Vu-Quoc 1986, ex. 7.2, curves", "digitised", 2, "read off a figure"},
               {"argyris", "Argyris & Symeonidis 1981, shapes (EI = 3.5e7)", "digitised", 2, "read off a figure"},
               {"computed", "marched from the tip, independent", "computed"}}};
  const scene::Scene base = benchmark_scene(options, "follower_cantilever");  // 130 kN
  const auto at = [=](double load_kN) { return scaled(base, load_kN / 130); };
  const auto axial = [](const scene::Equilibrium& e, const auto&) -> std::vector<double> {
    return {100 - e.tip().position_B_mm.x()};
  };
  const auto transverse = [](const scene::Equilibrium& e, const auto&) -> std::vector<double> {
    return {e.tip().position_B_mm.y()};
  };
  const auto at_beta = [=](double beta) { return scaled(base, beta * 3.5 / 130); };
  const auto unit_tip = [](const scene::Equilibrium& e, const auto&) -> std::vector<double> {
    return {e.tip().position_B_mm.x() / 100, e.tip().position_B_mm.y() / 100};
  };
  b.families = {
      {"axial", "P, kN", at, axial}, {"transverse", "P, kN", at, transverse}, {"tip", "P L²/EI", at_beta, unit_tip}};
  add_simo(b, options);
  add_argyris(b, options, at);
  add_points(
      b, b.sources[2], "tip", options,
      {"05_follower_tip_force_reference.csv", "beta", "P L²/EI", {1, 4, 10, 20, 30, 40}, {"x_over_L", "y_over_L"}});
  return b;
}

Benchmark thick(const StudyOptions& options) {
  Benchmark b{"thick",
              "Thick cantilever",
              {"tip", 1},
              50,
              {{"exudyn", "Nachbagauer 2011, as in EXUDYN", "published", 10, "1024 and 256 elements"},
               {"computed", "the same rod, independent", "computed"}}};
  const scene::Scene base = benchmark_scene(options, "thick_cantilever");
  const auto at = [=](double factor) { return scaled(base, factor); };
  b.families = {{"tip", "F / 6.25e7 N", at, shortening_and_deflection(2000)}};
  for (const DataRow& row : data_rows(options.data / "12_misc_planar_published.csv")) {
    const bool large = row.at("case").starts_with("Nachbagauer");
    if (!large && !row.at("case").starts_with("same")) continue;
    const std::string label = large ? "F = 6.25e7 N" : "F = 6.25e4 N";
    const auto in_mm = [&](const char* x, const char* y) {  // from metres
      return std::vector<Printed>{shifted(printed(row.at(x)), 3), shifted(printed(row.at(y)), 3)};
    };
    b.points.push_back(benchmark_point(b.sources[0], "tip", label, large ? 1 : 1e-3, in_mm("ux_pub", "uy_pub")));
    b.points.push_back(benchmark_point(b.sources[1], "tip", label, large ? 1 : 1e-3, in_mm("ux_ref", "uy_ref")));
  }
  return b;
}

Benchmark heavy(const StudyOptions& options) {
  Benchmark b{"heavy",
              "Heavy elastica and distributed follower force",
              {"fixed", 25},
              50,
              {{"computed", "heavy elastica, independent", "computed"},
               {"conservative", "PyElastica's table, fixed load", "published", 10, "no paper named"},
               {"follower", "PyElastica's table, follower load", "published", 10, "no paper named"}}};
  const scene::Scene weight = benchmark_scene(options, "heavy_elastica");
  const scene::Scene turning = benchmark_scene(options, "distributed_follower");
  b.families = {{"fixed", "q L³/EI", [=](double g) { return scaled(weight, g / 25); }, tip_xy},
                {"follower", "q L³/EI", [=](double g) { return scaled(turning, g / 25); }, tip_xy}};
  add_points(b, b.sources[0], "fixed", options,
             {"08_heavy_elastica_reference.csv", "g", "q L³/EI", {1, 5, 10, 25, 100, 1000}, {"x_over_L", "y_over_L"}});
  for (const DataRow& row : data_rows(options.data / "08_pyelastica_distributed_published.csv")) {
    const bool fixed_load = row.at("type") == "conservative";
    b.points.push_back(benchmark_point(b.sources[fixed_load ? 1 : 2], fixed_load ? "fixed" : "follower",
                                       "q L³/EI = " + row.at("g"), std::stod(row.at("g")),
                                       {printed(row.at("x_pub")), printed(row.at("y_pub"))}));
  }
  return b;
}

}  // namespace

scene::Scene scaled(scene::Scene scene, double factor) {
  for (scene::Load& load : scene.loads) load = scene::scaled(load, factor);
  return scene;
}

scene::Scene benchmark_scene(const StudyOptions& options, const std::string& name) {
  return read_case(options.cases, "benchmarks/" + name);
}

BenchmarkPoint benchmark_point(const BenchmarkSource& source, const std::string& family, const std::string& label,
                               double parameter, const std::vector<Printed>& published, double scale) {
  return {source.key, family, label, parameter, published, scale == 0 ? norm(published) : scale, source.digits};
}

void add_points(Benchmark& benchmark, const BenchmarkSource& source, const std::string& family,
                const StudyOptions& options, const ChosenRows& chosen) {
  for (const DataRow& row : data_rows(options.data / chosen.file)) {
    const std::string& value = row.at(chosen.parameter);
    if (std::ranges::count(chosen.values, std::stod(value)) == 0) continue;
    std::vector<Printed> published;
    for (const std::string& column : chosen.published) published.push_back(printed(row.at(column)));
    benchmark.points.push_back(
        benchmark_point(source, family, chosen.name + " = " + value, std::stod(value), published));
  }
}

std::vector<Benchmark> planar_benchmarks(const StudyOptions& options) {
  return {rollup(options), elastica(options), follower(options), thick(options), heavy(options)};
}

}  // namespace studies
