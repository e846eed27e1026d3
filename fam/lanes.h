// Many rods of one kind, cut into lanes (fam/lane_rods.h).
#pragma once

#include "fam/batch.h"
#include "fam/lane_rods.h"
#include "fam/problem.h"

#include <span>
#include <vector>

namespace fam {

// Those that this processor can run, the widest first; the last is portable.
std::span<const LaneUnit> lane_units();

// A scene whose columns change.
class LaneProblem {
 public:
  // Keeps a view of the columns.
  LaneProblem(const scene::Scene& scene, std::span<const BatchColumn> columns, const Options& options);

  // Of all rows: the plane only where every value of the columns leaves the rod in it.
  const Choice& choice() const { return choice_; }
  std::span<const scene::Span> spans() const { return given_; }
  bool is_solvable(RodModel model) const;
  // Rods cut into these arcs; the last three members of LaneRods are the caller's.
  LaneRods& set(RodModel model, std::span<const int> arcs_per_span);

 private:
  bool is_planar(RodModel model) const;
  std::span<const scene::Span> spans_of(const scene::Scene& scene);
  template <int D>
  void set_spans(RodModel model, std::span<const int> arcs_per_span);

  scene::Scene scene_;  // every column 0
  std::span<const BatchColumn> columns_;
  scene::SpanCutter cutter_;
  scene::Reused<scene::Span> given_, solved_;
  Choice choice_;
  std::vector<std::vector<scene::SectionTendon>> tendons_;  // of each span, all that may pull
  int most_tendons_ = 0;
  std::vector<LaneSpan> lane_spans_;
  std::vector<LaneTerm> terms_;
  LaneRods rods_{};
};

}  // namespace fam
