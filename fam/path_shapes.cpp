// Of the solutions of a path: the states and places of their arcs' ends, on other meshes, too, and how accurate they
// are.
#include "fam/load_length.h"
#include "fam/path_equations.h"
#include "fam/rotation.h"
#include "fam/stations.h"

#include <algorithm>

namespace fam {
namespace {

using path_rows::first_row;
using path_rows::row_count;

// Of a tangent: nearer to a fold the parameter says little of where on the path the rod is. Chosen, not measured.
constexpr double least_slope = 0.01;
constexpr double to_blame = 0.1;  // a span, of the error of the worst one; chosen, not measured

// The arc that one of another mesh ends with.
int carried_end(int end_arc, std::span<const int> from, std::span<const int> to) {
  int first = 0, result = 0;
  for (std::size_t i = 0; i < from.size(); ++i) {
    if (end_arc <= first + from[i]) return result + (end_arc - first) * (to[i] / from[i]);
    first += from[i];
    result += to[i];
  }
  return result;
}

// A march of all segments: positions of the arcs' ends, the states at their distal ends, without the point loads there,
// and those that the segments' marches arrive with.
struct Marched {
  std::vector<Vector3d> positions_B_mm;
  std::vector<SectionState<3>> distal, arrived;
};

Marched marched(const LoadedRod<3>& rod, std::span<const ArcRange> segments,
                const std::vector<SectionState<3>>& nodes) {
  const auto arcs = static_cast<std::size_t>(rod.arc_count());
  Marched result{{Vector3d::Zero()}, std::vector<SectionState<3>>(arcs), nodes};
  std::vector<RigidMotion> motions(arcs);
  for (std::size_t k = segments.size(); k-- > 0;) {
    const ArcRange& range = segments[k];
    result.distal[static_cast<std::size_t>(range.end_arc - 1)] = nodes[k];
    rod.march(range, result.arrived[k],
              [&](int arc, const auto&, const RigidMotion& motion, const SectionState<3>& state) {
                motions[static_cast<std::size_t>(arc)] = motion;
                if (arc > range.first_arc) result.distal[static_cast<std::size_t>(arc - 1)] = state;
              });
  }
  SectionPose pose;
  for (const RigidMotion& motion : motions) {
    pose = pose.then(motion);
    result.positions_B_mm.push_back(pose.position_B_mm);
  }
  return result;
}

}  // namespace

PathState PathEquations::carried_over(const PathState& state, const PathMesh& from_mesh) {
  set_parameter(state.parameter);
  std::vector<ArcRange> segments = from_mesh.segments;
  for (ArcRange& segment : segments) {
    segment = {carried_end(segment.first_arc, from_mesh.arcs, mesh_.arcs),
               carried_end(segment.end_arc, from_mesh.arcs, mesh_.arcs)};
  }
  const std::vector<SectionState<3>> ends = marched(rod(), segments, state.nodes).distal;
  PathState result{{}, state.parameter};
  for (const ArcRange& segment : mesh_.segments) {
    result.nodes.push_back(ends[static_cast<std::size_t>(segment.end_arc - 1)]);
  }
  return result;
}

std::vector<SectionState<3>> PathEquations::states(const PathState& state) {
  return marched(rod(), mesh_.segments, state.nodes).distal;
}

std::vector<Vector3d> PathEquations::centreline_mm(const PathState& state, int finer_times) {
  set_parameter(state.parameter);
  std::vector<int> arcs = mesh_.arcs;
  for (int& count : arcs) count *= finer_times;
  std::vector<ArcRange> segments = mesh_.segments;
  for (ArcRange& segment : segments) segment = {finer_times * segment.first_arc, finer_times * segment.end_arc};
  LoadedRod<3> finer;
  finer.set(rod().way(), arcs, rod().law(), rod().model());
  return marched(finer, segments, state.nodes).positions_B_mm;
}

scene::Equilibrium PathEquations::equilibrium(const PathState& state, const scene::Scene& scene) {
  set_parameter(state.parameter);
  const auto count = static_cast<std::size_t>(rod().arc_count());
  std::vector<Arc> arcs(count);
  std::vector<RigidMotion> motions(count);
  std::vector<SectionWrench> distal_wrenches_S(count);
  struct {
    std::vector<Arc>& arcs;
    std::vector<RigidMotion>& motions;
    std::vector<SectionWrench>& wrenches_S;
    void meet(int arc, const SectionState<3>& at) const { wrenches_S[static_cast<std::size_t>(arc)] = at.wrench; }
    void operator()(int arc, const Screw& screw, const RigidMotion& motion, const SectionState<3>&) const {
      arcs[static_cast<std::size_t>(arc)].screw = screw;
      motions[static_cast<std::size_t>(arc)] = motion;
    }
  } keep{arcs, motions, distal_wrenches_S};
  for (std::size_t k = 0; k < segments().size(); ++k) {
    SectionState<3> at = state.nodes[k];
    rod().march(segments()[k], at, keep);
  }
  std::vector<SectionPose> poses{{}};
  for (const RigidMotion& motion : motions) poses.push_back(poses.back().then(motion));
  const SolvedRod<3> solved{rod().span_arcs(), arcs, poses, distal_wrenches_S, rod().law(), rod().model()};
  scene::Equilibrium result;
  result.status = scene::Status::converged;
  set_shape(result, scene, spans_, solved, Matrix3d::Identity());
  result.tip_angle_rad = scene::tip_angle_rad(result.stations, scene::plane_normal(spans_));
  return result;
}

std::vector<Vector3d> PathEquations::positions_mm(const PathState& state) {
  return marched(rod(), mesh_.segments, state.nodes).positions_B_mm;
}

// By the moments at the arcs' ends: those that a screw tells of are too large by what the law adds to the curvature,
// h^2/12 of its third power, times the largest stiffness; strips 1e10 times stiffer on edge took 4096 arcs for 16.
double PathEquations::swing_rad(std::size_t span, std::span<const SectionState<3>> distal) const {
  const double length_mm = spans_[span].length_mm() / mesh_.arcs[span];
  double largest = 0;
  for (const SectionState<3>& end : distal)
    largest = std::max(largest, length_mm * swing_rate_per_mm(spans_[span], end.wrench.moment_Nmm));
  return largest;
}

double PathEquations::apart(const SectionState<3>& a, const SectionState<3>& b) const {
  const Matrix3d turn = a.rotation_SB * b.rotation_SB.transpose();
  return rotation_vector(turn).norm() + (a.wrench.force_N - b.wrench.force_N).norm() / shooting_.force_unit() +
         (a.wrench.moment_Nmm - b.wrench.moment_Nmm).norm() / shooting_.moment_unit();
}

// By marches with twice the arcs through each span alone, from the state that these arcs have at its distal end.
std::vector<bool> PathEquations::coarse_spans(const PathState& state, double allowed_swing_rad) {
  set_parameter(state.parameter);
  fine_.set_load(1);
  const Marched here = marched(rod(), mesh_.segments, state.nodes);
  std::vector<double> errors(spans_.size());
  std::vector<bool> coarse(spans_.size());
  for (std::size_t i = spans_.size(), k = mesh_.segments.size() - 1, end = here.distal.size(); i-- > 0;) {
    const std::size_t first = end - static_cast<std::size_t>(mesh_.arcs[i]);
    coarse[i] = swing_rad(i, std::span(here.distal).subspan(first, end - first)) > allowed_swing_rad;
    while (end > first) {
      const auto first_of_segment = static_cast<std::size_t>(mesh_.segments[k].first_arc);
      const std::size_t start = std::max(first, first_of_segment);
      SectionState<3> arrived = here.distal[end - 1];
      fine_.march({2 * static_cast<int>(start), 2 * static_cast<int>(end)}, arrived);
      errors[i] += apart(arrived, start == first_of_segment ? here.arrived[k] : here.distal[start - 1]);
      if (start == first_of_segment && k > 0) --k;
      end = start;
    }
  }
  const double worst = *std::max_element(errors.begin(), errors.end());
  bool pulls = false;
  for (std::size_t i = 0; i < errors.size(); ++i) {
    coarse[i] = coarse[i] || errors[i] >= to_blame * worst;
    pulls = pulls || (coarse[i] && !spans_[i].tendons.empty());
  }
  // Long arcs do not see in time where a tendon's path shrinks to nothing, though no error tells of it.
  for (std::size_t i = 0; pulls && i < errors.size(); ++i) coarse[i] = coarse[i] || !spans_[i].tendons.empty();
  return coarse;
}

// One Newton step, with the factors at hand, towards the solution with twice the arcs, and on along the path to the
// same parameter; what it does to the positions is told by the arcs as they are.
PathEquations::Accuracy PathEquations::accuracy(const PathState& state, const Change& tangent) {
  std::vector<ArcRange> segments = mesh_.segments;
  for (ArcRange& segment : segments) segment = {2 * segment.first_arc, 2 * segment.end_arc};
  fine_.set_load(1);
  const Marched here = marched(rod(), mesh_.segments, state.nodes), fine = marched(fine_, segments, state.nodes);
  right_ = Eigen::VectorXd::Zero(system_.size());
  for (std::size_t k = 0; k < segments.size(); ++k) {
    const auto equations = shooting_.residual(k, fine.arrived[k]);
    for (int i = 0; i < row_count(k); ++i) right_[row_of(first_row(k) + i)] = -equations.residual[i];
  }
  system_.substitute(right_);
  Change change = projected(without_borders(right_));
  const Eigen::Index p = change.size() - 1;
  change -= change[p] / std::copysign(std::max(std::abs(tangent[p]), least_slope), tangent[p]) * tangent;
  const PathState finer = moved(state, change);
  set_parameter(finer.parameter);
  const std::vector<Vector3d> there = positions_mm(finer);
  set_parameter(state.parameter);
  Accuracy result;
  result.tip_position_B_mm = here.positions_B_mm.back();
  for (std::size_t k = 0; k < there.size(); ++k) {
    const Vector3d of_arcs = fine.positions_B_mm[2 * k] - here.positions_B_mm[k];
    result.error_mm = std::max(result.error_mm, (of_arcs + there[k] - here.positions_B_mm[k]).norm());
  }
  std::size_t first = 0;
  for (std::size_t i = 0; i < spans_.size(); first += static_cast<std::size_t>(mesh_.arcs[i++])) {
    const auto distal = std::span(here.distal).subspan(first, static_cast<std::size_t>(mesh_.arcs[i]));
    result.swing_rad = std::max(result.swing_rad, swing_rad(i, distal));
  }
  return result;
}

}  // namespace fam
