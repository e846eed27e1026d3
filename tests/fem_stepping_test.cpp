#include "fem_benchmark.h"

#include <gtest/gtest.h>
