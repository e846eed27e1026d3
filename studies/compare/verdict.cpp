#include "studies/compare/verdict.h"

namespace studies {
namespace {

constexpr double right = 1e-2, moderate = 1e-4, tight = 1e-6;  // over L

double distance(const scene::Equilibrium& a, const scene::Equilibrium& b, double length_mm) {
  return (a.tip().position_B_mm - b.tip().position_B_mm).norm() / length_mm;
}

Verdict verdict_on_failure(const scene::Equilibrium& answer) {
  if (answer.status == scene::Status::unsupported) return Verdict::unsupported;
  return answer.status == scene::Status::work_limit ? Verdict::work_limit : Verdict::not_converged;
}

bool on_another_branch(const scene::Equilibrium& answer, const scene::Equilibrium& truth, double error,
                       double length_mm, const std::function<scene::Equilibrium()>& refined) {
  if (answer.stable && truth.stable && *answer.stable != *truth.stable) return true;
  const scene::Equilibrium finer = refined();
  return finer.converged() && distance(finer, answer, length_mm) < 0.1 * error;
}

}  // namespace

const char* name(Verdict verdict) {
  switch (verdict) {
    case Verdict::right_to_1e6: return "right to 1e-6";
    case Verdict::right_to_1e4: return "right to 1e-4";
    case Verdict::right_to_1e2: return "right to 1e-2";
    case Verdict::flagged: return "wrong but flagged";
    case Verdict::wrong: return "wrong and not flagged";
    case Verdict::wrong_branch: return "wrong branch";
    case Verdict::not_converged: return "not converged";
    case Verdict::work_limit: return "work limit";
    case Verdict::unsupported: return "unsupported";
  }
  return "";
}

bool is_right(Verdict verdict) {
  return verdict <= Verdict::right_to_1e2;
}

bool is_silent(Verdict verdict) {
  return verdict == Verdict::wrong || verdict == Verdict::wrong_branch;
}

Judgement judge(const scene::Equilibrium& answer, const scene::Equilibrium& truth, double length_mm,
                const std::function<scene::Equilibrium()>& refined) {
  if (!answer.converged()) return {verdict_on_failure(answer), 0, 0};
  const double error = distance(answer, truth, length_mm), estimate = answer.error_estimate_mm / length_mm;
  const auto judged = [&](Verdict verdict) { return Judgement{verdict, error, estimate}; };
  if (error <= tight) return judged(Verdict::right_to_1e6);
  if (error <= moderate) return judged(Verdict::right_to_1e4);
  if (error <= right) return judged(Verdict::right_to_1e2);
  if (!(estimate < error / 3)) return judged(Verdict::flagged);  // NaN: the estimate failed, and says so
  return judged(on_another_branch(answer, truth, error, length_mm, refined) ? Verdict::wrong_branch : Verdict::wrong);
}

}  // namespace studies
