#include "relations.h"

namespace support {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using scene::Scene;

// Vectors, turns (moments, curvatures) and offsets (y, z) of a scene, each kind by its own rule.
struct Change {
  std::function<Vector3d(const Vector3d&)> vector, turn;
  std::function<Vector2d(const Vector2d&)> offset;
  bool swaps_axes = false;

  void operator()(scene::Force& load) const {
    load.value_N = vector(load.value_N);
    load.offset_mm = offset(load.offset_mm);
  }
  void operator()(scene::Moment& load) const { load.value_Nmm = turn(load.value_Nmm); }
  void operator()(scene::DistributedForce& load) const { load.value_N_per_mm = vector(load.value_N_per_mm); }
  void operator()(scene::Gravity& load) const { load.acceleration_m_per_s2 = vector(load.acceleration_m_per_s2); }
  void operator()(scene::Tendon& load) const { load.offset_mm = offset(load.offset_mm); }

  Scene operator()(Scene scene) const {
    for (scene::Section& section : scene.sections) {
      section.rest_curvature_per_mm = turn(section.rest_curvature_per_mm);
      if (!swaps_axes) continue;
      scene::Stiffness stiffness = stiffness_of(section);
      stiffness.bending_Nmm2.reverseInPlace();
      if (stiffness.shear_N) stiffness.shear_N->reverseInPlace();
      section.cross_section = stiffness;
    }
    for (scene::Load& load : scene.loads) std::visit(*this, load);
    return scene;
  }
};

Vector3d quarter_turn(const Vector3d& v) {
  return {v[0], -v[2], v[1]};
}

Relation turned() {
  const Change change{quarter_turn, quarter_turn, [](const Vector2d& o) { return Vector2d(-o[1], o[0]); }, true};
  return {"turned", change, quarter_turn};
}

Relation mirrored() {
  const auto vector = [](const Vector3d& v) { return Vector3d(v[0], v[1], -v[2]); };
  const auto turn = [](const Vector3d& v) { return Vector3d(-v[0], -v[1], v[2]); };
  return {"mirrored", Change{vector, turn, [](const Vector2d& o) { return Vector2d(o[0], -o[1]); }}, vector};
}

// Lengths by l, forces by f: stiffnesses EI by f l^2, EA by f, moments by f l.
Scene scaled(Scene scene) {
  static constexpr double l = 1000, f = 7;
  for (scene::Section& section : scene.sections) {
    scene::Stiffness k = stiffness_of(section);
    k.bending_Nmm2 *= f * l * l;
    k.torsion_Nmm2 *= f * l * l;
    if (k.axial_N) *k.axial_N *= f;
    if (k.shear_N) *k.shear_N *= f;
    section.cross_section = k;
    section.length_mm *= l;
    section.rest_curvature_per_mm /= l;
  }
  struct {
    void operator()(scene::Force& load) const { load.at_mm *= l, load.value_N *= f, load.offset_mm *= l; }
    void operator()(scene::Moment& load) const { load.at_mm *= l, load.value_Nmm *= f * l; }
    void operator()(scene::DistributedForce& load) const {
      load.from_mm *= l, load.to_mm *= l, load.value_N_per_mm *= f / l;
    }
    void operator()(scene::Gravity& load) const { load.acceleration_m_per_s2 *= f / l; }
    void operator()(scene::Tendon& load) const { load.to_mm *= l, load.offset_mm *= l, load.tension_N *= f; }
  } change;
  for (scene::Load& load : scene.loads) std::visit(change, load);
  return scene;
}

Scene sections_split(const Scene& scene) {
  Scene result = scene;
  result.sections.clear();
  for (scene::Section section : scene.sections) {
    section.length_mm /= 2;
    result.sections.insert(result.sections.end(), 2, section);
  }
  return result;
}

Scene distributed_split(const Scene& scene) {
  Scene result = scene;
  result.loads.clear();
  for (const scene::Load& load : scene.loads) {
    if (const auto* force = std::get_if<scene::DistributedForce>(&load)) {
      scene::DistributedForce proximal = *force, distal = *force;
      proximal.to_mm = distal.from_mm = (2 * force->from_mm + force->to_mm) / 3;
      result.loads.insert(result.loads.end(), {proximal, distal});
    } else {
      result.loads.push_back(load);
    }
  }
  return result;
}

Scene loads_halved(const Scene& scene) {
  struct {
    void operator()(scene::Force& load) const { load.value_N /= 2; }
    void operator()(scene::Moment& load) const { load.value_Nmm /= 2; }
    void operator()(scene::DistributedForce& load) const { load.value_N_per_mm /= 2; }
    void operator()(scene::Gravity& load) const { load.acceleration_m_per_s2 /= 2; }
    void operator()(scene::Tendon& load) const { load.tension_N /= 2; }
  } halve;
  Scene result = scene;
  result.loads.clear();
  for (scene::Load load : scene.loads) {
    std::visit(halve, load);
    result.loads.insert(result.loads.end(), 2, load);
  }
  return result;
}

}  // namespace

const std::vector<Relation>& relations() {
  const auto same = [](const Vector3d& v) { return v; };
  static const std::vector<Relation> all = {
      turned(),
      mirrored(),
      {"scaled", scaled, [](const Vector3d& v) { return Vector3d(1000 * v); }, 1000},
      {"sections split", sections_split, same},
      {"distributed loads split", distributed_split, same},
      {"loads halved and doubled", loads_halved, same}};
  return all;
}

}  // namespace support
