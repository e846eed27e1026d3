// The finite element reference as a competitor.
#pragma once

#include "fem_reference/solve.h"
#include "studies/methods/method.h"

namespace studies {

// The bare solve is all of fem_reference::solve without its second mesh.
std::unique_ptr<Method> fem_method(const fem_reference::Options& options);

}  // namespace studies
