#include "scene/path.h"

#include "scene/load_visitor.h"

#include <Eigen/Geometry>

namespace scene {
namespace {

// Vectors that are constant in the base frame turn; all others stay.
Load turned(const Load& load, const Eigen::Matrix3d& R) {
  Load result = load;
  const auto turn = [&R](Frame frame, Eigen::Vector3d& value) {
    if (frame == Frame::fixed) value = R * value;
  };
  visit_load(
      result, [&](Force& f) { turn(f.frame, f.value_N); }, [&](Moment& m) { turn(m.frame, m.value_Nmm); },
      [&](DistributedForce& f) { turn(f.frame, f.value_N_per_mm); },
      [&](Gravity& g) { turn(Frame::fixed, g.acceleration_m_per_s2); }, [](Tendon&) {});
  return result;
}

}  // namespace

Scene scene_at(const PathRequest& request, double parameter) {
  Scene scene = request.scene;
  switch (request.parameter) {
    case PathParameter::load_factor:
      if (request.loads.empty()) {
        for (Load& load : scene.loads) load = scaled(load, parameter);
      }
      for (const std::size_t i : request.loads) scene.loads[i] = scaled(scene.loads[i], parameter);
      break;
    case PathParameter::turn_rad: {
      const Eigen::Matrix3d R = Eigen::AngleAxisd(parameter, request.axis_B).toRotationMatrix();
      for (Load& load : scene.loads) load = turned(load, R);
      break;
    }
    case PathParameter::rest_curvature_factor:
      for (Section& section : scene.sections) section.rest_curvature_per_mm *= parameter;
      break;
    case PathParameter::value:
      numbers_of(scene.loads[request.loads.front()])[static_cast<std::size_t>(request.component)] = parameter;
      break;
  }
  return scene;
}

bool is_complete(PathStatus status) {
  return status == PathStatus::reached || status == PathStatus::returned || status == PathStatus::closed;
}

const char* name(PathStatus status) {
  switch (status) {
    case PathStatus::reached: return "reached";
    case PathStatus::returned: return "returned";
    case PathStatus::closed: return "closed";
    case PathStatus::not_started: return "not_started";
    case PathStatus::step_too_small: return "step_too_small";
    case PathStatus::work_limit: return "work_limit";
  }
  return "unknown";
}

const char* name(PathPoint::Kind kind) {
  switch (kind) {
    case PathPoint::Kind::start: return "start";
    case PathPoint::Kind::regular: return "regular";
    case PathPoint::Kind::fold: return "fold";
    case PathPoint::Kind::branch: return "branch";
    case PathPoint::Kind::end: return "end";
  }
  return "unknown";
}

}  // namespace scene
