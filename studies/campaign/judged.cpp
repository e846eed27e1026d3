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
  result.tolerance = tolerances.certificate;
  if (!ask_exact && result.certificate.holds(allowed)) return result;
  const double length_mm = scene::length_mm(scene);
  result.exact = exact_reference::solve(scene, {exact_reference::RodModel::reissner, tolerances.exact});
  if (!result.by_exact()) return result;
  result.tolerance = tolerances.exact;
  result.position = largest_distance_mm(answer, *result.exact) / length_mm;
  result.tip = (answer.tip().position_B_mm - result.exact->tip().position_B_mm).norm() / length_mm;
  return result;
}

std::string Judged::certified_by() const {
  using Branch = exact_reference::Certificate::Branch;
  switch (certificate.branch) {
    case Branch::alone: return "certified: the only equilibrium";
    case Branch::walked: return "certified: path back";
    case Branch::signs:
    case Branch::doubtful: break;
  }
  return "certified: signs of the branch";
}

}  // namespace studies
