// The number of unstable directions against the eigenvalues of the whole tangent, and of shapes that are given.
#include "fem_reference/path.h"
#include "fem_reference/shape_index.h"
#include "fem_whole_system.h"
#include "support.h"

#include <gtest/gtest.h>
#include <Eigen/Eigenvalues>

#include <numbers>

namespace fem_index {

using namespace fem_reference;
using scene::Frame;
using scene::PathParameter;
using scene::PathPoint;
using scene::PathRequest;

inline Options elements(int count) {
  Options options;
  options.elements = count;
  return options;
}

// Negative eigenvalues, less one for each number of the internal forces (stability.h). The one of a turn that costs
// nothing is zero within round-off.
inline int negative(const SolvedBeam& beam, double least) {
  const Eigen::MatrixXd K = WholeSystem(beam.model, beam.state, 1).tangent;
  const Eigen::VectorXd values =
      Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(0.5 * (K + K.transpose()), Eigen::EigenvaluesOnly).eigenvalues();
  const auto forces = static_cast<int>(3 * beam.state.force_S.size());
  return static_cast<int>((values.array() < -least).count()) - forces;
}

inline PathRequest column_with(double strong, double to) {
  scene::Stiffness stiffness = support::slender(1, 0.8);
  stiffness.bending_Nmm2[1] = strong;
  PathRequest request;
  request.scene = support::uniform_rod(1, stiffness, {scene::Force{1, Frame::fixed, {-1, 0, 0}}});
  request.to = to;
  request.branches = 3;
  return request;
}

inline PathRequest turned_rod() {
  PathRequest request;
  request.scene =
      support::uniform_rod(1.7, support::slender(1, 0.8),
                           {scene::Force{1.7, Frame::fixed, {0, 0, -3}, {0.02, 0}}, scene::Tendon{{0, 0.05}, 2, 1.2}});
  request.scene.sections[0].rest_curvature_per_mm = {0, 1.5, 0};
  request.parameter = PathParameter::turn_rad;
  request.to = 2 * std::numbers::pi;
  return request;
}

TEST(FemIndex, IsThatOfTheWholeTangent) {
  int largest = 0, points = 0, neutral = 0;
  for (const PathRequest& request : {column_with(1, 30), column_with(3, 30), turned_rod()}) {
    const scene::Path path = follow(request, elements(8), [&](const PathPoint& point, const SolvedBeam& beam) {
      if (point.kind == PathPoint::Kind::fold || point.multiplicity > 0) return;  // there an eigenvalue is zero
      EXPECT_EQ(point.index, negative(beam, 1e-7)) << point.parameter << " branch " << point.branch;
      largest = std::max(largest, *point.index);
      neutral += point.neutral;
      ++points;
    });
    EXPECT_TRUE(is_complete(path.status)) << path.message;
  }
  EXPECT_GE(largest, 3);
  EXPECT_GT(neutral, 20);
  EXPECT_GT(points, 150);
}

// The stations of a coarser rod's path stand for another method's shapes.
TEST(FemIndex, OfAShapeFromElsewhere) {
  int unstable = 0;
  for (const PathRequest& request : {column_with(1, 12), turned_rod()}) {
    follow(request, elements(25), [&](const PathPoint& point, const SolvedBeam& beam) {
      if (point.kind != PathPoint::Kind::regular) return;
      const scene::Scene scene = scene_at(request, point.parameter);
      auto shape = stations(beam).value();
      const ShapeIndex found = index_of_shape(scene, shape, elements(60));
      EXPECT_EQ(found.index, point.index) << point.parameter << " " << found.message;
      EXPECT_EQ(found.neutral, point.neutral);
      EXPECT_LT(found.moved_mm, 1e-3);
      unstable += *point.index > 0;
    });
  }
  EXPECT_GT(unstable, 10);
}

TEST(FemIndex, AShapeThatIsNoneHasNone) {
  const PathRequest request = column_with(3, 1);
  follow(request, elements(20), [&](const PathPoint& point, const SolvedBeam& beam) {
    if (point.kind != PathPoint::Kind::end) return;
    auto shape = stations(beam).value();
    for (scene::Station& station : shape) station.X_BS.position_B_mm.y() += 0.01 * station.s_mm;
    const ShapeIndex found = index_of_shape(request.scene, shape, elements(20));
    EXPECT_FALSE(found.index.has_value());
    EXPECT_FALSE(found.message.empty());
  });
}

}  // namespace fem_index
