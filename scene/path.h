// An equilibrium path: the equilibria of a scene while one number of it, the parameter, changes; through turning
// points. What is asked for and what every method that follows paths returns; no mechanics.
#pragma once

#include "scene/scene.h"

#include <optional>
#include <string>
#include <vector>

namespace scene {

enum class PathParameter {
  load_factor,            // multiplies the loads named, all where none is
  turn_rad,               // turns the fixed loads and gravity about an axis through the clamp
  rest_curvature_factor,  // multiplies the rest curvatures of all sections
  value                   // is a number of one load itself
};
const char* name(PathParameter parameter);

constexpr int max_path_branches = 1000;

struct PathRequest {
  Scene scene;
  PathParameter parameter = PathParameter::load_factor;
  std::vector<std::size_t> loads;                     // load_factor: of which loads; value: the one
  Eigen::Vector3d axis_B = Eigen::Vector3d::UnitX();  // of turn_rad, a unit vector
  int component = 0;                                  // of value: 0 to 2, x, y, z; of a tendon 0, its tension
  double from = 0, to = 1;
  std::vector<double> stop_at;         // a point is placed exactly at each of these
  int branches = 0;                    // how many branch points to leave on their other branches
  std::optional<double> largest_step;  // between points, of the parameter
};

// Throws SceneError at the first rule that the request breaks; `source` names it in the message, usually its file. The
// JSON paths are those of a path file: the scene's values under "scene", the others under "path".
void validate(const PathRequest& request, const std::string& source = "path");

// The scene at a value of the parameter.
Scene scene_at(const PathRequest& request, double parameter);

struct PathPoint {
  enum class Kind { start, regular, fold, branch, end };
  double parameter = 0;
  Eigen::Vector3d tip_position_B_mm = Eigen::Vector3d::Zero();
  std::optional<int> index;  // number of unstable directions; empty where the loads have no energy
  // index = 0; empty where the loads have no energy. A turn that costs no energy (`neutral`) is not unstable.
  std::optional<bool> stable;
  bool neutral = false;
  Kind kind = Kind::regular;
  int multiplicity = 0;  // of a fold or a branch point: 1 or 2
  int branch = 0;        // 0: the one that starts at `from`; the others in the order in which they are left for
};

enum class PathStatus {
  reached,         // the first arrival at `to`
  returned,        // back at `from`
  closed,          // back at the first point, from behind
  not_started,     // no equilibrium at `from`
  step_too_small,  // steps along the path fell below the method's smallest
  work_limit       // the method's bound on points or steps was used up
};

// The first three: the path ended as it should.
bool is_complete(PathStatus status);
// As the JSON output spells them.
const char* name(PathStatus status);
const char* name(PathPoint::Kind kind);

struct Path {
  PathStatus status = PathStatus::not_started;
  std::string message;  // one line, where and why it ended early; empty when complete
  std::vector<PathPoint> points;
};

// Where a rod that leaves a stable branch at a fold is next in stable equilibrium on the path, at the fold's parameter
// (between two points, by a straight line). Statics does not say that it lands there. Empty: none, or no fold that a
// stable rod meets.
std::optional<PathPoint> landing(const Path& path, std::size_t fold);

}  // namespace scene
