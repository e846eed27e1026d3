#include "fem_reference/path.h"

#include "fem_reference/path_tracer.h"
#include "scene/subnormals_as_zero.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <deque>
#include <utility>

namespace fem_reference {

namespace {

using scene::PathPoint;
using scene::PathStatus;
using Kind = PathPoint::Kind;

// Two states are the same if they lie closer than this, in rod lengths and rad; a located point's error is far less.
constexpr double same_state = 1e-4;

double distance(const PathState& a, const PathState& b) {
  const BeamIncrement apart = difference(a.state, b.state);
  return std::sqrt(product(apart, apart));
}

bool is_same(const PathState& a, const PathState& b, double reach) {
  return std::abs(a.parameter - b.parameter) <= 1e-6 * reach && distance(a, b) <= same_state;
}

class Follower {
 public:
  Follower(const scene::PathRequest& request, const Options& options, const OnPathPoint& on_point)
      : request_(request),
        options_(options),
        on_point_(on_point),
        system_(parametric_model(request, options), stepping_options(options)),
        largest_step_(request.largest_step.value_or(system_.parametric().reach() / 25)) {
    targets_ = request.stop_at;
    targets_.push_back(request.to);
    targets_.push_back(request.from);
  }

  scene::Path run();

 private:
  struct BranchPoint {
    PathState state;
    int multiplicity = 1;
  };

  std::optional<PathState> start();
  std::optional<PathState> leave(const BranchPoint& from);
  void follow(PathState first, const PathState& origin, double first_step);
  void keep(const BranchPoint& point);
  std::optional<PathStatus> end_at(const Landmark& landmark, const PathState& origin) const;
  void emit(const Landmark& landmark, Kind kind);
  void end(PathStatus status, const std::string& message);

  const scene::PathRequest& request_;
  const Options& options_;
  const OnPathPoint& on_point_;
  PathSystem system_;
  double largest_step_;
  std::vector<double> targets_;
  std::vector<BranchPoint> known_;
  std::deque<BranchPoint> to_leave_;
  int branch_ = 0;
  bool ended_ = false;
  scene::Path path_;
};

std::optional<PathState> Follower::start() {
  const SteppingResult found = step_to_full_load(system_.parametric().at(request_.from), stepping_options(options_));
  if (found.status != scene::Status::converged) {
    path_.message = found.message;
    return {};
  }
  const Direction along = system_.along_parameter(request_.to < request_.from ? -1 : 1);
  const auto first = system_.at(found.state, request_.from, along);
  if (!first) path_.message = system_.failure();
  return first;
}

void Follower::emit(const Landmark& landmark, Kind kind) {
  const PathState& at = landmark.state;
  const double unit_mm = system_.model().length_unit_mm;
  PathPoint point;
  point.parameter = at.parameter;
  point.tip_position_B_mm = unit_mm * at.state.position_B.back();
  point.index = at.index;
  if (at.index) point.stable = *at.index == 0;
  point.neutral = at.neutral;
  point.kind = kind;
  point.multiplicity = landmark.multiplicity;
  point.branch = branch_;
  path_.points.push_back(point);
  if (!on_point_) return;
  const std::vector<scene::Span> spans = scene::spans_of(scene::scene_at(request_, at.parameter));
  on_point_(point,
            {spans, scene::cells_per_span(spans, options_.elements), system_.parametric().at(at.parameter), at.state});
}

void Follower::end(PathStatus status, const std::string& message) {
  const bool is_first = branch_ == 0;
  if (!is_first && (!is_complete(path_.status) || is_complete(status))) return;
  path_.status = status;
  path_.message = is_first || message.empty() ? message : "branch " + std::to_string(branch_) + ": " + message;
}

std::optional<PathStatus> Follower::end_at(const Landmark& landmark, const PathState& origin) const {
  const bool special = landmark.kind != Kind::regular;
  if ((special || landmark.target) && is_same(landmark.state, origin, system_.parametric().reach())) {
    return PathStatus::closed;
  }
  if (landmark.target == request_.to) return PathStatus::reached;
  if (landmark.target == request_.from) return PathStatus::returned;
  return {};
}

void Follower::keep(const BranchPoint& point) {
  const double reach = system_.parametric().reach();
  for (const BranchPoint& other : known_) {
    if (is_same(point.state, other.state, reach)) return;
  }
  known_.push_back(point);
  to_leave_.push_back(point);
}

void Follower::follow(PathState first, const PathState& origin, double first_step) {
  PathTracer tracer(system_, std::move(first), first_step, largest_step_);
  while (true) {
    if (path_.points.size() >= static_cast<std::size_t>(options_.max_load_steps)) {
      return end(PathStatus::work_limit, std::to_string(path_.points.size()) + " points found");
    }
    const auto landmarks = tracer.next(targets_);
    if (!landmarks) {
      char text[80];
      std::snprintf(text, sizeof text, "parameter %.6g reached; no further step: ", tracer.last().parameter);
      return end(PathStatus::step_too_small, text + tracer.failure());
    }
    for (const Landmark& landmark : *landmarks) {
      const auto status = end_at(landmark, origin);
      emit(landmark, status ? Kind::end : landmark.kind);
      if (status) return end(*status, "");
      if (landmark.kind == Kind::branch) keep({landmark.state, landmark.multiplicity});
    }
  }
}

// Into +y at the tip.
double sign_of(const BeamIncrement& mode) {
  const Eigen::Vector3d& tip = mode.displacement_B.back();
  const double size = std::sqrt(product(mode, mode));
  for (const double part : {tip.y(), tip.z(), mode.rotation_S.back().x(), tip.x()}) {
    if (std::abs(part) > 1e-6 * size) return part < 0 ? -1 : 1;
  }
  return 1;
}

// A point on the other branch, a little away from the branch point.
std::optional<PathState> Follower::leave(const BranchPoint& from) {
  auto direction = system_.off_the_path(from.state, from.multiplicity > 1);
  if (!direction) return {};
  scale(*direction, sign_of(direction->motion));
  for (const double step : {0.03, 0.01, 0.1, 3e-3, 1e-3, 3e-4}) {  // chosen, not measured
    auto found = system_.step(from.state, *direction, step);
    if (found && distance(from.state, *found) < 3 * step &&
        std::abs(found->parameter - from.state.parameter) <= largest_step_) {
      return found;
    }
  }
  return {};
}

scene::Path Follower::run() {
  auto first = start();
  if (!first) return path_;
  emit({*first, Kind::start, 0, {}}, Kind::start);
  follow(*first, *first, 0.01);
  while (branch_ < request_.branches && !to_leave_.empty()) {
    const BranchPoint from = to_leave_.front();
    to_leave_.pop_front();
    ++branch_;
    emit({from.state, Kind::start, from.multiplicity, {}}, Kind::start);
    auto beside = leave(from);
    if (!beside) {
      end(PathStatus::step_too_small, std::string("it was not left: ") + system_.failure());
      continue;
    }
    emit({*beside, Kind::regular, 0, {}}, Kind::regular);
    follow(*beside, from.state, 0.03);
  }
  return path_;
}

}  // namespace

scene::Path follow(const scene::PathRequest& request, const Options& options, const OnPathPoint& on_point) {
  validate(options);
  const scene::SubnormalsAsZero fast;
  return Follower(request, options, on_point).run();
}

}  // namespace fem_reference
