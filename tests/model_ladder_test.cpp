// The study of the model choice: what it calls the smallest sufficient model, and that its models are what they say.
#include "exact_reference/solve.h"
#include "studies/model_choice/data.h"
#include "studies/model_choice/random_choice.h"
#include "studies/scenes/random_scene.h"
#include "support.h"

#include <gtest/gtest.h>

#include <variant>

namespace {

using studies::ModelSize;
using studies::Rung;

std::vector<Rung> ladder(const std::vector<double>& errors) {
  std::vector<Rung> rungs;
  for (const double error : errors) {
    rungs.push_back({{.count = 1 << rungs.size()}, "converged", error, {}});
  }
  return rungs;
}

int smallest(const std::vector<double>& errors, double tolerance) {
  const std::vector<Rung> rungs = ladder(errors);
  const Rung* rung = studies::smallest_sufficient(rungs, tolerance);
  return rung == nullptr ? 0 : rung->model.count;
}

TEST(ModelLadder, TakesTheFirstFromWhichOnAllDo) {
  EXPECT_EQ(smallest({1e-1, 1e-3, 1e-5, 1e-7}, 1e-4), 4);
  EXPECT_EQ(smallest({1e-1, 1e-3, 1e-5, 1e-7}, 1e-3), 2) << "the tolerance itself is within it";
  EXPECT_EQ(smallest({1e-6, 1e-3, 1e-5, 1e-7}, 1e-4), 4) << "not the lucky first";
  EXPECT_EQ(smallest({1e-6, 1e-5}, 1e-4), 1);
  EXPECT_EQ(smallest({1e-1, 1e-3, NAN, 1e-7}, 1e-4), 8) << "nor one before a failure";
  EXPECT_EQ(smallest({1e-1, 1e-3, 1e-5, NAN}, 1e-4), 0);
  EXPECT_EQ(smallest({1e-1, 1e-3}, 1e-4), 0);
}

TEST(ModelLadder, BisectsForTheFewest) {
  for (const int guess : {1, 5, 6, 7, 64}) {
    EXPECT_EQ(studies::fewest_sufficient([](int n) { return n >= 6; }, 1, guess, 64), 6) << guess;
  }
  EXPECT_EQ(studies::fewest_sufficient([](int) { return true; }, 3, 10, 64), 3);
  EXPECT_EQ(studies::fewest_sufficient([](int n) { return n > 64; }, 1, 10, 64), 0);
  EXPECT_EQ(studies::fewest_sufficient([](int n) { return n >= 64; }, 1, 10, 64), 64);
}

// Loads of next to nothing have the library take space and a boundary value problem, and move nothing.
TEST(ModelLadder, ModelsAreWhatTheySay) {
  for (const char* frame : {"follower", "fixed"}) {
    const scene::Scene scene = support::study1_scene("P4", frame);
    const studies::SceneFacts facts = studies::facts_of(scene);
    ASSERT_TRUE(facts.planar && facts.gives_way);
    const scene::Equilibrium truth = exact_reference::solve(scene);
    EXPECT_EQ(studies::all_models(facts).size(), facts.march ? 10u : 6u);
    for (const std::vector<ModelSize>& models : studies::all_models(facts)) {
      const ModelSize& model = models[4];
      const scene::Equilibrium answer = studies::method_of(model)->solve(studies::made_to_take(model, facts, scene));
      ASSERT_TRUE(answer.converged()) << answer.message;
      const double error = studies::shape_error(answer, truth);
      EXPECT_EQ(error < 1e-4, model.shear) << error;
      if (model.finite_elements) continue;
      for (const auto& [key, value] : answer.model) {
        if (key == "kernel") {
          EXPECT_EQ(std::get<std::string>(value), model.space ? "spatial" : "planar");
        }
        if (key == "solver") {
          EXPECT_EQ(std::get<std::string>(value), model.solver());
        }
        if (key == "shear") {
          EXPECT_EQ(std::get<bool>(value), model.shear);
        }
        if (key == "arcs") {
          EXPECT_EQ(std::get<int>(value), model.count);
        }
      }
    }
  }
}

// The judge is FAM itself, asked for more: on these the exact reference says the same.
TEST(ModelLadder, RandomChoicesAreJudgedAsByTheExactReference) {
  std::vector<studies::RandomChoice> choices;
  for (std::uint64_t i = 0; i < 20; ++i) {
    choices.push_back(studies::random_choice(studies::mixed_seed(i), {true, i % 4 == 0}));
  }
  const studies::RandomCounts counts = studies::count_choices(choices, "");
  EXPECT_GE(counts.judged, 18);
  EXPECT_GE(counts.sampled, 18);
  EXPECT_EQ(counts.disagreed, 0);
  EXPECT_EQ(counts.insufficient, counts.sampled_insufficient);
  EXPECT_GE(counts.looked_for, 4);
  EXPECT_LE(counts.smallest, counts.within_2);
  EXPECT_LE(counts.within_2, counts.within_4);
  EXPECT_LE(counts.space_needed, counts.space);
}

}  // namespace
