// An answer beside the certificate and, where that is not enough, beside the exact reference.
#pragma once

#include "exact_reference/certificate.h"
#include "scene/scene.h"
#include "studies/campaign/tally.h"

#include <optional>

namespace studies {

struct Judged {
  exact_reference::Certificate certificate;
  std::optional<scene::Equilibrium> exact;  // where it was asked
  double position = 0, tip = 0;             // errors over L, by the exact reference where it was asked and converged
  double tolerance = 0;                     // of the judge that told these, over L
  bool by_exact() const { return exact && exact->converged(); }
  // The answer within `allowed`, over L, of an equilibrium for which signs alone speak: the exact reference takes 0.3 s
  // of such a rod in the mean, which for a million scenes is too long, and is asked of a sample.
  bool by_signs(double allowed) const;
  std::string verdict(double allowed) const;  // the certificate's: "certified: ...", "signs alone" or "doubted"
};

// The exact reference resolves 1e-9 L, a certificate's equilibrium this, unless tolerances are given.
struct JudgeTolerances {
  double certificate = 1e-7, exact = 1e-9;
};

// ask_exact: in any case; else where the certificate does not hold `allowed` (over L), but for signs alone.
Judged judged(const scene::Scene& scene, const scene::Equilibrium& answer, double allowed, bool ask_exact,
              const JudgeTolerances& tolerances = {});

// Errors below this, over L, are the judges' own (promise.h).
constexpr double judges_error = 3e-9;

}  // namespace studies
