// What a thread of fam::solve_batch keeps: lanes for the rows that they can solve, a Solver for the others.
#pragma once

#include "fam/lanes.h"
#include "fam/solver.h"

#include <map>
#include <set>

namespace fam {

// For so many rods; the numbers are not set.
BatchResult room_for(Eigen::Index rods);
// New values for a load of the solver's, of the same kind.
void set_value(Solver& solver, std::size_t load, const scene::Load& value);

class BatchRows {
 public:
  // Keeps views of all.
  BatchRows(const scene::Scene& scene, std::span<const BatchColumn> columns,
            const Eigen::Ref<const RowMajorMatrix>& values, const Options& options, BatchResult& result,
            const LaneUnit& unit = lane_units().front());

  // These rows of the result, each from its row of values alone.
  void solve(Eigen::Index begin, Eigen::Index end);
  // Of those, the rows that lanes did not solve.
  std::span<const std::ptrdiff_t> left_to_solver() const { return left_; }

 private:
  // What rods must have in common to lie in lanes of one pack.
  struct Kind {
    RodModel model;
    std::vector<int> arcs_per_span;
    auto operator<=>(const Kind&) const = default;
  };
  using Rows = std::vector<std::ptrdiff_t>;

  void sort(Eigen::Index begin, Eigen::Index end);
  void solve_in_lanes(const Kind& kind, const Rows& rows);
  void solve_one_by_one(std::ptrdiff_t row);
  void solve_by_itself(std::ptrdiff_t row);
  void set_values(Eigen::Index row);
  void keep(std::ptrdiff_t row, const Eigen::Vector3d& position_mm, const Eigen::Quaterniond& rotation,
            double error_mm);

  const scene::Scene& scene_;
  std::span<const BatchColumn> columns_;
  const Eigen::Ref<const RowMajorMatrix>& values_;
  const Options& options_;
  BatchResult& result_;
  const LaneUnit& unit_;
  double tolerance_mm_, length_mm_;
  std::set<std::size_t> changing_;  // loads

  LaneProblem lanes_;
  scene::Scene row_scene_;  // with the values of a row
  Problem problem_;
  std::map<Kind, Rows> kinds_;
  std::vector<double> left_out_mm_;  // of each row, from the first of those asked for
  std::vector<LaneTip> tips_;
  std::ptrdiff_t first_row_ = 0;
  Rows left_;  // to the solver
  std::optional<std::variant<Solver, Refusal>> solver_;
};

}  // namespace fam
