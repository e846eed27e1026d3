// Numbers too small to be normal ones are zero as long as they are asked to be.
#include "scene/subnormals_as_zero.h"

#include <gtest/gtest.h>

#include <limits>

namespace {

#ifdef __SSE2__
TEST(SubnormalsAsZero, AsLongAsItLives) {
  volatile double smallest = std::numeric_limits<double>::min();
  const auto is_zero = [&smallest] { return smallest / 2 == 0; };
  EXPECT_FALSE(is_zero());
  {
    const scene::SubnormalsAsZero fast;
    EXPECT_TRUE(is_zero());
  }
  EXPECT_FALSE(is_zero());
}
#endif

}  // namespace
