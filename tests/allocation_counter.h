// Counts every allocation of the test executable that links allocation_counter.cpp.
#pragma once

#include <cstddef>

std::size_t allocation_count();
