// What the segmentation sweep solved, and its tables, pictures and page as pure functions of it.
#pragma once

#include "studies/compare/stopwatch.h"
#include "studies/methods/registry.h"

#include "exact_reference/elastica.h"
#include "fam/arc_law.h"

#include <Eigen/Core>

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace studies {

// A law as this study's files spell it; of fourth_order_reissner the arcs shear and stretch.
struct SweepLaw {
  std::string key;
  const MethodRow& row;
  fam::Law law;
  scene::RodModel model;

  bool shears() const { return model == scene::RodModel::reissner; }
  Request with(int arcs) const;
  std::string label() const;
};
const std::vector<SweepLaw>& sweep_laws();
const SweepLaw& sweep_law(const std::string& key);
std::vector<SweepLaw> kirchhoff_laws();  // without fourth_order_reissner

struct SweepPoint {
  std::string load_case, law;
  int arcs;
  double exact_mm;  // tip error against the exact solution of the law's own rod model
  double fe_mm;     // against finite elements with shear and stretch
};

struct SweepReference {
  std::string load_case;
  double exact_estimate_mm, fe_estimate_mm;  // what the references claim of themselves
  double shear_mm;                           // tip of the exact Reissner rod - exact Kirchhoff rod
  double frame_mm;                           // finite elements: the same components fixed - follower
};

// Fewest arcs such that they, and all finer divisions that were tried, keep the tip within the limit of the exact
// Kirchhoff rod; 0: more than most_arcs_tried. law fam: as many as the automatic choice takes at that tolerance.
struct FewestArcs {
  std::string load_case, law;
  double limit_mm;
  int arcs;
};
constexpr int most_arcs_tried = 100'000;
inline const std::vector<double> arc_limits_mm = {1, 0.1, 0.04, 0.01, 0.001};

// Largest |F| L^2/EI such that it and every smaller one stays under the limit.
struct Budget {
  std::string load, law;  // load: P4 scaled, transverse force
  int arcs;
  double limit_mm;
  double largest_load;
  bool beyond;  // never reached up to budget_load_max
};
constexpr double budget_load_max = 100;

struct SweepShape {
  std::string name;  // "1 arc", ..., "exact"
  std::vector<Eigen::Vector3d> positions_mm;
};

// law fam: all of fam::solve, its automatic choice included (arcs 0); else the march alone.
struct SweepTime {
  std::string load_case, law;
  int arcs;
  Timing timing;
};

struct SegmentationData {
  exact_reference::PlanarCantilever p4;  // rod and follower load of P4
  std::vector<SweepPoint> points;
  std::vector<SweepReference> references;
  std::vector<FewestArcs> fewest;
  std::vector<Budget> budgets;
  std::vector<SweepShape> shapes;
  std::vector<SweepTime> times;

  // Null where it was not solved.
  const SweepPoint* find(const std::string& load_case, const std::string& law, int arcs) const;
  const SweepReference& reference(const std::string& load_case) const;
  std::vector<SweepPoint> curve(const std::string& load_case, const std::string& law) const;
  // Of the planar or the spatial cases, a number each; 0 as it stands in FewestArcs.
  std::vector<int> fewest_arcs(const std::string& law, bool planar, double limit_mm) const;
};

// File name to content: CSV files, pictures, page and answers.
std::map<std::string, std::string> segmentation_tables(const SegmentationData& data);
std::map<std::string, std::string> segmentation_pictures(const SegmentationData& data);
std::map<std::string, std::string> segmentation_pages(const SegmentationData& data,
                                                      const std::filesystem::path& page_md);

// Tables of the page, and a cell of the first: "3 to 5" arcs from the easiest to the hardest case.
std::string arcs_table(const SegmentationData& data);
std::string arcs_cell(const SegmentationData& data, const std::string& law, bool planar, double limit_mm);
std::string sweep_table(const SegmentationData& data);
std::string times_table(const SegmentationData& data);

}  // namespace studies
