// Entry point of the finite arc method: a scene and options in, an equilibrium out.
#pragma once

#include "fam/boundary_value.h"
#include "fam/march.h"

#include "scene/equilibrium.h"
#include "scene/scene.h"

#include <optional>
#include <string>
#include <variant>

namespace fam {

constexpr int max_arcs = 1'000'000;

struct Options {
  Law law = Law::automatic;                         // automatic: sixth_order
  RodModel model = RodModel::automatic;             // automatic: Kirchhoff unless the scene stretches or shears visibly
  TwistOrder twist_order = TwistOrder::bend_twist;  // of the published law

  // Number of arcs, 1..max_arcs; 0: as many as the tolerance asks for. Each span between section changes and loads
  // gets at least one, whatever is asked for.
  int arcs = 0;
  // Largest error wanted of any place along the rod, mm; 0: 1e-3 of its length. Used only where arcs = 0.
  double tolerance_mm = 0;

  // With a fixed number of arcs the error estimate takes a second march of twice as many; false leaves it out (0).
  bool estimate_error = true;
};

const char* name(Law law);

// Solves a valid scene (scene::validate). Numerical trouble is a status, never an exception:
//   unsupported        published law with a fixed or distributed load, with shear or EI_y != EI_z
//   load_step_too_small, work_limit, not_converged   see fam/boundary_value.h
//   arc_not_converged  published law: see fam/arc_law.h; sixth_order with fixed arcs: an arc that grows by more than
//                      resolved_growth or reaches farther than resolved_reach_rad
//   tolerance_not_met  estimated error > tolerance with max_arcs arcs
//   tendon_collapsed   |v + u x r| <= smallest_tendon_stretch somewhere (fam/tendon.h)
//   not_finite         overflow
//
// The automatic choice, each part reported in words (model: reason):
//   plane or space   the planar kernels where all lies in one plane (model_choice.h); but for the published law
//   shear            model_choice.h
//   law              sixth_order: an arc costs what one of fourth_order does, and fewer are needed
//   arcs             multiples of first_arcs(), the smallest found whose estimated error meets the tolerance
//   solver           the march where all loads follow, else the boundary value problem
//
// Error estimate, with a fixed number of arcs N: the largest distance d between the shapes with N and with 2N arcs (at
// the arcs' ends and middles),
// times 2^p/(2^p - 1) for the law's order p (published: p = 1, its order in 3D). By tolerance: see the constants below.
// Both: plus the round-off 4 eps L sqrt(N). It estimates the discretisation error of the chosen rod model; where the
// automatic choice leaves out shear and stretch, the bound on what they could do is added.
scene::Equilibrium solve(const scene::Scene& scene, const Options& options = {});

// Automatic choice: runs with N and r N arcs that lie d apart; the estimate is coarse_safety d for the first and
// d (fine_safety / (r^(p - 1) - 1) + distrust d / L) for the second: an order less than the law's, which few arcs do
// not show yet. Two or three arcs may agree by chance: the second's is at least unconfirmed d where no third resolution
// was solved, and at least d where d has not fallen below contraction times the distance before it.
constexpr double coarse_safety = 1.5;
constexpr double fine_safety = 4;
constexpr double distrust = 4;
constexpr double unconfirmed = 0.5;
constexpr double contraction = 0.3;
// An answer farther than this times L from the next finer one, or one whose arcs reach farther, does not lead there:
// that one's loads grow from nothing.
constexpr double leading_distance = 0.05;
constexpr double leading_reach_rad = 1.25;
// Arcs longer than this do not see the load's length or the rod's turns, and two resolutions may agree by chance: the
// estimate is then at least L, and the series of sixth_order have no answer at all.
constexpr double resolved_growth = 2.5;     // sqrt(force / EI) h
constexpr double resolved_reach_rad = 2.5;  // an arc's turn, or what its moment grows or swings by; 0 if that is steady

// Runs that fail within this of the same load, relative, fail by the rod and not by their arcs.
constexpr double same_load = 1e-3;
// Stability is judged with twice the arcs until two judgements agree.
constexpr int most_stability_doublings = 6;

// The solver that options with fixed arcs, law and model describe, with its memory; empty where solve() would end in
// `unsupported`, with the reason. run_prepared does not allocate for a march, nor for a boundary value problem of one
// segment.
struct Prepared {
  std::variant<March, BasicMarch<2>, BoundaryValue, BasicBoundaryValue<2>> solver;
  Matrix3d rotation_BP = Matrix3d::Identity();  // from the frame that the solver works in to the base frame
};
std::optional<Prepared> prepare(const scene::Scene& scene, const Options& options, std::string& reason);
scene::Status run_prepared(Prepared& prepared);
// After a converged run: arcs and poses of their ends, clamp to tip, in the base frame.
std::vector<Arc> arcs_of(const Prepared& prepared);
std::vector<SectionPose> poses_of(const Prepared& prepared);

}  // namespace fam
