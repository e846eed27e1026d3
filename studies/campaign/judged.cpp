#include "studies/campaign/judged.h"

#include "exact_reference/solve.h"
#include "studies/compare/error_measures.h"

namespace studies {

using scene::Equilibrium;

Judged judged(const scene::Scene& scene, const scene::Equilibrium& answer, double allowed, bool ask_exact,
              const JudgeTolerances& tolerances) {
  Judged result;
  result.certificate = exact_reference::certify(scene, answer, tolerances.certificate);
  result.position = result.certificate.position;
  result.tip = result.certificate.tip_position;
  if (!ask_exact && result.certificate.holds(allowed)) return result;
  const double length_mm = scene::length_mm(scene);
  const auto ask = [&](double tolerance) {
    result.exact = exact_reference::solve(scene, {exact_reference::RodModel::reissner, tolerance});
    if (!result.exact->converged()) return;
    result.position = largest_distance_mm(answer, *result.exact) / length_mm;
    result.tip = (answer.tip().position_B_mm - result.exact->tip().position_B_mm).norm() / length_mm;
  };
  ask(tolerances.exact);
  if (!result.by_exact() || result.position <= allowed) return result;
  // The reference itself may be at fault: along thousands of turns its errors add up.
  const Equilibrium first = *std::move(result.exact);
  ask(tolerances.exact / 100);
  if (!result.by_exact()) return result;
  const double between = largest_distance_mm(first, *result.exact) / length_mm;
  result.unresolved = result.position > allowed && result.position <= between;
  return result;
}

}  // namespace studies
