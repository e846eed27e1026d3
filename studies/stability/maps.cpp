#include "studies/stability/maps.h"

#include "scene/load_visitor.h"

#include "exact_reference/elastica.h"
#include "fam/engine.h"
#include "fam/solve.h"
#include "studies/methods/registry.h"
#include "studies/stability/planar_march.h"

#include <Eigen/Geometry>

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

namespace studies {
namespace {

using Eigen::Vector2d, Eigen::Vector3d;

constexpr double length_mm = 100, bending_Nmm2 = 1000;
constexpr double force_unit_N = bending_Nmm2 / (length_mm * length_mm), moment_unit_Nmm = bending_Nmm2 / length_mm;
constexpr double pi = std::numbers::pi;

const std::vector<double> many_loads = {0.01, 0.1, 1, 10, 100, 1000, 10'000};
const std::vector<double> cells = {1, 2, 4, 8, 16, 32, 64, 128, 256};
const std::vector<double> loads = {0.1, 1, 10, 30};

scene::Section uniform_section() {
  scene::Stiffness stiffness;
  stiffness.bending_Nmm2 = Vector2d::Constant(bending_Nmm2);
  stiffness.torsion_Nmm2 = 0.7 * bending_Nmm2;
  return {length_mm, stiffness, Vector3d::Zero()};
}

scene::Scene tip_force(scene::Frame frame, const Vector3d& force, scene::Section section = uniform_section()) {
  return {"", {section}, {scene::Force{section.length_mm, frame, force_unit_N * force}}};
}

scene::Scene tip_moment(const Vector3d& moment, const Vector3d& force) {
  return {"",
          {uniform_section()},
          {scene::Moment{length_mm, scene::Frame::follower, moment_unit_Nmm * moment},
           scene::Force{length_mm, scene::Frame::follower, force_unit_N * force}}};
}

Vector3d in_space(const exact_reference::PlanarPose& pose) {
  return {pose.position_B_mm[0], pose.position_B_mm[1], 0};
}

Vector3d follower_elastica(const Vector2d& force, double moment) {
  return in_space(exact_reference::Elastica::with_follower_load(
                      {length_mm, bending_Nmm2, force_unit_N * force, moment_unit_Nmm * moment})
                      .tip());
}

std::optional<Vector3d> fixed_elastica(const Vector2d& force) {
  const auto rod = exact_reference::Elastica::with_fixed_load({length_mm, bending_Nmm2, force_unit_N * force, 0});
  return rod ? std::optional(in_space(rod->tip())) : std::nullopt;
}

// Along the rod (0 deg) over across (90) to against it (180), where the rod buckles at pi^2/4.
Vector2d at_angle(double angle_deg, double size) {
  if (angle_deg == 180) return {-size, 0};
  return size * Vector2d(std::cos(angle_deg * pi / 180), std::sin(angle_deg * pi / 180));
}

std::optional<Vector3d> none(double, double) {
  return {};
}

std::vector<StabilityMap> load_maps() {
  const MapAxis load{"|F| L²/EI", many_loads}, count{"arcs or elements", cells};
  return {{"follower", "Transverse follower force at the tip", load, count, true,
           [](double f, double) {
             return tip_force(scene::Frame::follower, {0, f, 0});
           },
           [](double f, double) {
             return follower_elastica({0, f}, 0);
           }},
          {"fixed", "Transverse fixed force at the tip", load, count, true,
           [](double f, double) {
             return tip_force(scene::Frame::fixed, {0, f, 0});
           },
           [](double f, double) {
             return fixed_elastica({0, f});
           }},
          {"direction",
           "Direction of a fixed tip force: 0° pulls, 90° is across, 180° pushes (Euler: 2.467)",
           {"angle to the rod, degrees", {0, 90, 135, 170, 179, 179.9, 179.999, 180}},
           {"|F| L²/EI", {1, 2.46, 2.48, 10, 100}},
           false,
           [](double angle, double f) {
             const Vector2d force = at_angle(angle, f);
             return tip_force(scene::Frame::fixed, {force[0], force[1], 0});
           },
           [](double angle, double f) { return fixed_elastica(at_angle(angle, f)); }}};
}

StabilityMap precision_map() {
  return {"precision",
          "Transverse follower force: the same march in double and in single precision",
          {"|F| L²/EI", {0.01, 0.1, 1, 10, 100}},
          {"arcs", {1, 4, 16, 64, 256, 1024, 4096, 16384, 65536}},
          true,
          [](double f, double) {
            return tip_force(scene::Frame::follower, {0, f, 0});
          },
          [](double f, double) {
            return follower_elastica({0, f}, 0);
          }};
}

template <class T>
scene::Equilibrium solve_in_plane(const scene::Scene& scene, int arcs) {
  const double load = std::get<scene::Force>(scene.loads.front()).value_N[1] / force_unit_N;
  const std::array<T, 2> tip = planar_march<T>(load, arcs), finer = planar_march<T>(load, 2 * arcs);
  scene::Equilibrium result;
  result.status = scene::Status::converged;
  result.stations = {{length_mm, {Eigen::Matrix3d::Identity(), length_mm * Vector3d(tip[0], tip[1], 0)}}};
  // Second order: the finer march is off by a third of the difference. Arcs too long as in fam::solve.
  result.error_estimate_mm = length_mm * 4 / 3 * std::hypot(tip[0] - finer[0], tip[1] - finer[1]);
  if (std::sqrt(load) / arcs > fam::longest_load_length) {
    result.error_estimate_mm = std::max(result.error_estimate_mm, length_mm);
  }
  return result;
}

std::vector<StabilityMap> moment_maps() {
  const MapAxis turns{"turns", {0.25, 1.25, 2.25, 5.25, 9.75}}, count{"arcs or elements", cells};
  return {
      {"torque", "Follower torque, M L/GJ in turns, with a transverse follower force of 0.1 EI/L²", turns, count, true,
       [](double turn, double) {
         return tip_moment({0.7 * 2 * pi * turn, 0, 0}, {0, 0.1, 0});
       },
       none},
      {"moment", "Follower bending moment at the tip, M L/EI in turns", turns, count, true,
       [](double turn, double) {
         return tip_moment({0, 0, 2 * pi * turn}, Vector3d::Zero());
       },
       [](double turn, double) {
         return follower_elastica({0, 0}, 2 * pi * turn);
       }}};
}

scene::Scene slender(double load, double slenderness) {
  scene::Section section = uniform_section();
  auto& stiffness = std::get<scene::Stiffness>(section.cross_section);
  stiffness.shear_N = Vector2d::Constant(force_unit_N / slenderness);
  stiffness.axial_N = 2.5 * force_unit_N / slenderness;
  return tip_force(scene::Frame::fixed, {0, load, 0}, section);
}

scene::Scene twisting(double load, double torsion_over_bending) {
  scene::Section section = uniform_section();
  std::get<scene::Stiffness>(section.cross_section).torsion_Nmm2 = torsion_over_bending * bending_Nmm2;
  scene::Scene scene = tip_force(scene::Frame::follower, {0, load, 0}, section);
  scene.loads.push_back(scene::Moment{length_mm, scene::Frame::follower, {0, 0.3 * load * moment_unit_Nmm, 0}});
  return scene;
}

// A flat ribbon on edge: EI_z = ratio EI_y, GJ = 0.6 EI_y. It topples at F = 4.0126 sqrt(EI_y GJ)/L^2 where the ratio
// is large; a thousandth of the force pushes it sideways.
scene::Scene ribbon(double load, double ratio) {
  scene::Section section = uniform_section();
  auto& stiffness = std::get<scene::Stiffness>(section.cross_section);
  stiffness.bending_Nmm2 = {bending_Nmm2, ratio * bending_Nmm2};
  stiffness.torsion_Nmm2 = 0.6 * bending_Nmm2;
  const double force = 4.0126 * std::sqrt(0.6) * load;
  return tip_force(scene::Frame::fixed, {0, force, 1e-3 * force}, section);
}

// Clamped half `jump` times as stiff as the half at the tip.
scene::Scene jumping(double load, double jump) {
  scene::Section soft = uniform_section(), stiff = soft;
  soft.length_mm = stiff.length_mm = length_mm / 2;
  auto& stiffness = std::get<scene::Stiffness>(stiff.cross_section);
  stiffness.bending_Nmm2 *= jump;
  stiffness.torsion_Nmm2 *= jump;
  return {
      "", {stiff, soft}, {scene::Force{length_mm, scene::Frame::fixed, force_unit_N * Vector3d(0, load, 0.2 * load)}}};
}

std::vector<StabilityMap> section_maps() {
  const MapAxis load{"|F| L²/EI", loads};
  return {{"slenderness",
           "Transverse fixed force on a rod that shears and stretches",
           load,
           {"EI/(kGA L²)", {1e-8, 1e-4, 1e-2, 1e-1, 1}},
           false,
           slender,
           none},
          {"twist_stiffness",
           "Follower force across and 0.3 of it as moment: torsion over bending stiffness",
           load,
           {"GJ/EI", {1e-3, 1e-2, 1e-1, 1, 1e3}},
           false,
           twisting,
           none},
          {"ribbon",
           "Ribbon on edge, fixed force with a thousandth of it sideways",
           {"F / toppling load", {0.5, 0.99, 1.01, 2, 4}},
           {"EI_z/EI_y", {1, 10, 10'000}},
           false,
           ribbon,
           none},
          {"jump",
           "Half the rod stiffer, fixed force across",
           load,
           {"EI clamped / EI free half", {1e-4, 1e-2, 1, 1e2, 1e4}},
           false,
           jumping,
           none}};
}

constexpr double automatic_tolerance = 1e-4;  // over L, of FAM's automatic choice

Contender of_registry(const std::string& key, const std::string& method, int most_cells, int fixed_cells,
                      double largest_x = INFINITY) {
  Request request;
  if (method == "fam") request.tolerance = automatic_tolerance;
  if (method == "exact") request.tolerance = 1e-9;
  request.most_load_steps = most_load_steps;
  const auto solve = [method, request](const scene::Scene& scene, int count) {
    Request with_count = request;
    with_count.count = count;
    return method_row(method)(with_count)->solve(scene);
  };
  return {key, method, most_cells, fixed_cells, largest_x, "", "", solve};
}

Contender in_plane(const std::string& arithmetic, scene::Equilibrium (*solve)(const scene::Scene&, int)) {
  return {
      "midpoint in " + arithmetic + " precision", "fam_midpoint", 65536, 0, INFINITY, "precision", arithmetic, solve};
}

}  // namespace

std::vector<StabilityMap> stability_maps() {
  std::vector<StabilityMap> maps;
  for (const auto& group : {load_maps(), moment_maps(), section_maps(), {precision_map()}})
    maps.insert(maps.end(), group.begin(), group.end());
  return maps;
}

scene::Scene cell_scene(const std::string& map, double x, double y) {
  for (const StabilityMap& candidate : stability_maps()) {
    if (candidate.name != map) continue;
    scene::Scene scene = candidate.scene(x, y);
    scene::validate(scene);
    return scene;
  }
  throw scene::SceneError("no stability map is called \"" + map + "\"");
}

const std::vector<Contender>& contenders() {
  static const std::vector<Contender> list = {of_registry("published", "fam_published", 256, 16),
                                              of_registry("midpoint", "fam_midpoint", 256, 16),
                                              of_registry("fourth_order", "fam_fourth_order", 256, 16),
                                              of_registry("sixth_order", "fam_sixth_order", 256, 16),
                                              of_registry("fam automatic", "fam", 0, 0),
                                              of_registry("fem linear", "fe_linear", 16, 8, 1000),
                                              of_registry("fem quadratic", "fe", 16, 8, 1000),
                                              of_registry("rk4 shooting", "rk4", 256, 16),
                                              of_registry("exact", "exact", 0, 0),
                                              in_plane("double", solve_in_plane<double>),
                                              in_plane("single", solve_in_plane<float>)};
  return list;
}

const Contender& contender(const std::string& key) {
  for (const Contender& contender : contenders()) {
    if (contender.key == key) return contender;
  }
  throw std::out_of_range("no contender has the key " + key);
}

std::string Contender::name() const {
  return method_row(method).name + (arithmetic.empty() ? "" : ", " + arithmetic + " precision");
}

std::string Contender::command(int cells) const {
  const std::string options = method_row(method).options;
  if (!automatic()) return options + std::to_string(cells);
  return method == "fam" ? options + fmt::format(" --tolerance-mm {}", automatic_tolerance * length_mm) : options;
}

std::optional<scene::Scene> turned_to_follower(const scene::Scene& scene, const scene::Equilibrium& equilibrium) {
  const Eigen::Matrix3d tip_BS = equilibrium.tip().rotation_BS;
  const double tip_mm = scene::length_mm(scene);
  scene::Scene turned = scene;
  const auto at_tip = [&](const auto& load) { return load.at_mm >= tip_mm; };
  // False where a load cannot be turned.
  const auto turn = [&](scene::Load& load) {
    return scene::visit_load(
        load,
        [&](scene::Force& f) {
          if (f.frame == scene::Frame::follower) return true;
          f = {f.at_mm, scene::Frame::follower, tip_BS.transpose() * f.value_N};
          return at_tip(f);
        },
        [&](scene::Moment& m) {
          if (m.frame == scene::Frame::follower) return true;
          m = {m.at_mm, scene::Frame::follower, tip_BS.transpose() * m.value_Nmm};
          return at_tip(m);
        },
        [](scene::DistributedForce& d) { return d.frame == scene::Frame::follower; },
        [](scene::Gravity&) { return false; }, [](scene::Tendon&) { return true; });
  };
  if (!std::all_of(turned.loads.begin(), turned.loads.end(), turn)) return {};
  return turned;
}

}  // namespace studies
