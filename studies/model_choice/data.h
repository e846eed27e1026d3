// What the study of the model choice found; its tables, picture and page are pure functions of it.
#pragma once

#include "studies/model_choice/ladder.h"
#include "studies/model_choice/random_choice.h"
#include "studies/report/page.h"

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace studies {

inline const std::vector<double> choice_tolerances = {1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8};  // over L

// A model that differs from the chosen one in one thing.
struct Neighbour {
  std::string what;  // "half the arcs", ...
  Rung rung;
};

// What fam::solve took for a tolerance, and what would have done.
struct ChosenModel {
  double tolerance = 0;
  Rung rung;  // its time: all of fam::solve
  // The smallest sufficient model: without shear where some number of arcs does without, then the fewest arcs, shared
  // out by length. No arcs: none up to 1024 does.
  bool shear_needed = false;
  int fewest_arcs = 0;
  int fewest_arcs_as_chosen = 0;  // with shear where the choice has it
  std::vector<Neighbour> neighbours = {};

  const Rung* beside(const std::string& what) const;  // null where there is none
};

namespace neighbour {
inline const std::string same = "the same arcs, fixed", half = "half the arcs", without_shear = "without shear",
                         twice = "twice the arcs", with_shear = "with shear", in_space = "in space",
                         boundary_value = "as a boundary value problem";
inline const std::vector<std::string> less = {half, without_shear},
                                      more = {twice, with_shear, in_space, boundary_value};
}  // namespace neighbour

struct ChoiceScene {
  std::string name, group;  // group: "Study I, plane", "Study I, space", "robots"
  SceneFacts facts = {};
  std::vector<std::vector<Rung>> ladders = {};
  std::vector<ChosenModel> chosen = {};  // a row for each tolerance
  double reference_error = 0;            // the exact rod's own, over L

  // The smallest sufficient of the finite element meshes with this rod; null if none.
  const Rung* smallest_elements(double tolerance) const;
};

struct ModelChoiceData {
  std::vector<ChoiceScene> scenes;
  std::vector<RandomChoice> random;

  std::vector<std::string> groups() const;
  std::vector<const ChoiceScene*> of(const std::string& group) const;  // "": all
};

// The error over L as tables write it.
std::string rung_error(const Rung& rung);
// "1.3 (1 … 2)": median and quartiles; "–" of none.
std::string median_and_quartiles(const std::vector<double>& values, int digits);

std::map<std::string, std::string> model_choice_tables(const ModelChoiceData& data);
std::string smallest_table(const ModelChoiceData& data);
std::string choice_times_table(const ModelChoiceData& data);
std::string less_table(const ModelChoiceData& data);
std::string more_table(const ModelChoiceData& data);
std::string robots_table(const ModelChoiceData& data, double tolerance);
std::string random_choices_table(const ModelChoiceData& data);

std::string model_choice_picture(const ModelChoiceData& data);
std::string model_choice_page(const ModelChoiceData& data, const std::filesystem::path& page_md);
Answers model_choice_answers(const ModelChoiceData& data);

}  // namespace studies
