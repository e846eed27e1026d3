// What the stability maps found, and their tables, pictures and page as pure functions of it.
#pragma once

#include "studies/compare/verdict.h"
#include "studies/stability/maps.h"

#include <map>
#include <string>
#include <vector>

namespace studies {

struct StabilityCell {
  std::string map, method;
  double x, y;
  int cells;  // arcs or elements; 0: automatic
  Judgement judgement;
  std::string status, message;  // of the method
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
  std::vector<Sensitivity> sensitivities;
  std::vector<BreakingScene> breaking;

  // Null where the method was not asked.
  const StabilityCell* find(const std::string& map, const std::string& method, double x, double y) const;
};

std::string axis_text(double value);  // "0.01", "1e-08"

// Fewest arcs or elements of a column from which on every finer row is right; null: none.
const StabilityCell* coarsest_right(const StabilityData& data, const StabilityMap& map, const std::string& method,
                                    double x);

std::string mechanism(const std::string& map);            // one sentence
std::string mechanism_checks(const StabilityData& data);  // Markdown table: what was said, what was measured

std::map<std::string, std::string> stability_tables(const StabilityData& data);
std::map<std::string, std::string> stability_pictures(const StabilityData& data);
std::string stability_page(const StabilityData& data);
std::string stability_headline(const StabilityData& data);

}  // namespace studies
