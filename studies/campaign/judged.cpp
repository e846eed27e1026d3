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
  if (!ask_exact && (result.certificate.holds(allowed) || result.by_signs(allowed))) return result;
  const double length_mm = scene::length_mm(scene);
  result.exact = exact_reference::solve(scene, {exact_reference::RodModel::reissner, tolerances.exact});
  if (!result.by_exact()) return result;
  result.tolerance = tolerances.exact;
  result.position = largest_distance_mm(answer, *result.exact) / length_mm;
  result.tip = (answer.tip().position_B_mm - result.exact->tip().position_B_mm).norm() / length_mm;
  return result;
}

bool Judged::by_signs(double allowed) const {
  return certificate.is_near(allowed) && certificate.branch == exact_reference::Certificate::Branch::signs;
}

std::string Judged::verdict(double allowed) const {
  if (by_signs(allowed)) return "signs alone";
  if (!certificate.holds(allowed)) return "doubted";
  const bool alone = certificate.branch == exact_reference::Certificate::Branch::alone;
  return alone ? "certified: the only equilibrium" : "certified: path back";
}

}  // namespace studies
