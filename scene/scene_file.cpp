#include "scene/scene_file.h"

#include "scene/json_file.h"
#include "scene/load_visitor.h"

#include <filesystem>
#include <fstream>
#include <initializer_list>
#include <iostream>
#include <iterator>

namespace scene {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

// A JSON value with its path, read key by key.
class Node {
 public:
  Node(const Json& json, std::string path, const std::string& source)
      : json_(json), path_(std::move(path)), source_(source) {}

  [[noreturn]] void refuse(const std::string& rule) const { scene::refuse(source_, path_, dump(json_), rule); }

  void require_object() const {
    if (!json_.is_object()) refuse("must be an object");
  }

  // Refuses anything but an object with these keys.
  void allow_keys(std::initializer_list<const char*> keys) const {
    require_object();
    for (const auto& [key, value] : json_.items()) {
      bool known = false;
      std::string all;
      for (const char* allowed : keys) {
        known |= key == allowed;
        all += (all.empty() ? "" : ", ") + std::string(allowed);
      }
      if (!known) scene::refuse(source_, join(path_, key), dump(value), "unknown key; known here: " + all);
    }
  }

  bool has(const char* key) const { return json_.contains(key); }

  Node at(const char* key) const {
    if (!has(key)) scene::refuse(source_, join(path_, key), "(missing)", "the key is required");
    return {json_.at(key), join(path_, key), source_};
  }

  std::vector<Node> items() const {
    if (!json_.is_array()) refuse("must be an array");
    std::vector<Node> nodes;
    for (std::size_t i = 0; i < json_.size(); ++i) {
      nodes.emplace_back(json_[i], path_ + "[" + std::to_string(i) + "]", source_);
    }
    return nodes;
  }

  double number(const std::string& rule = "must be a number") const {
    if (!json_.is_number()) refuse(rule);
    return json_.get<double>();
  }

  double number_or(const char* key, double otherwise) const { return has(key) ? at(key).number() : otherwise; }

  std::string string() const {
    if (!json_.is_string()) refuse("must be a string");
    return json_.get<std::string>();
  }

  template <int Size>
  Eigen::Matrix<double, Size, 1> vector() const {
    if (!json_.is_array() || json_.size() != Size) refuse("must be an array of " + std::to_string(Size) + " numbers");
    Eigen::Matrix<double, Size, 1> values;
    for (int i = 0; i < Size; ++i) values[i] = items()[static_cast<std::size_t>(i)].number();
    return values;
  }

  // A number for both axes, or [y, z].
  Vector2d number_or_pair() const {
    if (json_.is_number()) return Vector2d::Constant(number());
    if (!json_.is_array()) refuse("must be a number or an array of 2 numbers");
    return vector<2>();
  }

  bool is_tip() const { return json_ == "tip"; }

  Frame frame() const {
    if (json_ == "follower") return Frame::follower;
    if (json_ == "fixed") return Frame::fixed;
    refuse("must be \"follower\" or \"fixed\"");
  }

 private:
  const Json& json_;
  std::string path_;
  const std::string& source_;
};

Stiffness read_stiffness(const Node& node) {
  node.allow_keys({"bending_Nmm2", "torsion_Nmm2", "axial_N", "shear_N", "mass_per_length_kg_per_m"});
  Stiffness stiffness;
  stiffness.bending_Nmm2 = node.at("bending_Nmm2").number_or_pair();
  stiffness.torsion_Nmm2 = node.at("torsion_Nmm2").number();
  if (node.has("axial_N")) stiffness.axial_N = node.at("axial_N").number();
  if (node.has("shear_N")) stiffness.shear_N = node.at("shear_N").number_or_pair();
  stiffness.mass_per_length_kg_per_m = node.number_or("mass_per_length_kg_per_m", 0);
  return stiffness;
}

CircularSection read_circle(const Node& geometry, const Node& material) {
  geometry.allow_keys({"outer_diameter_mm", "inner_diameter_mm"});
  material.allow_keys({"youngs_modulus_MPa", "poissons_ratio", "density_kg_per_m3"});
  return {.outer_diameter_mm = geometry.at("outer_diameter_mm").number(),
          .inner_diameter_mm = geometry.number_or("inner_diameter_mm", 0),
          .youngs_modulus_MPa = material.at("youngs_modulus_MPa").number(),
          .poissons_ratio = material.at("poissons_ratio").number(),
          .density_kg_per_m3 = material.number_or("density_kg_per_m3", 0)};
}

Section read_section(const Node& node) {
  node.allow_keys({"length_mm", "stiffness", "geometry", "material", "rest_curvature_per_mm"});
  Section section;
  section.length_mm = node.at("length_mm").number();
  if (node.has("rest_curvature_per_mm")) section.rest_curvature_per_mm = node.at("rest_curvature_per_mm").vector<3>();
  const bool circular = node.has("geometry") || node.has("material");
  if (circular == node.has("stiffness")) node.refuse("must have either stiffness, or geometry and material");
  if (circular) section.cross_section = read_circle(node.at("geometry"), node.at("material"));
  else section.cross_section = read_stiffness(node.at("stiffness"));
  return section;
}

double read_place(const Node& node, double length) {
  const Node at = node.at("at");
  if (at.is_tip()) return length;
  return at.number("must be a number or \"tip\"");
}

// A reader for each kind of load.
struct LoadReader {
  const Node& node;
  double length;

  Load operator()(const Force&) const {
    node.allow_keys({"kind", "at", "frame", "value_N", "offset_mm"});
    return Force{read_place(node, length), node.at("frame").frame(), node.at("value_N").vector<3>(),
                 node.has("offset_mm") ? node.at("offset_mm").vector<2>() : Vector2d::Zero()};
  }
  Load operator()(const Moment&) const {
    node.allow_keys({"kind", "at", "frame", "value_Nmm"});
    return Moment{read_place(node, length), node.at("frame").frame(), node.at("value_Nmm").vector<3>()};
  }
  Load operator()(const DistributedForce&) const {
    node.allow_keys({"kind", "from_mm", "to_mm", "frame", "value_N_per_mm"});
    return DistributedForce{node.number_or("from_mm", 0), node.number_or("to_mm", length), node.at("frame").frame(),
                            node.at("value_N_per_mm").vector<3>()};
  }
  Load operator()(const Gravity&) const {
    node.allow_keys({"kind", "acceleration_m_per_s2"});
    return Gravity{node.at("acceleration_m_per_s2").vector<3>()};
  }
  Load operator()(const Tendon&) const {
    node.allow_keys({"kind", "offset_mm", "tension_N", "to_mm"});
    return Tendon{node.at("offset_mm").vector<2>(), node.at("tension_N").number(), node.number_or("to_mm", length)};
  }
};

// One load of each kind.
template <class... Kinds>
std::vector<Load> all_kinds(const std::variant<Kinds...>&) {
  return {Kinds{}...};
}

Load read_load(const Node& node, double length) {
  node.require_object();
  const Node kind_node = node.at("kind");
  const std::string kind = kind_node.string();
  static const std::vector<Load> kinds = all_kinds(Load{});
  std::string names;
  for (std::size_t i = 0; i < kinds.size(); ++i) {
    if (kind == kind_name(kinds[i])) return std::visit(LoadReader{node, length}, kinds[i]);
    names += (i == 0 ? "" : i + 1 < kinds.size() ? ", " : " or ") + std::string(kind_name(kinds[i]));
  }
  kind_node.refuse("must be " + names);
}

Scene read(const Node& node) {
  node.allow_keys({"title", "rod", "loads"});
  Scene scene;
  if (node.has("title")) scene.title = node.at("title").string();
  const Node rod = node.at("rod");
  rod.allow_keys({"sections"});
  for (const Node& section : rod.at("sections").items()) scene.sections.push_back(read_section(section));
  if (node.has("loads")) {
    const double length = length_mm(scene);
    for (const Node& load : node.at("loads").items()) scene.loads.push_back(read_load(load, length));
  }
  return scene;
}

}  // namespace

Scene read_scene(std::istream& input, const std::string& source) {
  std::string text;
  char block[1 << 16];
  while (input.read(block, sizeof block), input.gcount() > 0) {
    text.append(block, static_cast<std::size_t>(input.gcount()));
    if (text.size() > max_scene_file_bytes) {
      refuse(source, "", "(too large)", "a scene file has at most " + std::to_string(max_scene_file_bytes) + " bytes");
    }
  }
  const Json json = parse(text, source);
  Scene scene = read(Node(json, "", source));
  validate(scene, source);
  return scene;
}

Scene read_scene_file(const std::string& path) {
  if (path == "-") return read_scene(std::cin, "(standard input)");
  std::ifstream file(path, std::ios::binary);
  if (!file || std::filesystem::is_directory(path))
    throw SceneError(path + ": (file) = (unreadable): must be a readable scene file");
  return read_scene(file, path);
}

}  // namespace scene
