// Where an estimator's search ends: at bounds, and where the model's own error hides what is left.
#include "fam/estimator.h"
#include "scene/estimation_file.h"
#include "support.h"

#include <gtest/gtest.h>

#include <cmath>

namespace {

using fam::Estimate;
using fam::Estimator;
using scene::EstimationProblem;

// The tip's position, which a last section of this length gives way for; the rod is as stiff as the model.
EstimationProblem stiffness_of_the_last(double last_mm, double tip_y_mm) {
  scene::Scene rod = support::uniform_rod(100 - last_mm, support::slender(1500, 1000),
                                          {scene::Force{100, scene::Frame::fixed, {0, 0.1, 0}}});
  rod.sections.push_back(support::uniform_rod(last_mm, support::slender(1500, 1000), {}).sections[0]);
  EstimationProblem problem;
  problem.scenes = {{rod, {{100, scene::PositionMeasurement{{97.263, tip_y_mm, 0}, 0.1}}}}};
  scene::Unknown factor;
  factor.kind = scene::Unknown::Kind::bending_factor;
  factor.index = 1;
  factor.prior_mean = 1;
  problem.unknowns = {factor};
  return problem;
}

// The last 5 mm bend the tip by 0.003 mm: what lies 0.2 deviations off asks for the stiffest of them, and what lies
// three off for the softest.
TEST(EstimatorEnds, AFactorThatIsPushedToABoundIsNotObservable) {
  for (const double tip_y_mm : {21.17, 21.49}) {
    const Estimate found = Estimator(stiffness_of_the_last(5, tip_y_mm)).estimate();
    ASSERT_TRUE(found.converged()) << found.message;
    EXPECT_TRUE(std::isnan(found.mean[0]) && std::isnan(found.sd[0])) << found.mean[0];
    EXPECT_FALSE(found.observable[0]);
    ASSERT_EQ(found.unobservable.size(), 1u);
    EXPECT_EQ(found.unobservable[0][0], 1);
  }
  const Estimate told = Estimator(stiffness_of_the_last(60, 21.17)).estimate();
  ASSERT_TRUE(told.converged() && told.observable[0]);
  EXPECT_NEAR(told.mean[0], 1, 3 * told.sd[0]);
  EXPECT_LT(told.sd[0], 0.1);
}

// 0.008 deviations from the minimum no step leads lower, for the rods of the default tolerance are no more exact.
TEST(EstimatorEnds, WhereTheModelsErrorHidesWhatIsLeft) {
  const EstimationProblem problem = scene::read_estimation_file(std::string(TEST_DATA_DIR) + "/estimation_flat.json");
  const Estimate found = Estimator(problem).estimate();
  const Estimate tight = Estimator(problem, {.tolerance_mm = 1e-7}).estimate();
  ASSERT_TRUE(found.converged() && tight.converged()) << found.message << tight.message;
  for (Eigen::Index k = 0; k < 3; ++k) EXPECT_NEAR(found.mean[k], tight.mean[k], 0.05 * tight.sd[k]) << k;
}

}  // namespace
