// Random scenes (random_scene.h) solved by FAM and the exact reference, some by finite elements, each answer judged.
#pragma once

#include "scene/equilibrium.h"
#include "scene/scene.h"
#include "studies/compare/verdict.h"

#include <cstdint>
#include <functional>
#include <string>

namespace studies {

// FAM chooses its arcs for 1e-4 L, the exact reference resolves 1e-9 L, finite elements are 50 quadratic ones.
constexpr double random_fam_tolerance = 1e-4, random_exact_tolerance = 1e-9;

// What came of one method on one scene.
struct RandomOutcome {
  std::uint64_t seed = 0;
  std::string loads;               // "follower", "dead" (these have an energy), "mixed", "buckling" (random_scene.h)
  std::string method;              // "fam", "fem", "exact"
  std::string outcome;             // of a verdict; "only fam", ...: see random_outcomes()
  double error = 0, estimate = 0;  // over L
};

// Reports one outcome a method: exact, fam, fem. The exact reference itself: "converged" or "not converged". Where it
// did not converge: "no judge", or "not converged either" of a method that gave up as well. `tolerance missed`: fam,
// error > 3e-4 L but <= 1e-2 L.
void random_outcomes(std::uint64_t seed, bool with_finite_elements,
                     const std::function<void(const RandomOutcome&)>& report);

// By 100 quadratic finite elements in steps of at most 0.1 rad.
scene::Equilibrium solve_in_small_steps(const scene::Scene& scene);

// A second opinion on the judge, method "fem in small steps".
RandomOutcome second_opinion(std::uint64_t seed);

// Silent or lost answers, which the results list by seed.
bool is_listed(const RandomOutcome& outcome);

// The exact reference took more than a scene's time, so that nobody else was asked: one scene without a judge.
bool stopped_the_judge(const RandomOutcome& outcome);

// One line of text for an outcome and back: seed,loads,method,outcome,error,estimate.
std::string to_line(const RandomOutcome& outcome);
RandomOutcome from_line(const std::string& line);

}  // namespace studies
