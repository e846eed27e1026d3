#include "scene/path_file.h"

#include "scene/json_node.h"
#include "scene/load_visitor.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace scene {
namespace {

constexpr const char* no_energy =
    "the loads have no energy: folds and divergence are found, flutter is not seen by statics";

PathParameter parameter_of(const JsonNode& node) {
  const std::string name = node.string();
  if (name == "load_factor") return PathParameter::load_factor;
  if (name == "turn_rad") return PathParameter::turn_rad;
  if (name == "rest_curvature_factor") return PathParameter::rest_curvature_factor;
  if (name == "value") return PathParameter::value;
  node.refuse("must be load_factor, turn_rad, rest_curvature_factor or value");
}

// Of a load that the scene has.
std::size_t load_of(const JsonNode& node, const Scene& scene) {
  const auto load = static_cast<std::size_t>(node.whole_number());
  if (load >= scene.loads.size())
    node.refuse("the scene has " + std::to_string(scene.loads.size()) + " loads, counted from 0");
  return load;
}

int component_of(const JsonNode& node, const Load& load) {
  const std::string name = node.string();
  const std::vector<std::string> names =
      tendon_of(load) ? std::vector<std::string>{"tension"} : std::vector<std::string>{"x", "y", "z"};
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end())
    node.refuse(std::string("the component of a ") + kind_name(load) + " must be " +
                (names.size() == 1 ? "tension" : "x, y or z"));
  return static_cast<int>(found - names.begin());
}

void read_parameter(const JsonNode& node, PathRequest& request) {
  request.parameter = parameter_of(node.at("parameter"));
  switch (request.parameter) {
    case PathParameter::load_factor:
      node.allow_keys({"parameter", "loads", "from", "to", "stop_at", "branches", "largest_step"});
      if (!node.has("loads")) break;
      for (const JsonNode& load : node.at("loads").items()) request.loads.push_back(load_of(load, request.scene));
      if (request.loads.empty()) node.at("loads").refuse("must name a load");
      break;
    case PathParameter::turn_rad: {
      node.allow_keys({"parameter", "axis", "from", "to", "stop_at", "branches", "largest_step"});
      const JsonNode axis = node.at("axis");
      request.axis_B = axis.vector<3>();
      if (request.axis_B.isZero(0)) axis.refuse("must have a direction");
      request.axis_B.stableNormalize();
      break;
    }
    case PathParameter::rest_curvature_factor:
      node.allow_keys({"parameter", "from", "to", "stop_at", "branches", "largest_step"});
      break;
    case PathParameter::value:
      node.allow_keys({"parameter", "load", "component", "from", "to", "stop_at", "branches", "largest_step"});
      request.loads = {load_of(node.at("load"), request.scene)};
      request.component = component_of(node.at("component"), request.scene.loads[request.loads.front()]);
      break;
  }
}

std::string in_words(const std::optional<bool>& stable) {
  return !stable ? "stability not decided" : *stable ? "stable" : "unstable";
}

std::string tip(const PathPoint& point) {
  const auto shown = [](double value) { return std::abs(value) < 5e-7 ? 0.0 : value; };  // never "-0.000000"
  const Eigen::Vector3d& p = point.tip_position_B_mm;
  return fmt::format("tip at ({:.6f}, {:.6f}, {:.6f}) mm", shown(p[0]), shown(p[1]), shown(p[2]));
}

std::string line_of(const Path& path, std::size_t i, const std::string& parameter) {
  const PathPoint& point = path.points[i];
  const std::string at = fmt::format("at {} {:.9g}", parameter, point.parameter);
  switch (point.kind) {
    case PathPoint::Kind::fold: {
      const bool snaps = i > 0 && path.points[i - 1].stable.value_or(true);
      if (!snaps) return "fold " + at;
      const std::size_t lands = landing(path, i);
      return "fold " + at + ", the rod snaps; " +
             (lands < path.points.size() ? "lands with its " + tip(path.points[lands]) : "lands nowhere on this path");
    }
    case PathPoint::Kind::branch:
      if (point.neutral && !path.points.front().neutral) return "free to turn about its axis " + at;
      return fmt::format("{}branch point {}", point.multiplicity == 2 ? "double " : "", at) +
             (i > 0 && path.points[i - 1].stable.value_or(false) ? ", the rod buckles" : "");
    default: return fmt::format("{} {}, {}, {}", name(point.kind), at, tip(point), in_words(point.stable));
  }
}

}  // namespace

PathRequest read_path(std::istream& input, const std::string& source) {
  const Json json = read_json(input, source);
  const JsonNode root(json, "", source);
  root.allow_keys({"scene", "path"});
  PathRequest request;
  request.scene = scene_of(root.at("scene"));
  const JsonNode node = root.at("path");
  node.require_object();
  read_parameter(node, request);
  request.from = node.at("from").number();
  request.to = node.at("to").number();
  if (node.has("stop_at")) {
    for (const JsonNode& stop : node.at("stop_at").items()) request.stop_at.push_back(stop.number());
  }
  if (node.has("branches")) request.branches = node.at("branches").whole_number();
  if (node.has("largest_step")) request.largest_step = node.at("largest_step").number();
  validate(request, source);
  return request;
}

PathRequest read_path_file(const std::string& path) {
  PathRequest request;
  with_file(path, "path", [&](std::istream& input, const std::string& source) { request = read_path(input, source); });
  return request;
}

std::string name_of_parameter(const PathRequest& request) {
  switch (request.parameter) {
    case PathParameter::load_factor: return "load factor";
    case PathParameter::turn_rad: return "turn, rad";
    case PathParameter::rest_curvature_factor: return "rest curvature factor";
    case PathParameter::value: {
      const std::size_t load = request.loads.front();
      const std::string component =
          tendon_of(request.scene.loads[load]) ? "tension" : std::string(1, "xyz"[request.component]);
      return fmt::format("loads[{}].{}", load, component);
    }
  }
  return "";
}

std::size_t landing(const Path& path, std::size_t fold) {
  const PathPoint& at = path.points[fold];
  std::size_t i = fold + 1;
  const auto lands = [&](const PathPoint& point) {
    return point.branch == at.branch && point.kind != PathPoint::Kind::fold && point.stable.value_or(true) &&
           std::abs(point.parameter - at.parameter) <= 1e-12 * std::abs(at.parameter);
  };
  while (i < path.points.size() && !lands(path.points[i])) ++i;
  return i;
}

std::string to_json(const Path& path) {
  Json json{{"status", name(path.status)}};
  const bool has_energy =
      std::all_of(path.points.begin(), path.points.end(), [](const PathPoint& p) { return p.index; });
  const std::string message = path.message.empty() && !has_energy ? no_energy : path.message;
  if (!message.empty()) json["message"] = message;
  json["points"] = Json::array();
  for (const PathPoint& point : path.points) {
    const Eigen::Vector3d& p = point.tip_position_B_mm;
    Json entry{{"parameter", point.parameter},
               {"tip_position_mm", Json::array({p[0], p[1], p[2]})},
               {"index", point.index ? Json(*point.index) : Json(nullptr)},
               {"stable", point.stable ? Json(*point.stable) : Json(nullptr)},
               {"neutral", point.neutral},
               {"kind", name(point.kind)},
               {"branch", point.branch}};
    if (point.multiplicity > 0) entry["multiplicity"] = point.multiplicity;
    json["points"].push_back(entry);
  }
  return json.dump(2) + "\n";
}

std::string to_csv(const Path& path) {
  std::string csv = "parameter,x_mm,y_mm,z_mm,index,stable,neutral,kind,multiplicity,branch\n";
  for (const PathPoint& point : path.points) {
    const Eigen::Vector3d& p = point.tip_position_B_mm;
    csv +=
        fmt::format("{},{},{},{},{},{},{},{},{},{}\n", point.parameter, p[0], p[1], p[2],
                    point.index ? std::to_string(*point.index) : "",
                    point.stable ? (*point.stable ? "true" : "false") : "", point.neutral ? "true" : "false",
                    name(point.kind), point.multiplicity > 0 ? std::to_string(point.multiplicity) : "", point.branch);
  }
  return csv;
}

std::string to_text(const PathRequest& request, const Path& path) {
  const std::string parameter = name_of_parameter(request);
  std::string text = fmt::format("{}: {} points\n", name(path.status), path.points.size());
  int branch = -1;
  for (std::size_t i = 0; i < path.points.size(); ++i) {
    const PathPoint& point = path.points[i];
    const bool is_stop = point.kind == PathPoint::Kind::regular &&
                         std::count(request.stop_at.begin(), request.stop_at.end(), point.parameter) > 0;
    const bool is_last = i + 1 == path.points.size() || path.points[i + 1].branch != point.branch;
    if (point.kind == PathPoint::Kind::regular && !is_stop && !is_last) continue;
    if (point.branch != branch) text += fmt::format("\n  branch {}\n", branch = point.branch);
    text += "    " + line_of(path, i, parameter) + "\n";
  }
  const bool has_energy =
      std::all_of(path.points.begin(), path.points.end(), [](const PathPoint& p) { return p.index; });
  if (!has_energy) text += fmt::format("\n  {}\n", no_energy);
  return text;
}

}  // namespace scene
