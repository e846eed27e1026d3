#include "studies/report/table.h"

#include "studies/compare/error_measures.h"
#include "studies/compare/timing_cells.h"
#include "studies/model_choice/data.h"
#include "studies/report/provenance.h"
#include "studies/scenes/random_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace studies {
namespace {

std::vector<std::string> model_cells(const ModelSize& model) {
  return {model.finite_elements ? "finite elements" : "fam", model.dimension(), model.rod(), model.solver(),
          std::to_string(model.count)};
}

const std::vector<std::string> model_columns = {"method", "dimension", "rod", "solver", "cells"};

std::vector<std::string> joined(std::vector<std::string> a, const std::vector<std::string>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

// The accuracies for which the rung is the smallest sufficient of its ladder.
std::string smallest_for(const std::vector<Rung>& ladder, const Rung& rung) {
  std::string list;
  for (const double tolerance : choice_tolerances) {
    if (smallest_sufficient(ladder, tolerance) != &rung) continue;
    list += (list.empty() ? "" : " ") + scientific(tolerance, 0);
  }
  return list;
}

std::string ladder_csv(const ModelChoiceData& data) {
  Table table(joined(joined({"scene"}, model_columns), {"status", "error_over_L", "smallest_sufficient_for"}));
  for (const ChoiceScene& scene : data.scenes) {
    for (const std::vector<Rung>& ladder : scene.ladders) {
      for (const Rung& rung : ladder) {
        table.add(joined(joined({scene.name}, model_cells(rung.model)),
                         {rung.status, rung_error(rung), smallest_for(ladder, rung)}));
      }
    }
  }
  return table.csv(
      {"Largest error of any place along the rod, against the exact rod with shear and stretch, over L; "
       "below 1e-12 written as that.",
       "cells: arcs of sixth order, at least one a span, shared out by length; or quadratic elements.",
       "smallest_sufficient_for: of this model it and all finer ones are within these errors."});
}

std::string chosen_csv(const ModelChoiceData& data) {
  Table table(joined(joined({"scene", "tolerance_over_L", "status"}, model_columns),
                     {"error_over_L", "shear_needed", "fewest_arcs", "fewest_arcs_as_chosen"}));
  for (const ChoiceScene& scene : data.scenes) {
    for (const ChosenModel& c : scene.chosen) {
      table.add(joined(joined({scene.name, scientific(c.tolerance, 0), c.rung.status}, model_cells(c.rung.model)),
                       {rung_error(c.rung), c.shear_needed ? "1" : "0", std::to_string(c.fewest_arcs),
                        std::to_string(c.fewest_arcs_as_chosen)}));
    }
  }
  return table.csv(
      {"What fam solve takes for a tolerance; shear_needed: no number of arcs does without (1 ... 1024 "
       "tried); fewest_arcs: of the smallest sufficient rod; 0: none."});
}

std::string neighbours_csv(const ModelChoiceData& data) {
  Table table(joined(joined({"scene", "tolerance_over_L", "instead"}, model_columns), {"status", "error_over_L"}));
  for (const ChoiceScene& scene : data.scenes) {
    for (const ChosenModel& c : scene.chosen) {
      for (const Neighbour& n : c.neighbours) {
        table.add(joined(joined({scene.name, scientific(c.tolerance, 0), n.what}, model_cells(n.rung.model)),
                         {n.rung.status, rung_error(n.rung)}));
      }
    }
  }
  return table.csv({"The chosen model with one thing changed; arcs shared out by length."});
}

std::string ladder_times_csv(const ModelChoiceData& data) {
  Table table(with_timing_columns(joined(joined({"scene"}, model_columns), {"status"})));
  for (const ChoiceScene& scene : data.scenes) {
    for (const std::vector<Rung>& ladder : scene.ladders) {
      for (const Rung& r : ladder) {
        if (!r.time) continue;
        table.add(with_timing(joined(joined({scene.name}, model_cells(r.model)), {r.status}), *r.time, significant, 3));
      }
    }
  }
  return table.csv({machine_line(), "The bare solve, without error estimate."});
}

std::string chosen_times_csv(const ModelChoiceData& data) {
  Table table(with_timing_columns(joined({"scene", "tolerance_over_L", "instead"}, model_columns)));
  const auto add = [&](const ChoiceScene& scene, const ChosenModel& c, const std::string& what, const Rung& rung) {
    if (!rung.time) return;
    table.add(with_timing(joined({scene.name, scientific(c.tolerance, 0), what}, model_cells(rung.model)), *rung.time,
                          significant, 3));
  };
  for (const ChoiceScene& scene : data.scenes) {
    for (const ChosenModel& c : scene.chosen) {
      add(scene, c, "fam solve", c.rung);
      for (const Neighbour& n : c.neighbours) add(scene, c, n.what, n.rung);
    }
  }
  return table.csv(
      {machine_line(), "fam solve: all of it, with choice, memory and error estimate; all others: the bare solve."});
}

}  // namespace

std::string rung_error(const Rung& rung) {
  constexpr double floor = 1e-12;  // round-off
  return std::isfinite(rung.error) ? scientific(std::max(rung.error, floor), 1) : "–";
}

std::map<std::string, std::string> model_choice_tables(const ModelChoiceData& data) {
  return {{"accuracy_ladder.csv", ladder_csv(data)},         {"accuracy_chosen.csv", chosen_csv(data)},
          {"accuracy_neighbours.csv", neighbours_csv(data)}, {random_file, random_csv(data.random)},
          {"timing_ladder.csv", ladder_times_csv(data)},     {"timing_chosen.csv", chosen_times_csv(data)}};
}

}  // namespace studies
