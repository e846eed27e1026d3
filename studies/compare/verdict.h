// What a method's answer is worth beside the exact one, and whether the method knew.
#pragma once

#include "scene/equilibrium.h"
#include "scene/scene.h"

#include <functional>

namespace studies {

// error: distance of the tip from the exact tip, over L.
enum class Verdict {
  right_to_1e6,   // error <= 1e-6
  right_to_1e4,   // <= 1e-4
  right_to_1e2,   // <= 1e-2
  flagged,        // > 1e-2, and the method's own estimate is at least a third of it
  wrong,          // > 1e-2, converged, estimate less than a third: wrong and not flagged
  wrong_branch,   // the same, and it is another equilibrium: see judge()
  not_converged,  // the method says so
  work_limit,     // the method says that it used up the work it was given
  unsupported     // the method says that it cannot solve this scene
};

const char* name(Verdict verdict);
bool is_right(Verdict verdict);
bool is_silent(Verdict verdict);  // wrong, or wrong_branch

struct Judgement {
  Verdict verdict = Verdict::not_converged;
  double error = 0;     // over L; of converged answers
  double estimate = 0;  // the method's own, over L
};

// `truth`: converged. refined: the method's answer at four times the resolution, called for wrong answers that were not
// flagged. One is on another branch if its stability is not the truth's, or if refinement moves it by less than a
// tenth of its error.
Judgement judge(const scene::Equilibrium& answer, const scene::Equilibrium& truth, double length_mm,
                const std::function<scene::Equilibrium()>& refined);

}  // namespace studies
