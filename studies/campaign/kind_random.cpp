// Campaigns `random`, `audit` and `promise`: one answer a scene, judged.
#include "exact_reference/solve.h"
#include "fam/solve.h"
#include "studies/campaign/judged.h"
#include "studies/campaign/kind_rows.h"
#include "studies/methods/rk4_method.h"
#include "studies/scenes/random_scene.h"

#include <algorithm>
#include <array>

namespace studies {
namespace {

constexpr double asked_tolerance = 1e-4;        // over L
constexpr double missed = 3 * asked_tolerance;  // "tolerance missed" above, as in study `random`
constexpr double wrong = 1e-2;                  // over L
constexpr int exact_every = 100, exact_on_failures_every = 10;
constexpr int shooting_steps = 200;

scene::Equilibrium by_fam(const scene::Scene& scene, double tolerance) {
  fam::Options options;
  options.tolerance_mm = tolerance * scene::length_mm(scene);
  options.locate_limit = false;
  return fam::solve(scene, options);
}

// Of a scene that FAM has no answer to.
void judge_no_answer(SceneOutcome& outcome, const scene::Scene& scene, const scene::Equilibrium& answer, bool ask) {
  const std::string status = scene::name(answer.status);
  if (!ask) {
    outcome.outcome = "no answer: " + status;
    return;
  }
  const auto exact = exact_reference::solve(scene, {exact_reference::RodModel::reissner, JudgeTolerances{}.exact});
  if (exact.converged()) set_failure(outcome, "no answer but exact: " + status);
  else outcome.outcome = "no answer nor exact: " + status;
}

bool tells(const scene::Equilibrium& answer, double error, double length_mm) {
  return answer.error_estimate_mm / length_mm >= error / 3;
}

// Of an error that is not the judge's own; the estimate over L.
void add_share_of_estimate(SceneOutcome& outcome, const Judged& by, double estimate) {
  if (by.position > 3 * by.tolerance) outcome.measures.push_back({"error / estimate", by.position / estimate});
}

SceneOutcome random_outcome(std::uint64_t campaign, std::uint64_t index) {
  SceneOutcome outcome = started(campaign, index);
  const scene::Scene scene = random_scene(campaign_seed(campaign, index));
  const double length_mm = scene::length_mm(scene);
  const scene::Equilibrium answer = by_fam(scene, asked_tolerance);
  if (!answer.converged()) {
    judge_no_answer(outcome, scene, answer, in_sample(index, exact_on_failures_every));
    return outcome;
  }
  const Judged by = judged(scene, answer, missed, in_sample(index, exact_every));
  if (!by.exact) {
    outcome.outcome = by.verdict(missed);
  } else if (!by.by_exact()) {
    set_failure(outcome, "no judge");
  } else if (by.tip > wrong) {
    set_failure(outcome, tells(answer, by.tip, length_mm) ? "wrong but flagged" : "wrong and silent");
    if (by.certificate.holds(missed)) outcome.outcome += " and certified";
  } else if (by.position > missed) {
    set_failure(outcome, "tolerance missed");
  } else {
    outcome.outcome = by.verdict(missed) == "doubted" ? "right: certificate doubted" : "right: sample";
  }
  outcome.measures = {{"position", by.position}};
  add_share_of_estimate(outcome, by, answer.error_estimate_mm / length_mm);
  if (by.certificate.found) {
    outcome.measures.push_back({"rotation_rad", by.certificate.rotation_rad});
    outcome.measures.push_back({"wrench", by.certificate.wrench});
  }
  return outcome;
}

// Three answers a scene, in turn over the tens of the index.
scene::Equilibrium audited_answer(const scene::Scene& scene, std::uint64_t index) {
  const std::uint64_t which = index / 10 % 3;
  if (which == 2) return rk4_method({shooting_steps, true})->solve(scene);
  const scene::Equilibrium answer = by_fam(scene, asked_tolerance);
  if (which == 0 || !answer.converged()) return answer;
  fam::Options coarse;
  coarse.arcs = 1;
  for (const auto& [name, value] : answer.model) {
    if (name == "arcs") coarse.arcs = std::max(1, std::get<int>(value) / 4);
  }
  coarse.locate_limit = false;
  return fam::solve(scene, coarse);
}

SceneOutcome audit_outcome(std::uint64_t campaign, std::uint64_t index) {
  static constexpr std::array candidates{"FAM", "FAM on few arcs", "plain shooting"};
  SceneOutcome outcome = started(campaign, index);
  outcome.kind = candidates[index / 10 % 3];
  const scene::Scene scene = random_scene(campaign_seed(campaign, index));
  const scene::Equilibrium answer = audited_answer(scene, index);
  if (!answer.converged()) {
    outcome.outcome = "no answer";
    return outcome;
  }
  const Judged by = judged(scene, answer, missed, true);
  const bool holds = by.certificate.holds(missed);
  const std::string certificate = by.verdict(missed);
  if (!by.by_exact()) {
    outcome.outcome = certificate + "; no exact answer";
  } else if (by.position <= missed) {
    outcome.outcome = certificate + "; right";
  } else {
    outcome.outcome = certificate + "; not right";
    outcome.failure = holds;
    outcome.measures = {{holds ? "position where certified" : "position where doubted", by.position}};
  }
  return outcome;
}

SceneOutcome promise_outcome(std::uint64_t campaign, std::uint64_t index) {
  static constexpr std::array tolerances{1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8};
  const double tolerance = tolerances[index / 10 % tolerances.size()];
  SceneOutcome outcome = started(campaign, index);
  const scene::Scene scene = random_scene(campaign_seed(campaign, index));
  const scene::Equilibrium answer = by_fam(scene, tolerance);
  if (!answer.converged()) {
    outcome.outcome = std::string("no answer: ") + scene::name(answer.status);
    return outcome;
  }
  const JudgeTolerances by_tolerance{std::clamp(tolerance / 100, 1e-10, 1e-7), 1e-11};
  const Judged by = judged(scene, answer, tolerance, in_sample(index, exact_every), by_tolerance);
  const double other_branch = std::max(3e-2, 3 * tolerance);
  if (by.exact && !by.by_exact()) set_failure(outcome, "no judge");
  else if (by.position > other_branch) set_failure(outcome, "other equilibrium");
  else if (by.position - judges_error > tolerance) set_failure(outcome, "missed");
  else outcome.outcome = "kept";
  outcome.measures = {{"error / tolerance", by.position / tolerance}};
  add_share_of_estimate(outcome, by, answer.error_estimate_mm / scene::length_mm(scene));
  return outcome;
}

}  // namespace

const CampaignKind random_kind{"random", "Is an answer ever wrong without saying so?", random_outcome};
const CampaignKind audit_kind{"audit", "Does the certificate miss what the exact reference finds?", audit_outcome};
const CampaignKind promise_kind{"promise", "Does the whole rod keep the tolerance?", promise_outcome};

}  // namespace studies
