// Plain shooting (rk4_shooting.h) as a competitor.
#pragma once

#include "studies/methods/method.h"

namespace studies {

struct Rk4Options {
  int steps = 50;  // on the whole rod, shared out over the spans; each span gets at least one
  bool with_shear = true;
};

// The bare solve is Newton from zero; the warm one is Newton from the solution under loads smaller by a hundredth.
// Error estimate: the distance of the tip from that with twice the steps, times 16/15; infinite where twice the steps do
// not converge. By how much tendons shorten is not computed.
std::unique_ptr<Method> rk4_method(const Rk4Options& options);

}  // namespace studies
