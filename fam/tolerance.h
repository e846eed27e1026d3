// The ladder of resolutions: runs with more and more arcs, until the error that two of them show meets the tolerance.
//
// With a fixed number of arcs N the estimate is the largest distance d between the shapes with N and with 2N arcs (at
// the arcs' ends and middles), times 2^p/(2^p - 1) for the law's order p (published: p = 1, its order in 3D). By
// tolerance: see the constants below. Both: plus the round-off 4 eps L sqrt(N). It estimates the discretisation error
// of the chosen rod model; where the automatic choice leaves out shear and stretch, the bound on what they could do is
// added.
#pragma once

#include "fam/engine.h"

#include "scene/equilibrium.h"
#include "scene/scene.h"

#include <vector>

namespace fam {

// What a solve was asked for and how.
struct Task {
  const scene::Scene& scene;
  std::span<const scene::Span> scene_spans;
  std::span<const scene::Span> spans;  // as they are solved, but for a plane's rotation
  const Options& options;
  const Choice& choice;
  double tolerance_mm;
};

// A march or a boundary value problem, solved.
struct Run {
  Engine solver;
  std::vector<int> arcs;  // of each span
  scene::Status status;

  // From the solution with fewer arcs, or else from no load.
  Run(const Task& task, std::vector<int> arcs_per_span, const Run* fewer_arcs = nullptr);

  int arc_count() const { return fam::arc_count(solver); }
};

// Arcs of each span times a factor.
std::vector<int> times(std::vector<int> arcs, int factor);

// Automatic choice: runs with N and r N arcs that lie d apart; the estimate is coarse_safety d for the first and
// d (fine_safety / (r^(p - 1) - 1) + distrust d / L) for the second: an order less than the law's, which few arcs do
// not show yet. Two or three arcs may agree by chance: the second's is at least unconfirmed d where no third resolution
// was solved, and at least d where d has not fallen below contraction times the distance before it.
constexpr double coarse_safety = 1.5;
constexpr double fine_safety = 4;
constexpr double distrust = 4;
constexpr double unconfirmed = 0.5;
constexpr double contraction = 0.3;
// An answer farther than this times L from the next finer one, or one whose arcs swing farther, does not lead there:
// that one's loads grow from nothing.
constexpr double leading_distance = 0.05;
constexpr double leading_swing_rad = 1.25;
// Runs that fail within this of the same load, relative, fail by the rod and not by their arcs.
constexpr double same_load = 1e-3;

scene::Equilibrium solve_fixed(const Task& task);
scene::Equilibrium solve_to_tolerance(const Task& task);

}  // namespace fam
