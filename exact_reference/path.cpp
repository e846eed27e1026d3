#include "exact_reference/path.h"

#include "exact_reference/boundary_value.h"
#include "exact_reference/path_walk.h"
#include "scene/subnormals_as_zero.h"

#include <algorithm>
#include <cmath>
#include <deque>

namespace exact_reference {
namespace {

using Eigen::VectorXd;

// What is asked for, as rods.
class RequestedRods {
 public:
  RequestedRods(const scene::PathRequest& request, const Options& options) : request_(request), model_(options.model) {
    const scene::Scene first = scene::scene_at(request, request.from);
    const scene::Scene* scenes[] = {&first};
    cutter_.cut(scenes);
    // Loads may vanish at one value: that of the ends and of one that is no one's half.
    for (const double share : {0.0, 0.4137, 1.0}) {
      has_energy &= at(std::lerp(request.from, request.to, share)).has_energy();
    }
  }

  ScaledRod at(double parameter) const { return scaled_rod(scene::scene_at(request_, parameter), cutter_, model_); }

  bool has_energy = true;

 private:
  const scene::PathRequest& request_;
  scene::SpanCutter cutter_;
  RodModel model_;
};

class Follower {
 public:
  Follower(const scene::PathRequest& request, const Options& options, const PathVisitor& visit)
      : route_{request.from, request.to, request.stop_at,
               request.largest_step.value_or(std::abs(request.to - request.from) / 20),
               request.parameter == scene::PathParameter::turn_rad},
        branches_(request.branches),
        tolerance_(options.tolerance),
        rods_(request, options),
        visit_(visit) {}

  scene::Path follow() {
    const ScaledRod rod = rods_.at(route_.from);
    MeshedStates first;
    const scene::Equilibrium start = solve_boundary_value({&rod, 1}, tolerance_, &first);
    if (!start.converged()) {
      result_.message = "at the start: " + start.message;
      return result_;
    }
    Continuation path = continuation(first.mesh);
    if (!path.start(first.y, route_.from, route_.to > route_.from ? 1 : -1)) {
      result_.message = "the equilibrium at the start cannot be continued";
      return result_;
    }
    PathWalk walk(route_, path, 0, result_, visit_);
    walk.from_start();
    finish(walk, 0);
    for (int branch = 1; branch <= branches_ && !waiting_.empty(); ++branch) leave(branch);
    return result_;
  }

 private:
  Continuation continuation(const Mesh& mesh) const {
    const auto set = [this](ScaledRod& rod, double parameter) {
      rod = rods_.at(parameter);
      return 1.0;
    };
    return {rods_.at(route_.from), set, route_.scale(), tolerance_, mesh, rods_.has_energy};
  }

  bool is_known(const CriticalPoint& point) const {
    return std::any_of(known_.begin(), known_.end(),
                       [&](const Mark& mark) { return same_equilibrium(mark, mark_of(point.x), route_.scale()); });
  }

  void finish(const PathWalk& walk, int branch) {
    if (branch == 0 || (scene::is_complete(result_.status) && !scene::is_complete(walk.status()))) {
      result_.status = walk.status();
      result_.message = walk.message();
      if (branch > 0) result_.message = "branch " + std::to_string(branch) + ": " + result_.message;
    }
    for (const Parting& parting : walk.partings()) {
      // One that this branch arrives at need not be left: this is its branch.
      std::erase_if(waiting_, [&](const Parting& other) {
        return same_equilibrium(mark_of(other.point.x), mark_of(parting.point.x), route_.scale());
      });
      if (is_known(parting.point)) continue;
      known_.push_back(mark_of(parting.point.x));
      waiting_.push_back(parting);
    }
  }

  void leave(int branch) {
    const Parting parting = waiting_.front();
    waiting_.pop_front();
    Continuation path = continuation(parting.mesh);
    const CriticalPoint& point = parting.point;
    VectorXd direction = point.null_vectors.col(0), free_turn;
    path.start_branch(point.x, direction, nullptr);
    Eigen::Vector3d motion = tip_motion(path, point.x, direction);
    if (point.multiplicity == 2) {
      const VectorXd other = point.null_vectors.col(1);
      const Eigen::Vector3d other_motion = tip_motion(path, point.x, other);
      free_turn = motion[1] * other - other_motion[1] * direction;
      direction = other_motion[2] * direction - motion[2] * other;
      motion = tip_motion(path, point.x, direction);
    }
    constexpr double no_motion = 1e-6;
    double towards = std::abs(motion[1]) > no_motion * motion.norm() ? motion[1] : motion[2];
    const double turn = direction[direction.size() - core_size];  // of the tip about x
    if (motion.norm() < no_motion * std::abs(turn)) towards = turn;
    if (towards < 0) direction = -direction;
    path.start_branch(point.x, direction, free_turn.size() > 0 ? &free_turn : nullptr);
    PathWalk walk(route_, path, branch, result_, visit_);
    walk.from_parting(parting);
    finish(walk, branch);
  }

  const Route route_;
  const int branches_;
  const double tolerance_;
  const RequestedRods rods_;
  const PathVisitor& visit_;
  scene::Path result_;
  std::deque<Parting> waiting_;
  std::vector<Mark> known_;
};

}  // namespace

scene::Path follow(const scene::PathRequest& request, const Options& options, const PathVisitor& visit) {
  check(options);
  scene::validate(request);
  const scene::SubnormalsAsZero fast;
  return Follower(request, options, visit).follow();
}

}  // namespace exact_reference
