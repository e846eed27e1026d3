#include "studies/report/page.h"

#include "studies/compare/error_measures.h"
#include "studies/model_choice/data.h"
#include "studies/report/provenance.h"
#include "studies/report/table.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

namespace studies {
namespace {

// Over all scenes and accuracies of the ladder.
struct LadderCounts {
  int asked = 0, insufficient = 0;
  int without_shear = 0;        // chosen without
  int needless_shear = 0;       // chosen with, none needed
  int shear = 0;                // chosen with
  int smallest = 0;             // in shear, with the fewest arcs
  int within_2 = 0;             // in shear, with at most twice the fewest arcs
  int fewer = 0;                // chosen: fewer than the fewest that are shared out by length
  double plane_from_space = 0;  // largest difference of the errors of a plane rod and one in space, over L
  std::vector<double> ratios;
};

LadderCounts ladder_counts(const ModelChoiceData& data) {
  LadderCounts counts;
  for (const ChoiceScene& scene : data.scenes) {
    for (const ChosenModel& c : scene.chosen) {
      ++counts.asked;
      if (!c.rung.suffices(c.tolerance)) {
        ++counts.insufficient;
        continue;
      }
      const bool shear = c.rung.model.shear, needless = shear && !c.shear_needed;
      ++(shear ? counts.shear : counts.without_shear);
      counts.needless_shear += needless;
      if (c.fewest_arcs_as_chosen == 0) continue;
      counts.ratios.push_back(static_cast<double>(c.rung.model.count) / c.fewest_arcs_as_chosen);
      counts.fewer += counts.ratios.back() < 1;
      if (const Rung* space = c.beside(neighbour::in_space))
        counts.plane_from_space =
            std::max(counts.plane_from_space, std::abs(space->error - c.beside(neighbour::same)->error));
      counts.smallest += !needless && counts.ratios.back() <= 1;
      counts.within_2 += !needless && counts.ratios.back() <= 2;
    }
  }
  return counts;
}

std::vector<double> chosen_arcs(const ModelChoiceData& data, double tolerance) {
  std::vector<double> arcs;
  for (const ChoiceScene& scene : data.scenes) {
    for (const ChosenModel& c : scene.chosen) {
      if (c.tolerance == tolerance && c.rung.status == "converged") arcs.push_back(c.rung.model.count);
    }
  }
  return arcs;
}

double largest_reference_error_of(const ModelChoiceData& data) {
  double largest = 0;
  for (const ChoiceScene& scene : data.scenes) largest = std::max(largest, scene.reference_error);
  return largest;
}

int in_a_plane(const ModelChoiceData& data) {
  return static_cast<int>(std::count_if(data.scenes.begin(), data.scenes.end(),
                                        [](const ChoiceScene& scene) { return scene.facts.planar; }));
}

std::string percent(int count, int all) {
  return fixed(100.0 * count / std::max(all, 1), 1) + " %";
}

void set_ladder(Page& page, const ModelChoiceData& data) {
  const LadderCounts counts = ladder_counts(data);
  page.set("scenes", std::to_string(data.scenes.size()));
  page.set("planar", std::to_string(in_a_plane(data)));
  page.set("asked", std::to_string(counts.asked));
  page.set("insufficient", std::to_string(counts.insufficient));
  page.check("sufficient", counts.insufficient == 0);
  page.set("shear", std::to_string(counts.shear));
  page.set("needless", std::to_string(counts.needless_shear));
  page.set("without_shear", std::to_string(counts.without_shear));
  page.check("plane_is_space", counts.plane_from_space < 1e-9);
  page.set("fewer", std::to_string(counts.fewer));
  page.check("some_fewer", counts.fewer > 0);
  page.set("smallest", std::to_string(counts.smallest));
  page.set("within_2", std::to_string(counts.within_2));
  page.set("ratio", median_and_quartiles(counts.ratios, 2));
  for (const auto& [name, tolerance] : {std::pair{"arcs_3", 1e-3}, {"arcs_8", 1e-8}}) {
    const std::vector<double> arcs = chosen_arcs(data, tolerance);
    page.set(name, arcs.empty() ? "–" : fmt::format("{:g}", quantile(arcs, 0.5)));
  }
  page.set("reference", for_reader(scientific(largest_reference_error_of(data), 0)));
  page.set("table_smallest", smallest_table(data));
  page.set("table_less", less_table(data));
  page.set("table_robots", robots_table(data, 1e-3));
  page.set_time("table_times", choice_times_table(data));
  page.set_time("table_more", more_table(data));
  page.set_time("machine", machine_line());
}

void set_random(Page& page, const RandomCounts& c) {
  const int ratios = static_cast<int>(c.ratios.size());
  for (const auto& [name, number] :
       std::initializer_list<std::pair<const char*, int>>{{"random", c.scenes},
                                                          {"unsolved", c.unsolved},
                                                          {"unjudged", c.unjudged},
                                                          {"judged", c.judged},
                                                          {"random_insufficient", c.insufficient},
                                                          {"by_exact", c.by_exact},
                                                          {"space", c.space},
                                                          {"space_needed", c.space_needed},
                                                          {"in_plane", c.judged - c.space},
                                                          {"gives_way", c.gives_way},
                                                          {"random_shear", c.shear},
                                                          {"shear_needed", c.shear_needed},
                                                          {"shear_left_out", c.gives_way - c.shear},
                                                          {"other_law", c.other_law},
                                                          {"looked_for", c.looked_for},
                                                          {"counted", ratios},
                                                          {"sampled", c.sampled},
                                                          {"sampled_insufficient", c.sampled_insufficient},
                                                          {"disagreed", c.disagreed},
                                                          {"random_smallest", c.smallest}}) {
    page.set(name, std::to_string(number));
  }
  page.set("random_ratio", median_and_quartiles(c.ratios, 2));
  page.set("within_1_share", percent(c.within_1, ratios));
  page.set("within_2_share", percent(c.within_2, ratios));
  page.set("within_4_share", percent(c.within_4, ratios));
  page.set("smallest_share", percent(c.smallest, c.looked_for));
  page.check("judges_agree", c.disagreed == 0);
}

}  // namespace

std::string model_choice_page(const ModelChoiceData& data, const std::filesystem::path& page_md) {
  Page page;
  set_ladder(page, data);
  set_random(page, count_choices(data.random, ""));
  page.set("exact_every", std::to_string(exact_every));
  page.set("table_random", random_choices_table(data));
  return page.fill(page_md);
}

Answers model_choice_answers(const ModelChoiceData& data) {
  const LadderCounts ladder = ladder_counts(data);
  const RandomCounts random = count_choices(data.random, "");
  const std::string answer = fmt::format(
      "on {} of {} (scenes, accuracies) its model is within the accuracy, with {} times the fewest arcs that are "
      "(median, quartiles); of {} random scenes {} are not within it, and on at least {} of {} it is the smallest in "
      "dimension, "
      "shear and law with at most twice the fewest arcs",
      ladder.asked - ladder.insufficient, ladder.asked, median_and_quartiles(ladder.ratios, 2), random.judged,
      random.insufficient, random.smallest, random.looked_for);
  return {{"choice", for_reader(answer)}};
}

}  // namespace studies
