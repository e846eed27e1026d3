// Relations between scenes, whose answers must map onto each other (relations.h).
#include "relations.h"

#include "studies/compare/error_measures.h"
#include "studies/scenes/random_scene.h"
#include "support_fam.h"

#include <gtest/gtest.h>

namespace {

using scene::Equilibrium;
using scene::Scene;
using support::solved;

// The tolerance is kept by all relations on random scenes of all kinds, within twice the tolerance.
void compare_relations(std::uint64_t from, std::uint64_t to) {
  int compared = 0, unanswered = 0;
  for (std::uint64_t index = from; index < to; ++index) {
    const std::uint64_t seed = index % 2 == 0 ? index / 2 : studies::first_family_seed + index / 2;
    const Scene scene = studies::random_scene(seed);
    const double tolerance_mm = std::pow(10, -2. - static_cast<double>(index % 5)) * scene::length_mm(scene);
    const Equilibrium one = solved(scene, tolerance_mm);
    if (!one.converged()) continue;
    for (const support::Relation& relation : support::relations()) {
      Equilibrium other = solved(relation.change(scene), tolerance_mm * relation.scale);
      if (!other.converged()) {
        ++unanswered;
        continue;
      }
      Equilibrium mapped = one;
      for (scene::Station& station : mapped.stations) {
        station.s_mm *= relation.scale;
        station.X_BS.position_B_mm = relation.map_mm(station.X_BS.position_B_mm);
      }
      EXPECT_LE(studies::largest_distance_mm(mapped, other), 2 * tolerance_mm * relation.scale)
          << relation.name << ", seed " << seed;
      ++compared;
    }
  }
  EXPECT_GT(compared, 57 * static_cast<int>(to - from) / 10);
  EXPECT_LE(unanswered, 5);
}

TEST(Answers, RelationsBetweenScenes) {
  compare_relations(0, 300);
}
// The ctest relations_more, of the label slow.
TEST(Answers, DISABLED_RelationsBetweenMoreScenes) {
  compare_relations(300, 1000);
}

}  // namespace
