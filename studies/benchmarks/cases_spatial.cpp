#include "studies/benchmarks/cases.h"

#include "exact_reference/solve.h"
#include "studies/report/table.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace studies {
namespace {

using std::numbers::pi;

std::vector<double> tip_xyz(const scene::Equilibrium& result, const std::vector<Printed>&) {
  const Eigen::Vector3d& tip = result.tip().position_B_mm;
  return {tip.x(), tip.y(), tip.z()};
}

int decimals_without_zeros(std::string text) {
  text.erase(text.find_last_not_of('0') + 1);
  return printed(text).decimals;
}

// The file pads to 6 decimals, and x and y may be displacements turned into positions; then z, which is printed as it
// was, shows the digits of the source.
std::vector<Printed> bend45_tip(const DataRow& row) {
  const int of_x = std::max(decimals_without_zeros(row.at("x")), decimals_without_zeros(row.at("y")));
  const int of_z = decimals_without_zeros(row.at("z"));
  const int decimals = of_x == 6 ? of_z : std::max(of_x, of_z);
  std::vector<Printed> tip;
  for (const char* axis : {"x", "y", "z"}) tip.push_back({std::stod(row.at(axis)), decimals});
  return tip;
}

void add_bend45_points(Benchmark& b, const StudyOptions& options) {
  for (const DataRow& row : data_rows(options.data / "03_bend45_published.csv")) {
    if (row.at("note").starts_with("NOT")) continue;  // another curve than the arc
    for (const std::string family : {"polar", "st_venant"}) {
      const std::string label = row.at("source") + ", F = " + row.at("F");
      b.points.push_back(benchmark_point(b.sources[family == "polar" ? 0 : 1], family, label, std::stod(row.at("F")),
                                         bend45_tip(row)));
    }
  }
  for (const DataRow& row : data_rows(options.data / "03_bend45_dead_reference.csv")) {
    const bool polar = row.at("GJ_choice") == "polar";
    if (row.at("model") != "SR" || std::stod(row.at("F")) > 600 || row.at("GJ_choice") == "sv") continue;
    b.points.push_back(benchmark_point(b.sources[polar ? 2 : 3], polar ? "polar" : "st_venant", "F = " + row.at("F"),
                                       std::stod(row.at("F")),
                                       {printed(row.at("x")), printed(row.at("y")), printed(row.at("z"))}));
  }
}

Benchmark bend45(const StudyOptions& options) {
  Benchmark b{
      "bend45",
      "45° bend, fixed force out of plane",
      {"polar", 600},
      50,
      {{"published_polar", "published tips, against J = 1/6", "published", 10, "coarse meshes, two torsion constants"},
       {"published_st_venant", "the same tips, against J = 0.141", "published", 10, "", true},
       {"computed_polar", "J = 1/6, independent", "computed"},
       {"computed_st_venant", "J = 0.141, independent", "computed"}}};
  const scene::Scene polar = benchmark_scene(options, "bend45_polar");
  const scene::Scene st_venant = benchmark_scene(options, "bend45_st_venant");
  // Between the two constants at F = 600: the line along which the published tips should lie.
  const auto with_constant = [=](double J) {
    scene::Scene scene = polar;
    std::get<scene::Stiffness>(scene.sections[0].cross_section).torsion_Nmm2 = 5e6 * J;
    return scene;
  };
  b.families = {{"polar", "F", [=](double F) { return scaled(polar, F / 600); }, tip_xyz},
                {"st_venant", "F", [=](double F) { return scaled(st_venant, F / 600); }, tip_xyz},
                {"constant", "J", with_constant, tip_xyz, 0.141, 1 / 6.0, 8}};
  add_bend45_points(b, options);
  return b;
}

Benchmark helix(const StudyOptions& options) {
  Benchmark b{"helix",
              "Helix of ten turns",
              {"tip", 0.5},
              100,
              {{"computed", "Taylor series of order 30 (Ibrahimbegović 1997 prints a curve)", "computed"}}};
  const scene::Scene base = benchmark_scene(options, "helix");
  const auto displacement = [](const scene::Equilibrium& e, const auto&) -> std::vector<double> {
    const Eigen::Vector3d& tip = e.tip().position_B_mm;
    return {tip.x() - 10, tip.y(), tip.z()};
  };
  b.families = {{"tip", "λ", [=](double lambda) { return scaled(base, lambda); }, displacement}};
  for (const DataRow& row : data_rows(options.data / "04_helix_reference_SR.csv")) {
    const double lambda = std::stod(row.at("lambda"));
    if (lambda != 0.05 && lambda != 0.1 && lambda != 0.2 && lambda != 0.5 && lambda != 1) continue;
    b.points.push_back(benchmark_point(b.sources[0], "tip", "λ = " + fixed(lambda, 2), lambda,
                                       {printed(row.at("u1")), printed(row.at("u2")), printed(row.at("u3"))}));
  }
  return b;
}

// Force P at the tip, beta from the stiff direction y.
scene::Scene princeton_scene(scene::Scene scene, double force_N, double beta_deg) {
  const double beta = beta_deg * pi / 180;
  std::get<scene::Force>(scene.loads[0]).value_N = {0, force_N * std::cos(beta), force_N * std::sin(beta)};
  return scene;
}

Benchmark princeton(const StudyOptions& options) {
  Benchmark b{"princeton",
              "Princeton beam",
              {"13.345", 45},
              50,
              {{"ansys_beam", "ANSYS beam elements (Obrezkov 2022)", "published", 10, "another beam program"},
               {"ansys_solid", "ANSYS solid elements (Obrezkov 2022)", "published", 10, "solid elements"},
               {"computed", "the same rod, independent", "computed"}}};
  const scene::Scene base = benchmark_scene(options, "princeton");
  const Observe stiff_weak = [](const scene::Equilibrium& e, const auto&) -> std::vector<double> {
    return {e.tip().position_B_mm.y(), e.tip().position_B_mm.z()};
  };
  for (const std::string force_N : {"4.448", "8.896", "13.345"}) {
    const double P = std::stod(force_N);
    b.families.push_back({force_N, "angle of the force from the stiff direction, deg",
                          [=](double beta) { return princeton_scene(base, P, beta); }, stiff_weak});
  }
  const auto in_mm = [](const std::string& metres) { return shifted(printed(metres), 3); };
  for (const DataRow& row : data_rows(options.data / "07_princeton_reference.csv")) {
    if (row.at("model") != "SR") continue;
    const std::string label = row.at("P") + " N, " + row.at("beta_deg") + "°";
    const auto add = [&](int source, const std::string& y, const std::string& z) {
      b.points.push_back(benchmark_point(b.sources[static_cast<std::size_t>(source)], row.at("P"), label,
                                         std::stod(row.at("beta_deg")), {in_mm(row.at(y)), in_mm(row.at(z))}));
    };
    if (!row.at("ansys_beam_y").empty()) add(0, "ansys_beam_y", "ansys_beam_z");
    if (!row.at("ansys_solid_y").empty()) add(1, "ansys_solid_y", "ansys_solid_z");
    add(2, "y_stiff", "z_weak");
  }
  return b;
}

double exact_sag_mm(const scene::Scene& scene) {
  const scene::Equilibrium result = exact_reference::solve(scene);
  if (!result.converged())
    throw std::runtime_error("benchmarks: the Pazy wing under its own weight: " + result.message);
  return result.tip().position_B_mm.z();
}

scene::Scene pazy_scene(scene::Scene scene, double mass_kg) {  // the tip mass is the last load
  std::get<scene::Force>(scene.loads.back()).value_N = {0, 0, -9.80665 * mass_kg};
  return scene;
}

Benchmark pazy(const StudyOptions& options) {
  Benchmark b{"pazy",
              "Pazy wing",
              {"1", 3},
              50,
              {{"measured", "Technion test (Avin et al. 2022)", "measured", 3, "a real wing"},
               {"umnast", "UM/NAST beam", "published", 10, "another beam program"},
               {"nastran", "Nastran, full model", "published", 10, "a full model of the wing"},
               {"elastica", "planar elastica of the same table", "computed"}}};
  for (const std::string skin : {"0", "1"}) {
    const scene::Scene base = benchmark_scene(options, "pazy_skin_" + skin);
    const double weight_mm = exact_sag_mm(pazy_scene(base, 0));
    const Observe deflection = [=](const scene::Equilibrium& e, const auto&) -> std::vector<double> {
      return {(e.tip().position_B_mm.z() - weight_mm) / 549.843728 * 100};
    };
    b.families.push_back({skin, "tip mass, kg", [=](double mass) { return pazy_scene(base, mass); }, deflection});
  }
  const char* columns[] = {"exp_pct", "umnast_beam_pct", "nastran_gfem_pct", "elastica_pct"};
  for (const DataRow& row : data_rows(options.data / "11_pazy_static_bending.csv")) {
    const double mass = std::stod(row.at("mass_kg"));
    for (std::size_t i = 0; mass > 0 && i < 4; ++i) {
      if (row.at(columns[i]).empty()) continue;
      const std::string label = (row.at("skin") == "0" ? "no skin, " : "skin, ") + row.at("mass_kg") + " kg";
      b.points.push_back(benchmark_point(b.sources[i], row.at("skin"), label, mass, {printed(row.at(columns[i]))}));
    }
  }
  return b;
}

Benchmark critical(const StudyOptions& options) {
  Benchmark b{"critical",
              "Critical loads",
              {"critical_euler", 0.5},
              50,
              {{"classical", "zeros of Bessel functions, 25 digits", "closed form"}}};
  const std::vector<std::array<std::string, 3>> columns = {
      {"critical_euler", "euler_clamped_free", "Euler column"},
      {"critical_heavy_column", "self_buckling_heavy_column", "heavy column"},
      {"critical_lateral_tip", "lateral_cantilever_centroid_tip_load", "lateral, tip force"},
      {"critical_lateral_uniform", "lateral_cantilever_uniform_load", "lateral, uniform load"},
      {"critical_beck", "beck_follower_flutter", "Beck's column (flutter)"}};
  for (const auto& [scene_name, constant, label] : columns) {
    const scene::Scene base = benchmark_scene(options, scene_name);
    BenchmarkFamily family{scene_name, "load / classical", [=](double factor) { return scaled(base, factor); }, {}};
    family.critical = true;
    b.families.push_back(family);
    for (const DataRow& row : data_rows(options.data / "06_critical_load_constants.csv")) {
      if (row.at("name") != constant) continue;
      b.points.push_back(benchmark_point(b.sources[0], scene_name, label, 1, {printed(row.at("value"))}));
    }
  }
  return b;
}

}  // namespace

std::vector<Benchmark> spatial_benchmarks(const StudyOptions& options) {
  return {bend45(options), helix(options), princeton(options), pazy(options), critical(options)};
}

}  // namespace studies
