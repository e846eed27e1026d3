#include "scene/path_file.h"

#include "scene/load_visitor.h"
#include "scene/scene_file.h"
#include "scene/scene_reader.h"

#include <fmt/format.h>

namespace scene {
namespace {

std::size_t load_index(const JsonNode& node) {
  return static_cast<std::size_t>(node.integer(0, max_loads));
}

// x, y and z, or the tension of a tendon.
int read_component(const JsonNode& node, const Load* load) {
  if (load && tendon_of(*load)) {
    node.one_of({"tension"});
    return 0;
  }
  return static_cast<int>(node.one_of({"x", "y", "z"}));
}

void read_parameter(const JsonNode& node, PathRequest& request) {
  const auto only = [&](const char* key, PathParameter parameter) {
    if (node.has(key) && request.parameter != parameter)
      node.at(key).refuse(fmt::format("is for the parameter {} alone", name(parameter)));
    return request.parameter == parameter;
  };
  request.parameter = static_cast<PathParameter>(
      node.at("parameter").one_of({"load_factor", "turn_rad", "rest_curvature_factor", "value"}));
  if (only("loads", PathParameter::load_factor) && node.has("loads")) {
    for (const JsonNode& load : node.at("loads").items()) request.loads.push_back(load_index(load));
    if (request.loads.empty()) node.at("loads").refuse("must name a load, or be left out for all of them");
  }
  if (only("axis", PathParameter::turn_rad)) request.axis_B = node.at("axis").vector<3>();
  only("component", PathParameter::value);
  if (only("load", PathParameter::value)) {
    request.loads = {load_index(node.at("load"))};
    const std::size_t load = request.loads.front();
    const bool there = load < request.scene.loads.size();
    request.component = read_component(node.at("component"), there ? &request.scene.loads[load] : nullptr);
  }
}

PathRequest read(const JsonNode& file) {
  file.allow_keys({"scene", "path"});
  PathRequest request;
  request.scene = read_scene(file.at("scene"));
  const JsonNode node = file.at("path");
  node.allow_keys(
      {"parameter", "loads", "axis", "load", "component", "from", "to", "stop_at", "branches", "largest_step"});
  read_parameter(node, request);
  request.from = node.at("from").number();
  request.to = node.at("to").number();
  if (node.has("stop_at")) {
    for (const JsonNode& stop : node.at("stop_at").items()) request.stop_at.push_back(stop.number());
  }
  if (node.has("branches")) request.branches = node.at("branches").integer(0, max_path_branches);
  if (node.has("largest_step")) request.largest_step = node.at("largest_step").number();
  return request;
}

PathRequest read(const std::string& text, const std::string& source) {
  const Json json = parse(text, source);
  PathRequest request = read(JsonNode(json, "", source));
  validate(request, source);
  return request;
}

}  // namespace

PathRequest read_path(std::istream& input, const std::string& source) {
  return read(read_text(input, source), source);
}

PathRequest read_path_file(const std::string& path) {
  std::string source;
  const std::string text = read_text_file(path, source);
  return read(text, source);
}

std::string to_json(const Path& path) {
  Json json{{"status", name(path.status)}, {"message", path.message}, {"points", Json::array()}};
  for (const PathPoint& point : path.points) {
    const Eigen::Vector3d& tip = point.tip_position_B_mm;
    Json entry{{"parameter", point.parameter},
               {"tip_position_mm", {tip[0], tip[1], tip[2]}},
               {"index", point.index ? Json(*point.index) : Json(nullptr)},
               {"stable", point.stable ? Json(*point.stable) : Json(nullptr)},
               {"kind", name(point.kind)},
               {"branch", point.branch}};
    if (point.neutral) entry["neutral"] = true;
    if (point.multiplicity > 0) entry["multiplicity"] = point.multiplicity;
    json["points"].push_back(std::move(entry));
  }
  return json.dump(2) + "\n";
}

std::string to_csv(const Path& path) {
  std::string csv = "parameter,x_mm,y_mm,z_mm,index,stable,kind,branch,multiplicity,neutral\n";
  for (const PathPoint& point : path.points) {
    const Eigen::Vector3d& tip = point.tip_position_B_mm;
    csv += fmt::format("{},{},{},{},{},{},{},{},{},{}\n", point.parameter, tip[0], tip[1], tip[2],
                       point.index ? std::to_string(*point.index) : "", point.stable ? (*point.stable ? "1" : "0") : "",
                       name(point.kind), point.branch, point.multiplicity, point.neutral ? 1 : 0);
  }
  return csv;
}

}  // namespace scene
