// A certificate of another method's answer, cheaper than a solve of its own: the answer's stations, put into the rod
// equations as the node states of multiple shooting (shooting.h), leave defects, and Newton's iteration with the
// factorised derivatives turns them into the distance to an equilibrium of these equations. Nothing of the other method
// but its stations is used; where all loads follow, the equilibrium is the only one.
//
// Whether the growing load leads to that equilibrium is told by signs and by unloading the rod from it. That they
// suffice is measured, not proved (study `campaign`); that signs alone do not, too.
#pragma once

#include "exact_reference/scaled_rod.h"
#include "scene/equilibrium.h"
#include "scene/scene.h"

#include <string>

namespace exact_reference {

struct Certificate {
  enum class Branch {
    alone,   // the only equilibrium: loads that follow, moments that are known, loads too small for a second one
             // (load_size() < 1)
    walked,  // signs hold, and the rod unloads from it to the unloaded rod, no step a jump (leads_back)
    signs,   // the determinant's sign is the unloaded rod's, and no direction lets the energy fall, where there is one;
             // a path back takes too much work (coils, cables): no certificate, but no doubt either
    doubtful  // a sign is another, or the rod does not unload so
  };
  // Newton's iteration from the stations ended at an equilibrium, the mesh refined to the tolerance. Else the numbers
  // below are infinite and the branch doubtful.
  bool found = false;
  std::string message;  // why not
  // Largest distance of the answer from that equilibrium over its stations.
  double position = HUGE_VAL;      // over L
  double tip_position = HUGE_VAL;  // over L
  double rotation_rad = HUGE_VAL;
  double wrench = HUGE_VAL;  // forces over the largest, moments over the largest, of any station
  Branch branch = Branch::doubtful;

  // Within `allowed` of an equilibrium, over L.
  bool is_near(double allowed) const { return found && position <= allowed; }
  // And that is the one which the growing load leads to.
  bool holds(double allowed) const { return is_near(allowed) && (branch == Branch::alone || branch == Branch::walked); }
};

// The answer: converged, its stations at all places where sections change or point loads stand at least, less than half
// a turn apart, for the stations' wrenches the rod's own. tolerance: of the equilibrium's positions, over L, as of
// Options. The scene must be valid.
Certificate certify(const scene::Scene& scene, const scene::Equilibrium& answer, double tolerance,
                    RodModel model = RodModel::reissner);

}  // namespace exact_reference
