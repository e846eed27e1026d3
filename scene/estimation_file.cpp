#include "scene/estimation_file.h"

#include "scene/json_node.h"
#include "scene/load_visitor.h"

#include <tuple>

namespace scene {
namespace {

using Kind = Unknown::Kind;

double place_of(const JsonNode& node, double length_mm) {
  return node.is_tip() ? length_mm : node.number("must be \"tip\" or a number in mm");
}

Eigen::Matrix3d rotation_of(const JsonNode& node) {
  const std::vector<JsonNode> rows = node.items();
  if (rows.size() != 3) node.refuse("must be 3 rows of 3 numbers");
  Eigen::Matrix3d rotation;
  for (int i = 0; i < 3; ++i) rotation.row(i) = rows[static_cast<std::size_t>(i)].vector<3>();
  return rotation;
}

Measurement measurement_of(const JsonNode& node, double length_mm) {
  node.require_object();
  const JsonNode kind = node.at("kind");
  const std::string name = kind.string();
  Measurement measurement;
  if (name == "base_wrench") {
    node.allow_keys({"kind", "force_N", "moment_Nmm", "sd_N", "sd_Nmm"});
    const Wrench wrench{node.at("force_N").vector<3>(), node.at("moment_Nmm").vector<3>()};
    measurement.value = BaseWrenchMeasurement{wrench, node.at("sd_N").number(), node.at("sd_Nmm").number()};
    return measurement;
  }
  if (name == "position") {
    node.allow_keys({"kind", "at", "value_mm", "sd_mm"});
    measurement.value = PositionMeasurement{node.at("value_mm").vector<3>(), node.at("sd_mm").number()};
  } else if (name == "rotation") {
    node.allow_keys({"kind", "at", "value", "sd_rad"});
    measurement.value = RotationMeasurement{rotation_of(node.at("value")), node.at("sd_rad").number()};
  } else if (name == "curvature") {
    node.allow_keys({"kind", "at", "value_per_mm", "sd_per_mm"});
    measurement.value = CurvatureMeasurement{node.at("value_per_mm").vector<2>(), node.at("sd_per_mm").number()};
  } else {
    kind.refuse("must be position, rotation, curvature or base_wrench");
  }
  measurement.s_mm = place_of(node.at("at"), length_mm);
  return measurement;
}

std::size_t index_of(const JsonNode& node, std::size_t count, const char* what) {
  const auto index = static_cast<std::size_t>(node.whole_number());
  if (index >= count) node.refuse("there are " + std::to_string(count) + " " + std::string(what) + ", counted from 0");
  return index;
}

void require_true(const JsonNode& node, const char* key) {
  if (!node.at(key).is_true()) node.at(key).refuse("must be true");
}

Unknown load_unknown(const JsonNode& node, const EstimationProblem& problem) {
  Unknown unknown;
  if (node.has("scene")) unknown.scene = index_of(node.at("scene"), problem.scenes.size(), "scenes");
  const std::vector<Load>& loads = problem.scenes[unknown.scene].scene.loads;
  unknown.index = index_of(node.at("load"), loads.size(), "loads");
  const Load& load = loads[unknown.index];
  if (node.has("at_mm")) {
    node.allow_keys({"scene", "load", "at_mm", "prior_mean", "prior_sd"});
    require_true(node, "at_mm");
    if (!has_place(load)) node.at("load").refuse("only a force or a moment stands at a place that can be found");
    unknown.kind = Kind::place;
    return unknown;
  }
  node.allow_keys({"scene", "load", "component", "prior_mean", "prior_sd"});
  const JsonNode component = node.at("component");
  const std::string name = component.string();
  const std::string names = tendon_of(load) ? "" : "xyz";
  const bool is_tension = names.empty() && name == "tension";
  if (!is_tension && (name.size() != 1 || names.find(name) == std::string::npos))
    component.refuse(std::string("the component of a ") + kind_name(load) + " must be " +
                     (names.empty() ? "tension" : "x, y or z"));
  unknown.component = is_tension ? 0 : static_cast<int>(names.find(name));
  return unknown;
}

Unknown section_unknown(const JsonNode& node, const EstimationProblem& problem) {
  Unknown unknown;
  unknown.index = index_of(node.at("section"), problem.scenes.front().scene.sections.size(), "sections");
  const std::tuple<const char*, Kind, int> known[] = {{"bending_factor", Kind::bending_factor, 0},
                                                      {"torsion_factor", Kind::torsion_factor, 0},
                                                      {"rest_curvature_y", Kind::rest_curvature, 1},
                                                      {"rest_curvature_z", Kind::rest_curvature, 2}};
  for (const auto& [key, kind, component] : known) {
    if (!node.has(key)) continue;
    node.allow_keys({"section", key, "prior_mean", "prior_sd"});
    require_true(node, key);
    unknown.kind = kind;
    unknown.component = component;
    return unknown;
  }
  node.refuse("must name bending_factor, torsion_factor, rest_curvature_y or rest_curvature_z");
}

Unknown unknown_of(const JsonNode& node, const EstimationProblem& problem) {
  node.require_object();
  if (node.has("load") == node.has("section")) node.refuse("must name either a load or a section");
  Unknown unknown = node.has("load") ? load_unknown(node, problem) : section_unknown(node, problem);
  unknown.prior_mean = value_in(problem, unknown);
  if (node.has("prior_sd")) unknown.prior_sd = node.at("prior_sd").number();
  if (node.has("prior_mean")) {
    if (!unknown.prior_sd) node.at("prior_mean").refuse("needs a prior_sd");
    unknown.prior_mean = node.at("prior_mean").number();
  }
  return unknown;
}

void add_scene(EstimationProblem& problem, const JsonNode& node, const JsonNode& measurements,
               const std::string& source, const std::string& path) {
  MeasuredScene measured{scene_of(node), {}};
  validate(measured.scene, source, path);  // before its length and its loads are asked for
  const double length = length_mm(measured.scene);
  for (const JsonNode& each : measurements.items()) measured.measurements.push_back(measurement_of(each, length));
  problem.scenes.push_back(std::move(measured));
}

}  // namespace

EstimationProblem read_estimation(std::istream& input, const std::string& source) {
  const Json json = read_json(input, source);
  const JsonNode root(json, "", source);
  EstimationProblem problem;
  root.require_object();
  if (root.has("scenes")) {
    root.allow_keys({"scenes", "unknowns"});
    const JsonNode scenes = root.at("scenes");
    int i = 0;
    for (const JsonNode& each : scenes.items()) {
      each.allow_keys({"scene", "measurements"});
      add_scene(problem, each.at("scene"), each.at("measurements"), source,
                "scenes[" + std::to_string(i++) + "].scene");
    }
    if (problem.scenes.empty()) scenes.refuse("must hold a scene");
  } else {
    root.allow_keys({"scene", "unknowns", "measurements"});
    add_scene(problem, root.at("scene"), root.at("measurements"), source, "scene");
  }
  const JsonNode unknowns = root.at("unknowns");
  for (const JsonNode& each : unknowns.items()) problem.unknowns.push_back(unknown_of(each, problem));
  validate(problem, source, root.has("scenes"));
  return problem;
}

EstimationProblem read_estimation_file(const std::string& path) {
  EstimationProblem problem;
  with_file(path, "estimation",
            [&](std::istream& input, const std::string& source) { problem = read_estimation(input, source); });
  return problem;
}

}  // namespace scene
