// fam-studies model-choice: Study I and studies/cases/robots, each with every model of a ladder against the exact rod,
// what fam::solve takes for seven tolerances and what one step less or more would have been; then 10 000 random scenes.
// With --quick one scene is timed, and of the random ones the first 1000 are solved, the others read back from
// results/.
#include "studies/study.h"

#include "exact_reference/solve.h"
#include "studies/methods/registry.h"
#include "studies/model_choice/data.h"
#include "studies/report/provenance.h"
#include "studies/scenes/cases.h"

#include <variant>

namespace studies {
namespace {

constexpr std::uint64_t random_scenes_chosen_for = 10'000, solved_quickly = 1000;
const std::string timed_quickly = "P1_fixed";

std::vector<ChoiceScene> choice_scenes(const std::filesystem::path& cases) {
  std::vector<ChoiceScene> scenes;
  for (const bool planar : {true, false}) {
    for (const std::string frame : {"follower", "fixed"}) {
      for (const std::string& load_case : study1_cases(planar)) {
        scenes.push_back({load_case + "_" + frame, planar ? "Study I, plane" : "Study I, space"});
      }
    }
  }
  for (const std::string& name : cases_in(cases, "robots")) scenes.push_back({name, "robots"});
  return scenes;
}

// A scene with its exact rod.
class ModelChoice {
 public:
  ModelChoice(const StudyOptions& options, ChoiceScene& result)
      : options_(options),
        result_(result),
        scene_(read_case(options.cases, (result.group == "robots" ? "robots/" : "study1/") + result.name)),
        exact_(exact_reference::solve(scene_)) {
    result.facts = facts_of(scene_);
    result.reference_error = exact_.error_estimate_mm / result.facts.length_mm;
  }

  void run() {
    for (const std::vector<ModelSize>& models : all_models(result_.facts)) {
      std::vector<Rung>& ladder = result_.ladders.emplace_back();
      for (const ModelSize& model : models) ladder.push_back(solved(model));
    }
    for (const double tolerance : choice_tolerances) result_.chosen.push_back(chosen(tolerance));
  }

 private:
  bool is_timed() const { return !options_.quick || result_.name == timed_quickly; }

  Rung solved(const ModelSize& model) const {
    Rung rung = solved_rung(model, result_.facts, scene_, exact_);
    if (is_timed())
      rung.time = time_of(options_, method_of(model)->bare_solve(made_to_take(model, result_.facts, scene_)), 0.008);
    return rung;
  }

  ChosenModel chosen(double tolerance) const {
    const std::unique_ptr<Method> automatic = method_row("fam")({.tolerance = tolerance});
    const scene::Equilibrium answer = automatic->solve(scene_);
    ChosenModel chosen;
    chosen.tolerance = tolerance;
    chosen.rung = {model_of(answer), scene::name(answer.status), shape_error(answer, exact_), {}};
    if (is_timed()) chosen.rung.time = time_of(options_, automatic->bare_solve(scene_), 0.02);
    if (!answer.converged()) return chosen;
    const int without = fewest_arcs(chosen, false);
    chosen.shear_needed = without == 0;
    chosen.fewest_arcs = without > 0 ? without : fewest_arcs(chosen, true);
    chosen.fewest_arcs_as_chosen = chosen.rung.model.shear ? fewest_arcs(chosen, true) : without;
    add_neighbours(chosen);
    return chosen;
  }

  static ModelSize model_of(const scene::Equilibrium& answer) {
    ModelSize model;
    for (const auto& [key, value] : answer.model) {
      if (key == "arcs") model.count = std::get<int>(value);
      if (key == "shear") model.shear = std::get<bool>(value);
      if (key == "solver") model.march = std::get<std::string>(value) == "march";
      if (key == "kernel") model.space = std::get<std::string>(value) == "spatial";
    }
    return model;
  }

  int fewest_arcs(const ChosenModel& chosen, bool shear) const {
    constexpr int most = 1024;
    const auto holds = [&](int arcs) {
      ModelSize model = chosen.rung.model;
      model.shear = shear, model.count = arcs;
      return solved_rung(model, result_.facts, scene_, exact_).suffices(chosen.tolerance);
    };
    return fewest_sufficient(holds, result_.facts.spans, chosen.rung.model.count, most);
  }

  void add_neighbours(ChosenModel& chosen) const {
    const ModelSize& model = chosen.rung.model;
    const auto add = [&](const std::string& what, bool exists, const std::function<void(ModelSize&)>& change) {
      if (!exists) return;
      ModelSize other = model;
      change(other);
      chosen.neighbours.push_back({what, solved(other)});
    };
    add(neighbour::same, true, [](ModelSize&) {});
    add(neighbour::half, model.count > result_.facts.spans,
        [&](ModelSize& m) { m.count = std::max(m.count / 2, result_.facts.spans); });
    add(neighbour::without_shear, model.shear, [](ModelSize& m) { m.shear = false; });
    add(neighbour::twice, true, [](ModelSize& m) { m.count *= 2; });
    add(neighbour::with_shear, !model.shear && result_.facts.gives_way, [](ModelSize& m) { m.shear = true; });
    add(neighbour::in_space, !model.space, [](ModelSize& m) { m.space = true; });
    add(neighbour::boundary_value, model.march, [](ModelSize& m) { m.march = false; });
  }

  const StudyOptions& options_;
  ChoiceScene& result_;
  scene::Scene scene_;
  scene::Equilibrium exact_;
};

}  // namespace

void model_choice(const StudyOptions& options) {
  ModelChoiceData data{choice_scenes(options.cases), {}};
  Progress progress("model-choice", data.scenes.size() + 1, options.progress);
  for (ChoiceScene& scene : data.scenes) {
    progress.step(scene.name);
    ModelChoice(options, scene).run();
  }
  progress.step("random scenes");
  data.random = random_choices(options.quick ? solved_quickly : random_scenes_chosen_for, options.progress);
  if (options.quick) add_random_choices(options.committed / "model_choice" / random_file, data.random);
  std::map<std::string, std::string> files = model_choice_tables(data);
  files["smallest.svg"] = model_choice_picture(data);
  files["README.md"] = model_choice_page(data, options.pages / "model_choice" / "page.md");
  files[answers_file] = answers_json(model_choice_answers(data));
  write_results(options.output / "model_choice", "fam-studies model-choice", files);
}

}  // namespace studies
