// The exact reference as a method.
#pragma once

#include "exact_reference/solve.h"
#include "studies/methods/method.h"

namespace studies {

std::unique_ptr<Method> exact_method(const exact_reference::Options& options);

}  // namespace studies
