// How the study of paths compares two of them.
#include "studies/paths/data.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace {

using scene::PathPoint;
using Kind = PathPoint::Kind;

PathPoint at(double parameter, double y_mm, int index, Kind kind = Kind::regular) {
  PathPoint point;
  point.parameter = parameter;
  point.tip_position_B_mm = {0, y_mm, 0};
  point.index = index;
  point.kind = kind;
  return point;
}

// Up to a fold at 3 and back, stops at 1 and 2.
scene::Path folded(double fold, double shift_mm, int index_beyond = 1) {
  scene::Path path;
  path.points = {at(0, 0, 0, Kind::start),    at(1, 10 + shift_mm, 0),           at(2, 20, 0),
                 at(fold, 30, 0, Kind::fold), at(2, 40, index_beyond),           at(1.5, 45, index_beyond),
                 at(1, 50, index_beyond),     at(0, 60, index_beyond, Kind::end)};
  return path;
}

const std::vector<double> stops{1, 2};

TEST(PathAgreement, OfAPathWithItself) {
  const studies::PathAgreement same = studies::agreement(folded(3, 0), folded(3, 0), stops, 100);
  EXPECT_EQ(same.places, 5);  // both stops, up and back, and the fold
  EXPECT_EQ(same.missing, 0);
  EXPECT_EQ(same.indexed, 4);
  EXPECT_EQ(same.same_index, 4);
  EXPECT_EQ(same.farthest_tip, 0);
  EXPECT_EQ(same.farthest_critical, 0);
}

TEST(PathAgreement, SeesTipsFoldsAndIndices) {
  const studies::PathAgreement other = studies::agreement(folded(3.03, 2, 2), folded(3, 0), stops, 100);
  EXPECT_NEAR(other.farthest_tip, 0.02, 1e-12);
  EXPECT_NEAR(other.farthest_critical, 0.01, 1e-12);
  EXPECT_EQ(other.same_index, 2);
}

TEST(PathAgreement, CountsPlacesThatOneHasAlone) {
  scene::Path short_one = folded(3, 0);
  short_one.points.resize(3);  // neither the fold nor the way back
  const studies::PathAgreement cut = studies::agreement(short_one, folded(3, 0), stops, 100);
  EXPECT_EQ(cut.places, 2);
  EXPECT_EQ(cut.missing, 3);
}

// What the numbers known otherwise are read from: the first and the second fold or branch point of the first branch.
TEST(PathCases, NumbersComeFromTheFirstBranch) {
  const auto& cases = studies::path_cases();
  const auto column = std::find_if(cases.begin(), cases.end(), [](const auto& c) { return c.key == "elastica"; });
  ASSERT_NE(column, cases.end());
  scene::Path path = folded(0.99, 0);
  EXPECT_NEAR(column->known.front().of_path(path).value(), 0.99, 1e-12);
  EXPECT_FALSE(column->known[1].of_path(path).has_value());
  for (PathPoint& point : path.points) point.branch = 1;
  EXPECT_FALSE(column->known.front().of_path(path).has_value());
}

}  // namespace
