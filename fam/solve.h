// Entry point of the finite arc method: a scene and options in, an equilibrium out.
#pragma once

#include "fam/options.h"
#include "fam/engine.h"

#include "scene/equilibrium.h"
#include "scene/scene.h"

#include <optional>
#include <string>
#include <vector>

namespace fam {

// Solves a valid scene (scene::validate). Numerical trouble is a status, never an exception:
//   unsupported        published law with a fixed or distributed load, with shear or EI_y != EI_z
//   load_step_too_small, work_limit, not_converged   see fam/load_growth.h
//   arc_not_converged  published law: see fam/published_arc.h; sixth_order with fixed arcs: an arc longer than its
//                      series can resolve (fam/engine.h)
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
// The error estimate: fam/tolerance.h.
scene::Equilibrium solve(const scene::Scene& scene, const Options& options = {});

// The solver that options with fixed arcs, law and model describe, with its memory; empty where solve() would end in
// `unsupported`, with the reason.
struct Prepared {
  Engine solver;
  Choice choice;
  std::vector<scene::Span> spans;  // as they are solved, but for a plane's rotation
  std::vector<int> arcs_per_span;
};
std::optional<Prepared> prepare(const scene::Scene& scene, const Options& options, std::string& reason);
// Does not allocate. Its status is that of solve() with the same number of arcs.
scene::Status run_prepared(Prepared& prepared);
// After a converged run: arcs and poses of their ends, clamp to tip, in the base frame.
std::vector<Arc> arcs_of(const Prepared& prepared);
std::vector<SectionPose> poses_of(const Prepared& prepared);

}  // namespace fam
