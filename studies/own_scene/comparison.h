// `fam-studies compare`: a scene by several methods, each beside the most accurate one; or somebody's own centreline.
#pragma once

#include "scene/equilibrium.h"
#include "studies/compare/error_measures.h"
#include "studies/own_scene/centreline_file.h"
#include "studies/report/svg.h"

#include <map>
#include <optional>

namespace studies {

// One method's answer.
struct ComparedMethod {
  std::string key;   // as --methods spells it
  std::string name;  // as pages write it
  Style style;
  std::string model;  // that was used or chosen, in words
  scene::Equilibrium result;
  double time_us = 0;  // of converged answers
  // From the most accurate answer, at the stations that both have; empty where there is none, and of itself.
  std::vector<Distance> distances;
};

// A centreline of somebody's own beside the most accurate answer at the same arc lengths.
struct ComparedFile {
  std::string source;
  std::vector<CentrelinePoint> points;
  std::vector<Distance> distances;
  std::string failure;  // why there is nothing to compare with; else empty
};

struct Comparison {
  std::string source;
  scene::Scene scene;
  std::vector<ComparedMethod> methods;
  // Index of the most accurate answer: of `exact`, else that of the smallest estimate, the published law's (whose
  // estimate knows nothing of shear) after all others.
  std::optional<std::size_t> reference;
  std::optional<ComparedFile> file;

  const ComparedMethod* truth() const { return reference ? &methods[*reference] : nullptr; }
};

// Keys that --methods takes, in the order of its default, then the others.
const std::vector<std::string>& compared_methods();
constexpr std::size_t compared_by_default = 4;

Comparison compare(const std::string& source, const scene::Scene& scene, const std::vector<std::string>& methods);

// Solves the scene again by the most accurate method, cut at the file's places.
void compare_file(Comparison& comparison, const std::string& source, const std::vector<CentrelinePoint>& points);

// A line for each answer farther than gate_mm from the most accurate one, or not converged though supported; of the
// file alone where there is one.
std::vector<std::string> gate_failures(const Comparison& comparison, double gate_mm);

// compare.md, compare.csv, compare.json, compare.svg. gate_mm 0: none.
std::map<std::string, std::string> comparison_files(const std::vector<Comparison>& comparisons, double gate_mm);
std::string comparison_table(const Comparison& comparison);  // Markdown
std::string comparison_picture(const std::vector<Comparison>& comparisons, double gate_mm);

}  // namespace studies
