#include "studies/methods/elastica_method.h"

#include "exact_reference/elastica.h"
#include "scene/load_visitor.h"

#include <Eigen/Geometry>

namespace studies {
namespace {

using exact_reference::Elastica;
using exact_reference::PlanarCantilever;

struct PlanarScene {
  PlanarCantilever cantilever;
  bool fixed_force = false;
};

// Adds a load; false where it is none that the elastica knows.
bool add_load(const scene::Load& load, PlanarScene& planar, std::optional<scene::Frame>& frame) {
  const double length = planar.cantilever.length_mm;
  return scene::visit_load(
      load,
      [&](const scene::Force& force) {
        if (force.at_mm != length || force.value_N[2] != 0 || frame.value_or(force.frame) != force.frame) return false;
        frame = force.frame;
        planar.fixed_force = force.frame == scene::Frame::fixed;
        planar.cantilever.tip_force_N += force.value_N.head<2>();
        return true;
      },
      [&](const scene::Moment& moment) {
        if (moment.at_mm != length || !moment.value_Nmm.head<2>().isZero(0)) return false;
        planar.cantilever.tip_moment_Nmm += moment.value_Nmm[2];
        return true;
      },
      [](const scene::DistributedForce&) { return false; },  //
      [](const scene::Gravity&) { return false; },           //
      [](const scene::Tendon&) { return false; });
}

std::optional<PlanarScene> planar_scene(const scene::Scene& scene) {
  if (scene.sections.size() != 1 || !scene.sections[0].rest_curvature_per_mm.isZero(0)) return {};
  PlanarScene planar;
  planar.cantilever.length_mm = scene::length_mm(scene);
  planar.cantilever.bending_stiffness_Nmm2 = scene::stiffness_of(scene.sections[0]).bending_Nmm2[1];
  std::optional<scene::Frame> frame;
  for (const scene::Load& load : scene.loads) {
    if (!add_load(load, planar, frame)) return {};
  }
  return planar;
}

std::optional<Elastica> elastica(const PlanarScene& planar) {
  if (planar.fixed_force) return Elastica::with_fixed_load(planar.cantilever);
  return Elastica::with_follower_load(planar.cantilever);
}

// The tip's load in the base frame is the force all along the rod; its moment grows towards the clamp.
scene::Station station(const Elastica& curve, const PlanarScene& planar, double s_mm) {
  const exact_reference::PlanarPose pose = curve.at(s_mm), tip = curve.tip();
  const Eigen::Rotation2Dd tip_BS(planar.fixed_force ? 0 : tip.angle_rad);
  const Eigen::Vector2d force_B = tip_BS * planar.cantilever.tip_force_N, arm = tip.position_B_mm - pose.position_B_mm;
  const double moment = planar.cantilever.tip_moment_Nmm + arm[0] * force_B[1] - arm[1] * force_B[0];
  const Eigen::Matrix3d rotation = Eigen::AngleAxisd(pose.angle_rad, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  return {
      s_mm, {rotation, {pose.position_B_mm[0], pose.position_B_mm[1], 0}}, {force_B[0], force_B[1], 0}, {0, 0, moment}};
}

class ElasticaMethod : public Method {
 public:
  std::string name() const override { return "closed form"; }
  std::string resolution() const override { return "elliptic functions"; }

  scene::Equilibrium solve(const scene::Scene& scene) const override {
    scene::Equilibrium result;
    const std::optional<PlanarScene> planar = planar_scene(scene);
    if (!planar) {
      result.status = scene::Status::unsupported;
      result.message = "the closed form is for uniform rods loaded in the x-y plane at the tip";
      return result;
    }
    const std::optional<Elastica> curve = elastica(*planar);
    if (!curve) {
      result.message = "the branch from no load could not be followed";
      return result;
    }
    result.status = scene::Status::converged;
    result.stations = {station(*curve, *planar, 0), station(*curve, *planar, planar->cantilever.length_mm)};
    result.tip_angle_rad = curve->tip().angle_rad;
    return result;
  }

  std::function<void()> bare_solve(const scene::Scene& scene) const override {
    const std::optional<PlanarScene> planar = planar_scene(scene);
    if (!planar) return [] {};
    return [planar = *planar, tip = exact_reference::PlanarPose()]() mutable {
      const std::optional<Elastica> curve = elastica(planar);
      if (curve) tip = curve->tip();
    };
  }
};

}  // namespace

std::unique_ptr<Method> elastica_method() {
  return std::make_unique<ElasticaMethod>();
}

}  // namespace studies
