#include "scene/scene_file.h"

#include "scene/json_node.h"
#include "scene/load_visitor.h"
#include "scene/scene_reader.h"

#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>

namespace scene {
namespace {

using Node = JsonNode;
using Eigen::Vector2d;

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

Frame read_frame(const Node& node) {
  return node.one_of({"follower", "fixed"}) == 0 ? Frame::follower : Frame::fixed;
}

double read_place(const Node& node, double length) {
  const Node at = node.at("at");
  if (at.is("tip")) return length;
  return at.number("must be a number or \"tip\"");
}

// A reader for each kind of load.
struct LoadReader {
  const Node& node;
  double length;

  Load operator()(const Force&) const {
    node.allow_keys({"kind", "at", "frame", "value_N", "offset_mm"});
    return Force{read_place(node, length), read_frame(node.at("frame")), node.at("value_N").vector<3>(),
                 node.has("offset_mm") ? node.at("offset_mm").vector<2>() : Vector2d::Zero()};
  }
  Load operator()(const Moment&) const {
    node.allow_keys({"kind", "at", "frame", "value_Nmm"});
    return Moment{read_place(node, length), read_frame(node.at("frame")), node.at("value_Nmm").vector<3>()};
  }
  Load operator()(const DistributedForce&) const {
    node.allow_keys({"kind", "from_mm", "to_mm", "frame", "value_N_per_mm"});
    return DistributedForce{node.number_or("from_mm", 0), node.number_or("to_mm", length), read_frame(node.at("frame")),
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

}  // namespace

Scene read_scene(const JsonNode& node) {
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

std::string read_text(std::istream& input, const std::string& source) {
  std::string text;
  char block[1 << 16];
  while (input.read(block, sizeof block), input.gcount() > 0) {
    text.append(block, static_cast<std::size_t>(input.gcount()));
    if (text.size() > max_scene_file_bytes) {
      refuse(source, "", "(too large)", "a scene file has at most " + std::to_string(max_scene_file_bytes) + " bytes");
    }
  }
  return text;
}

std::string read_text_file(const std::string& path, std::string& source) {
  source = path == "-" ? "(standard input)" : path;
  if (path == "-") return read_text(std::cin, source);
  std::ifstream file(path, std::ios::binary);
  if (!file || std::filesystem::is_directory(path))
    throw SceneError(path + ": (file) = (unreadable): must be a readable scene file");
  return read_text(file, source);
}

namespace {

Scene read_scene(const std::string& text, const std::string& source) {
  const Json json = parse(text, source);
  Scene scene = read_scene(JsonNode(json, "", source));
  validate(scene, source);
  return scene;
}

}  // namespace

Scene read_scene(std::istream& input, const std::string& source) {
  return read_scene(read_text(input, source), source);
}

Scene read_scene_file(const std::string& path) {
  std::string source;
  const std::string text = read_text_file(path, source);
  return read_scene(text, source);
}

}  // namespace scene
