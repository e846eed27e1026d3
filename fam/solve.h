// Entry point of the finite arc method: a scene and options in, an equilibrium out.
#pragma once

#include "fam/options.h"

#include "scene/equilibrium.h"
#include "scene/scene.h"

namespace fam {

// Solves a valid scene (scene::validate). Numerical trouble is a status, never an exception:
//   unsupported        published law with a fixed or distributed load, with shear or EI_y != EI_z
//   limit_point        the growing load meets a fold, where the rod snaps: `limit` tells where (fam/limit.h);
//                      with Options::after_snap only if its path never comes back to the full load
//   load_step_too_small, work_limit, not_converged   see fam/load_growth.h
//   arc_not_converged  published law: see fam/published_arc.h; sixth_order with fixed arcs: an arc longer than its
//                      series can resolve (fam/engine.h); known moments: see Shooting::solve_known_moments
//   tolerance_not_met  estimated error > tolerance with max_arcs arcs
//   tendon_collapsed   |v + u x r| <= smallest_tendon_stretch somewhere (fam/tendon.h)
//   not_finite         overflow
//
// The automatic choice, each part reported in words (model: reason):
//   plane or space   the planar kernels where all lies in one plane (model_choice.h); but for the published law
//   shear            model_choice.h
//   law              sixth_order: an arc costs what one of fourth_order does, and fewer are needed
//   arcs             multiples of set_first_arcs(), the smallest found whose estimated error meets the tolerance; a
//                    column (column.h) takes one of each span
//   solver           the march where all loads follow, else the boundary value problem
//
// The error estimate: fam/tolerance.h. A thread keeps the memory of its last solve of a small rod.
scene::Equilibrium solve(const scene::Scene& scene, const Options& options = {});

}  // namespace fam
