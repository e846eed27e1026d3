// The tables of the page.
#include "studies/compare/error_measures.h"
#include "studies/model_choice/data.h"
#include "studies/report/table.h"
#include "studies/scenes/random_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace studies {
namespace {

std::vector<std::string> head_of_accuracies(const std::string& first) {
  std::vector<std::string> head{first};
  for (const double tolerance : choice_tolerances) head.push_back(scientific(tolerance, 0) + " L");
  return head;
}

// A row with a cell for each accuracy, of the choices of a group's scenes ("": all).
using CellOf = std::function<std::string(const std::vector<std::pair<const ChoiceScene*, const ChosenModel*>>&)>;
void add_row(Table& table, const ModelChoiceData& data, const std::string& group, const std::string& name,
             const CellOf& cell) {
  std::vector<std::string> cells{name};
  for (std::size_t i = 0; i < choice_tolerances.size(); ++i) {
    std::vector<std::pair<const ChoiceScene*, const ChosenModel*>> choices;
    for (const ChoiceScene* scene : data.of(group)) choices.push_back({scene, &scene->chosen[i]});
    cells.push_back(cell(choices));
  }
  table.add(std::move(cells));
}

std::string of_all(std::ptrdiff_t count, std::size_t all) {
  return fmt::format("{} of {}", count, all);
}

std::string share_there(std::size_t there, std::size_t all) {
  return there == all || there == 0 ? "" : fmt::format(" [{}/{}]", there, all);
}

// "3 (1 … 8)": median, least and largest; those that are there of all where these are not all.
std::string median_and_range(std::vector<double> values, std::size_t all) {
  if (values.empty()) return "–";
  const auto [least, largest] = std::minmax_element(values.begin(), values.end());
  return fmt::format("{:g} ({:g} … {:g}){}", quantile(values, 0.5), *least, *largest, share_there(values.size(), all));
}

template <class Value>
CellOf range_of(Value value) {
  return [value](const auto& choices) {
    std::vector<double> values;
    for (const auto& [scene, choice] : choices) {
      if (const double v = value(*scene, *choice); v > 0) values.push_back(v);
    }
    return median_and_range(std::move(values), choices.size());
  };
}

template <class Holds>
CellOf share_of(Holds holds) {
  return [holds](const auto& choices) {
    return of_all(
        std::count_if(choices.begin(), choices.end(), [&](const auto& c) { return holds(*c.first, *c.second); }),
        choices.size());
  };
}

template <class Value>
CellOf times_of(Value value) {
  return [value](const auto& choices) {
    std::vector<double> values;
    for (const auto& [scene, choice] : choices) {
      if (const double v = value(*scene, *choice); v > 0) values.push_back(v);
    }
    return median_and_quartiles(values, 3) + share_there(values.size(), choices.size());
  };
}

double rung_time_us(const Rung* rung) {
  return rung != nullptr && rung->time ? rung->time->median_us : 0;
}

// The bare kernel of the smallest sufficient model of the ladder.
double smallest_time_us(const ChoiceScene& scene, const ChosenModel& choice) {
  for (const std::vector<Rung>& ladder : scene.ladders) {
    const ModelSize& model = ladder.front().model;
    const bool as_chosen = !model.finite_elements && model.space == choice.rung.model.space &&
                           model.march == choice.rung.model.march && model.shear == choice.shear_needed;
    if (as_chosen) return rung_time_us(smallest_sufficient(ladder, choice.tolerance));
  }
  return 0;
}

std::string model_text(const ModelSize& model) {
  return fmt::format("{}, {}, {}, {}", model.dimension(), model.rod(), model.solver(), model.resolution());
}

}  // namespace

std::string median_and_quartiles(const std::vector<double>& values, int digits) {
  if (values.empty()) return "–";
  return fmt::format("{} ({} … {})", significant(quantile(values, 0.5), digits),
                     significant(quantile(values, 0.25), digits), significant(quantile(values, 0.75), digits));
}

std::string smallest_table(const ModelChoiceData& data) {
  Table table(head_of_accuracies("within"));
  for (const std::string& group : data.groups()) {
    const auto add = [&](const std::string& name, const CellOf& cell) {
      add_row(table, data, group, group + ": " + name, cell);
    };
    add("no shear needed", share_of([](const auto&, const auto& c) { return c.fewest_arcs > 0 && !c.shear_needed; }));
    add("no shear chosen",
        share_of([](const auto&, const auto& c) { return c.rung.status == "converged" && !c.rung.model.shear; }));
    add("fewest arcs", range_of([](const auto&, const auto& c) { return c.fewest_arcs; }));
    add("arcs chosen", range_of([](const auto&, const auto& c) { return c.rung.model.count; }));
    add("fewest finite elements", range_of([](const auto& scene, const auto& c) {
          const Rung* rung = scene.smallest_elements(c.tolerance);
          return rung == nullptr ? 0 : rung->model.count;
        }));
  }
  return table.markdown();
}

std::string choice_times_table(const ModelChoiceData& data) {
  Table table(head_of_accuracies("µs"));
  for (const std::string& group : data.groups()) {
    const auto add = [&](const std::string& name, const CellOf& cell) {
      add_row(table, data, group, group + ": " + name, cell);
    };
    add("`fam solve`", times_of([](const auto&, const auto& c) { return rung_time_us(&c.rung); }));
    add("smallest sufficient arcs, known beforehand", times_of(smallest_time_us));
    add("fewest sufficient elements",
        times_of([](const auto& scene, const auto& c) { return rung_time_us(scene.smallest_elements(c.tolerance)); }));
  }
  return table.markdown();
}

std::string less_table(const ModelChoiceData& data) {
  Table table(head_of_accuracies("error over the tolerance"));
  const auto error_of = [](const auto& rung_of) {
    return [rung_of](const auto& choices) {
      std::vector<double> ratios;
      std::size_t all = 0, insufficient = 0;
      for (const auto& [scene, choice] : choices) {
        const Rung* rung = rung_of(*choice);
        if (rung == nullptr) continue;
        ++all;
        insufficient += !rung->suffices(choice->tolerance);
        if (std::isfinite(rung->error)) ratios.push_back(rung->error / choice->tolerance);
      }
      if (ratios.empty()) return std::string("–");
      return fmt::format("{} [{} of {} > 1]", significant(quantile(ratios, 0.5), 2), insufficient, all);
    };
  };
  add_row(table, data, "", "as chosen", error_of([](const ChosenModel& c) { return &c.rung; }));
  for (const std::string& what : neighbour::less) {
    add_row(table, data, "", what, error_of([what](const ChosenModel& c) { return c.beside(what); }));
  }
  return table.markdown();
}

std::string more_table(const ModelChoiceData& data) {
  Table table(head_of_accuracies("time over the chosen model's"));
  for (const std::string& what : neighbour::more) {
    add_row(table, data, "", what, times_of([what](const auto&, const ChosenModel& c) {
              const double chosen_us = rung_time_us(c.beside(neighbour::same));
              return chosen_us > 0 ? rung_time_us(c.beside(what)) / chosen_us : 0;
            }));
  }
  return table.markdown();
}

std::string robots_table(const ModelChoiceData& data, double tolerance) {
  Table table({"robot", "`fam solve` takes", "error", "fewest that do", "half the arcs: error", "without shear: error",
               "elements that do"});
  for (const ChoiceScene* scene : data.of("robots")) {
    for (const ChosenModel& c : scene->chosen) {
      if (c.tolerance != tolerance) continue;
      const auto error = [&](const std::string& what) {
        const Rung* rung = c.beside(what);
        return rung == nullptr ? "" : std::isfinite(rung->error) ? rung_error(*rung) : rung->status;
      };
      const Rung* elements = scene->smallest_elements(tolerance);
      const std::string fewest =
          c.fewest_arcs == 0 ? "–" : fmt::format("{}, {}", c.shear_needed ? "shear" : "no shear", c.fewest_arcs);
      table.add({scene->name, model_text(c.rung.model), rung_error(c.rung), fewest, error(neighbour::half),
                 error(neighbour::without_shear), elements == nullptr ? "–" : std::to_string(elements->model.count)});
    }
  }
  return table.markdown();
}

std::string random_choices_table(const ModelChoiceData& data) {
  Table table({"kind", "scenes", "solved and judged", "not within", "space, of them needed", "shear, of them needed",
               "arcs looked for", "another law, fewer arcs", "arcs over fewest", "≤ 1", "≤ 2", "≤ 4",
               "smallest in all"});
  std::vector<std::string> kinds{"general", "buckling"};
  kinds.insert(kinds.end(), families.begin(), families.end());
  kinds.push_back("");
  for (const std::string& kind : kinds) {
    const RandomCounts c = count_choices(data.random, kind);
    const auto share = [&](int count) {
      return c.ratios.empty() ? "–" : fixed(100.0 * count / static_cast<double>(c.ratios.size()), 1) + " %";
    };
    table.add({kind.empty() ? "all" : kind, std::to_string(c.scenes), std::to_string(c.judged),
               std::to_string(c.insufficient), fmt::format("{}, {}", c.space, c.space_needed),
               fmt::format("{}, {}", c.shear, c.shear_needed), std::to_string(c.looked_for),
               std::to_string(c.other_law), median_and_quartiles(c.ratios, 2), share(c.within_1), share(c.within_2),
               share(c.within_4), fixed(100.0 * c.smallest / std::max(c.looked_for, 1), 1) + " %"});
  }
  return table.markdown();
}

}  // namespace studies
