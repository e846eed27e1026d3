// What the segmentation sweep solved, and its tables, pictures and pages as pure functions of it.
#pragma once

#include "studies/compare/stopwatch.h"
#include "studies/report/error_text.h"

#include <Eigen/Core>

#include <map>
#include <string>
#include <vector>

namespace studies {

// law: published, midpoint, fourth_order, sixth_order (Kirchhoff rods), fourth_order_reissner (with shear and stretch).
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

struct SweepTime {
  std::string law;
  int arcs;
  Timing timing;
};

struct SegmentationData {
  std::vector<SweepPoint> points;
  std::vector<SweepReference> references;
  std::vector<Budget> budgets;
  std::vector<SweepShape> shapes;
  std::vector<SweepTime> times;

  // Null where it was not solved.
  const SweepPoint* find(const std::string& load_case, const std::string& law, int arcs) const;
  const SweepReference& reference(const std::string& load_case) const;
  std::vector<SweepPoint> curve(const std::string& load_case, const std::string& law) const;
};

// File name to content: CSV files and pictures; the pages.
std::map<std::string, std::string> segmentation_tables(const SegmentationData& data);
std::map<std::string, std::string> segmentation_pictures(const SegmentationData& data);
std::string segmentation_page(const SegmentationData& data);
std::string segmentation_headline(const SegmentationData& data);
std::string segmentation_timing_page(const SegmentationData& data);

}  // namespace studies
