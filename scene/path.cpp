#include "scene/path.h"

#include "scene/load_visitor.h"
#include "scene/rule.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

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

// Checks one request; each check names the JSON path of the value it looks at.
class PathChecker {
 public:
  PathChecker(const PathRequest& request, const std::string& source) : r_(request), source_(source) {}

  void check() const {
    check_range();
    check_loads();
    switch (r_.parameter) {
      case PathParameter::load_factor:
        require(!r_.scene.loads.empty(), "parameter", "a load factor needs a load");
        for (std::size_t i = 0; i < r_.scene.loads.size(); ++i) {
          if (r_.loads.empty() || std::count(r_.loads.begin(), r_.loads.end(), i) > 0) check_tension(i);
        }
        break;
      case PathParameter::turn_rad:
        require(r_.axis_B.allFinite() && r_.axis_B.norm() > 0, "axis", r_.axis_B, "must be finite and not zero");
        require(std::any_of(r_.scene.loads.begin(), r_.scene.loads.end(), turns), "parameter",
                "a turn needs a fixed load or gravity");
        break;
      case PathParameter::rest_curvature_factor:
        require(std::any_of(r_.scene.sections.begin(), r_.scene.sections.end(),
                            [](const Section& s) { return !s.rest_curvature_per_mm.isZero(0); }),
                "parameter", "a rest curvature factor needs a section with rest curvature");
        break;
      case PathParameter::value: check_value(); break;
    }
  }

 private:
  template <class Value>
  void require(bool rule_holds, const char* key, const Value& value, const std::string& rule) const {
    scene::require(rule_holds, source_, std::string("path.") + key, value, rule);
  }
  // Of the parameter itself.
  void require(bool rule_holds, const char* key, const std::string& rule) const {
    if (!rule_holds) throw SceneError(source_ + ": path." + key + " = \"" + name(r_.parameter) + "\": " + rule);
  }

  void check_range() const {
    require(std::isfinite(r_.from), "from", r_.from, "must be finite");
    require(std::isfinite(r_.to) && r_.to != r_.from, "to", r_.to, "must be finite and another than from");
    for (const double stop : r_.stop_at) {
      require(std::min(r_.from, r_.to) <= stop && stop <= std::max(r_.from, r_.to), "stop_at", stop,
              "must lie between from and to");
    }
    require(r_.branches >= 0 && r_.branches <= max_path_branches, "branches", double(r_.branches),
            "must lie in 0 to " + std::to_string(max_path_branches));
    if (r_.largest_step)
      require(std::isfinite(*r_.largest_step) && *r_.largest_step > 0, "largest_step", *r_.largest_step, "must be > 0");
  }
  void check_loads() const {
    const double last = static_cast<double>(r_.scene.loads.size()) - 1;
    const char* key = r_.parameter == PathParameter::value ? "load" : "loads";
    for (const std::size_t i : r_.loads) {
      const double index = static_cast<double>(i);
      require(index <= last, key, index, "there is no such load; the first is 0, the last " + text(last));
      require(std::count(r_.loads.begin(), r_.loads.end(), i) == 1, key, index, "must not be there twice");
    }
  }
  void check_tension(std::size_t load) const {
    if (tendon_of(r_.scene.loads[load]) == nullptr) return;
    const bool from_is_less = r_.from < r_.to;
    require(std::min(r_.from, r_.to) >= 0, from_is_less ? "from" : "to", std::min(r_.from, r_.to),
            "must be >= 0: a tendon's tension is");
  }
  void check_value() const {
    require(r_.loads.size() == 1, "parameter", "needs one load");
    const std::size_t load = r_.loads.front();
    const bool tendon = tendon_of(r_.scene.loads[load]) != nullptr;
    require(r_.component >= 0 && r_.component < (tendon ? 1 : 3), "component", double(r_.component),
            tendon ? "a tendon has a tension alone" : "must be x, y or z");
    check_tension(load);
  }
  static bool turns(const Load& load) { return frame_of(load) == Frame::fixed && !is_zero(load); }

  const PathRequest& r_;
  const std::string& source_;
};

}  // namespace

void validate(const PathRequest& request, const std::string& source) {
  validate(request.scene, source, "scene.");
  PathChecker(request, source).check();
}

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
      const Eigen::Matrix3d R = Eigen::AngleAxisd(parameter, request.axis_B.normalized()).toRotationMatrix();
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

const char* name(PathParameter parameter) {
  switch (parameter) {
    case PathParameter::load_factor: return "load_factor";
    case PathParameter::turn_rad: return "turn_rad";
    case PathParameter::rest_curvature_factor: return "rest_curvature_factor";
    case PathParameter::value: return "value";
  }
  return "unknown";
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

std::optional<PathPoint> landing(const Path& path, std::size_t fold) {
  const std::vector<PathPoint>& points = path.points;
  if (fold == 0 || points[fold].kind != PathPoint::Kind::fold || points[fold - 1].stable != true) return std::nullopt;
  const double at = points[fold].parameter;
  for (std::size_t i = fold + 1; i + 1 < points.size(); ++i) {
    const PathPoint &a = points[i], &b = points[i + 1];
    if (b.branch != points[fold].branch) break;
    if ((a.parameter - at) * (b.parameter - at) > 0 || a.parameter == b.parameter) continue;
    if (a.stable != true || b.stable != true) continue;
    PathPoint there = b;
    const double share = (at - a.parameter) / (b.parameter - a.parameter);
    there.parameter = at;
    there.tip_position_B_mm += (1 - share) * (a.tip_position_B_mm - b.tip_position_B_mm);
    return there;
  }
  return std::nullopt;
}

}  // namespace scene
