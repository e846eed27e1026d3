#include "studies/sweep/sweep_file.h"

#include "scene/json_node.h"

#include <fmt/format.h>

#include <cctype>
#include <set>

namespace studies {
namespace {

using scene::Json;
using scene::JsonNode;

constexpr std::uint64_t most_points = 100'000'000;
constexpr std::size_t most_variables = 40;  // GSL's Sobol sequence has no more

// The value at a path like rod.sections[0].length_mm; null where there is none.
Json* value_at(Json& json, const std::string& path) {
  Json* at = &json;
  for (std::size_t i = 0; i < path.size();) {
    if (path[i] == '[') {
      std::size_t end = i + 1;
      while (end < path.size() && std::isdigit(static_cast<unsigned char>(path[end]))) ++end;
      if (end == i + 1 || end - i > 8 || end == path.size() || path[end] != ']' || !at->is_array()) return nullptr;
      const std::size_t index = std::stoul(path.substr(i + 1, end - i - 1));
      if (index >= at->size()) return nullptr;
      at = &(*at)[index];
      i = end + 1;
    } else {
      if (i > 0 && path[i] == '.') ++i;
      const std::size_t end = std::min(path.find_first_of(".[", i), path.size());
      const std::string key = path.substr(i, end - i);
      if (!at->is_object() || !at->contains(key)) return nullptr;
      at = &(*at)[key];
      i = end;
    }
  }
  return at;
}

Variable variable_of(const JsonNode& node, Json& scene, Sampling sampling) {
  node.allow_keys({"path", "from", "to", "scale", "mean", "sd", "points"});
  Variable variable;
  variable.path = node.at("path").string();
  const Json* value = value_at(scene, variable.path);
  if (variable.path.empty() || value == nullptr || !value->is_number())
    node.at("path").refuse("must be the path of a number in the scene, like rod.sections[0].length_mm");
  if (node.has("mean") || node.has("sd")) {
    variable.spread = Variable::Spread::normal;
    variable.mean = node.at("mean").number();
    variable.sd = node.at("sd").number();
    if (!(variable.sd > 0)) node.at("sd").refuse("a standard deviation must be > 0");
    for (const char* key : {"from", "to", "scale"}) {
      if (node.has(key)) node.at(key).refuse("a variable has a range or mean and sd, not both");
    }
    if (sampling == Sampling::grid) node.at("mean").refuse("a grid needs ranges: \"from\" and \"to\"");
  } else {
    variable.from = node.at("from").number();
    variable.to = node.at("to").number();
    if (!(variable.to > variable.from)) node.at("to").refuse("must be greater than \"from\"");
    const std::string scale = node.has("scale") ? node.at("scale").string() : "linear";
    if (scale != "linear" && scale != "log") node.at("scale").refuse("must be \"linear\" or \"log\"");
    if (scale == "log") variable.spread = Variable::Spread::logarithmic;
    if (scale == "log" && !(variable.from > 0)) node.at("from").refuse("must be > 0 on a logarithmic scale");
  }
  if (sampling == Sampling::grid) {
    variable.points = node.at("points").whole_number();
    if (variable.points < 2) node.at("points").refuse("must be a whole number >= 2");
  } else if (node.has("points")) {
    node.at("points").refuse("only a grid has points of each variable; others have \"points\" beside \"vary\"");
  }
  return variable;
}

Sampling sampling_of(const JsonNode& node) {
  const std::string name = node.has("sample") ? node.at("sample").string() : "grid";
  if (name == "grid") return Sampling::grid;
  if (name == "latin_hypercube") return Sampling::latin_hypercube;
  if (name == "sobol") return Sampling::sobol;
  node.at("sample").refuse("must be \"grid\", \"latin_hypercube\" or \"sobol\"");
}

void set_points(Sweep& sweep, const JsonNode& node) {
  const bool grid = sweep.sampling == Sampling::grid;
  if (!grid) {
    sweep.points = static_cast<std::uint64_t>(node.at("points").whole_number());
    if (sweep.points < 1 || sweep.points > most_points) node.at("points").refuse("must be 1 ... 1e8");
  } else {
    if (node.has("points")) node.at("points").refuse("a grid has points of each variable");
    sweep.points = 1;
    for (const Variable& variable : sweep.variables) {
      sweep.points *= static_cast<std::uint64_t>(variable.points);
      if (sweep.points > most_points) node.at("vary").refuse("the grid must have at most 1e8 points");
    }
  }
  if (node.has("seed")) {
    if (sweep.sampling != Sampling::latin_hypercube) node.at("seed").refuse("only a Latin hypercube has a seed");
    sweep.seed = static_cast<std::uint64_t>(node.at("seed").whole_number());
  }
}

// Each range's ends, one at a time, must make a scene.
void check_ends(const Sweep& sweep) {
  std::vector<double> values;
  Json scene = sweep.scene;
  for (const Variable& variable : sweep.variables) values.push_back(value_at(scene, variable.path)->get<double>());
  for (std::size_t i = 0; i < sweep.variables.size(); ++i) {
    const Variable& variable = sweep.variables[i];
    const bool normal = variable.spread == Variable::Spread::normal;
    for (const double end : {normal ? variable.mean : variable.from, normal ? variable.mean : variable.to}) {
      std::vector<double> changed = values;
      changed[i] = end;
      try {
        sweep.scene_with(changed.data());
      } catch (const scene::SceneError& error) {
        scene::refuse(sweep.source, fmt::format("vary[{}]", i), fmt::format("{:g}", end),
                      std::string("makes no valid scene: ") + error.what());
      }
    }
  }
}

}  // namespace

scene::Scene Sweep::scene_with(const double* values) const {
  Json changed = scene;
  for (std::size_t i = 0; i < variables.size(); ++i) *value_at(changed, variables[i].path) = values[i];
  scene::Scene result = scene::scene_of(JsonNode(changed, "scene", source));
  scene::validate(result, source, "scene");
  return result;
}

Sweep read_sweep(std::istream& input, const std::string& source) {
  const Json json = scene::read_json(input, source);
  const JsonNode node(json, "", source);
  node.allow_keys({"scene", "vary", "sample", "points", "seed"});
  Sweep sweep;
  sweep.source = source;
  node.at("scene").require_object();
  sweep.scene = json.at("scene");
  scene::validate(scene::scene_of(node.at("scene")), source, "scene");
  sweep.sampling = sampling_of(node);
  std::set<std::string> paths;
  for (const JsonNode& item : node.at("vary").items()) {
    item.require_object();
    sweep.variables.push_back(variable_of(item, sweep.scene, sweep.sampling));
    if (!paths.insert(sweep.variables.back().path).second) item.at("path").refuse("the path is given twice");
  }
  if (sweep.variables.empty() || sweep.variables.size() > most_variables)
    node.at("vary").refuse("must be an array of 1 to 40 variables");
  set_points(sweep, node);
  check_ends(sweep);
  return sweep;
}

Sweep read_sweep_file(const std::string& path) {
  Sweep sweep;
  scene::with_file(path, "sweep",
                   [&](std::istream& input, const std::string& source) { sweep = read_sweep(input, source); });
  return sweep;
}

}  // namespace studies
