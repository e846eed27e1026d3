// What the stability maps found, and their tables, pictures and page as pure functions of it.
#pragma once

#include "studies/compare/verdict.h"
#include "studies/report/page.h"
#include "studies/stability/maps.h"

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace studies {

struct StabilityCell {
  std::string map, method;  // method: the contender's key
  double x, y;
  int cells;  // arcs or elements; 0: automatic
  Judgement judgement;
  std::string status, message;  // of the method
  std::optional<bool> stable;   // as the method says
};

// Of a map's scene whose loads have an energy: the unstable directions of the exact equilibrium; empty: it is neutral.
struct ExactIndex {
  std::string map;
  double x, y;
  std::optional<int> falling;
};

// How far the exact reference and what checks it lie apart, over L, in the worst cell of a map.
struct ReferenceCheck {
  std::string map;
  int scenes, by_closed_form, by_march, unchecked, unsolved;
  double largest_difference;
};

// The growth of a change of the tip's direction along the rod, against exp(w), w = sqrt(|F| L^2/EI).
struct Sensitivity {
  double load, growth;
};

// The scene of the smallest cell in which a method fails, kept as a file.
struct BreakingScene {
  std::string name, place, command;
  StabilityCell cell;
  scene::Scene scene;
};

struct StabilityData {
  std::vector<StabilityMap> maps;
  std::vector<std::string> methods;
  std::vector<StabilityCell> cells;
  std::vector<ReferenceCheck> checks;
  std::vector<ExactIndex> indices;
  std::vector<Sensitivity> sensitivities;
  std::vector<BreakingScene> breaking;

  // Null where the method was not asked.
  const StabilityCell* find(const std::string& map, const std::string& method, double x, double y) const;
  std::vector<const StabilityCell*> find_all(const std::string& map, const std::string& method) const;
  // Null where there is none; of maps that say how many arcs y is not looked at.
  const ExactIndex* index_at(const StabilityMap& map, double x, double y) const;
  const StabilityMap& map_named(const std::string& name) const;
  int count(const std::string& method, const std::function<bool(Verdict)>& is) const;
};

std::string axis_text(double value);  // "0.01", "1e-08"

// Fewest arcs or elements of a column from which on every finer row is right; null: none.
const StabilityCell* coarsest_right(const StabilityData& data, const StabilityMap& map, const std::string& method,
                                    double x);

// File name to content.
std::map<std::string, std::string> stability_tables(const StabilityData& data);
std::map<std::string, std::string> stability_pictures(const StabilityData& data);

// Tables of the page, in Markdown.
std::string failures_table(const StabilityData& data);  // a line a load number: what fails, what to take instead
std::string counts_table(const StabilityData& data);
std::string growth_table(const StabilityData& data);
std::string breaking_table(const StabilityData& data);

// Measured mechanisms, as the page words them.
std::string growth_of_right_cells(const StabilityData& data, const std::string& map);
std::string turns_of_elements(const StabilityData& data);
std::string errors_over_slenderness(const StabilityData& data, const std::string& method);
std::string error_over_arcs(const StabilityData& data, const std::string& method);
bool exact_for_circles(const StabilityData& data);
bool straight_stays_straight(const StabilityData& data);

// "138 of 139 (not FE at 180, 2.48)": right answers that say whether they are stable, and how many of them say so as
// the exact index does.
std::string stable_as_exact(const StabilityData& data);
// "direction 10": the maps' scenes whose exact answer is unstable.
std::string unstable_by_map(const StabilityData& data);
std::string where_each_fails(const StabilityData& data);  // one line: wrong and silent, of solves, by method
std::string silent_by_map(const StabilityData& data);     // one line; empty: no silent answer
std::string stability_page(const StabilityData& data, const std::filesystem::path& page_md);
Answers stability_answers(const StabilityData& data);

}  // namespace studies
