// The finite arc method as a competitor.
#pragma once

#include "fam/solve.h"
#include "studies/method.h"

namespace studies {

// With a fixed number of arcs the bare solve is the march; with a tolerance it is all of fam::solve, choice included.
std::unique_ptr<Method> fam_method(const fam::Options& options);

}  // namespace studies
