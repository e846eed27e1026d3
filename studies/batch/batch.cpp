// fam-studies batch: rods of seven kinds, 4096 rows of random loads each, by fam::solve_batch on every vector unit of
// the machine and by a kept Solver, one by one; the exact reference judges every 128th row.
#include "studies/batch/rods.h"
#include "studies/methods/registry.h"
#include "studies/report/provenance.h"
#include "studies/scenes/cases.h"
#include "studies/study.h"

#include <cmath>

namespace studies {
namespace {

constexpr Eigen::Index batch_rows = 4096, judged_every = 128;
constexpr int most_arcs = 64;

// One case.
class BatchRun {
 public:
  BatchRun(const StudyOptions& options, const BatchCase& rods)
      : options_(options), scene_(read_case(options.cases, rods.scene)), rods_(rods) {
    outcome_.rods = rods;
    outcome_.length_mm = length_mm(scene_);
    outcome_.rows = batch_rows;
    values_ = random_rows(scene_, rods, batch_rows);
  }

  BatchOutcome run() {
    sample();
    outcome_.arcs = fewest_arcs();
    choose();
    compare();
    measure_ways();
    measure_units();
    measure_threads();
    return outcome_;
  }

 private:
  fam::Options asked(BatchWays way) const {
    return batch_options(rods_, way == arcs_chosen ? 0 : outcome_.arcs, way == with_estimate || way == arcs_chosen);
  }
  fam::BatchResult solved(const BatchValues& values, const fam::Options& options) const {
    return fam::solve_batch(scene_, rods_.columns, values, options);
  }

  void sample() {
    Request request;
    request.model = rods_.model;
    const auto exact = method_row("exact")(request);
    for (Eigen::Index row = 0; row < batch_rows; row += judged_every) {
      const Eigen::RowVectorXd values = values_.row(row);
      scene::Scene scene = scene_;
      set_row(scene, rods_, values_, row);
      const scene::Equilibrium equilibrium = exact->solve(scene);
      Eigen::Vector3d tip_mm = Eigen::Vector3d::Constant(NAN);
      if (equilibrium.converged()) tip_mm = equilibrium.tip().position_B_mm;
      outcome_.samples.push_back({row, {values.begin(), values.end()}, tip_mm, tip_mm, tip_mm});
    }
  }

  int fewest_arcs() {
    fam::RowMajorMatrix values(static_cast<Eigen::Index>(outcome_.samples.size()), values_.cols());
    for (Eigen::Index k = 0; k < values.rows(); ++k) values.row(k) = values_.row(k * judged_every);
    for (int arcs = 1; arcs < most_arcs; ++arcs) {
      const fam::BatchResult result = solved(values, batch_options(rods_, arcs, false));
      for (Eigen::Index k = 0; k < values.rows(); ++k)
        outcome_.samples[static_cast<std::size_t>(k)].tip_mm = result.position_mm.row(k);
      if (outcome_.judged() > 0 && outcome_.largest_error_mm() < rods_.aim_mm) return arcs;
    }
    return most_arcs;
  }

  void choose() {
    const UnitOutcome chosen = solve_on_unit(fam::lane_units().front(), scene_, rods_, values_, asked(arcs_chosen));
    outcome_.converged_of_chosen = converged_rows(chosen.result);
    outcome_.in_lanes_of_chosen = chosen.in_lanes;
    for (BatchSample& sample : outcome_.samples) sample.tip_of_chosen_mm = chosen.result.position_mm.row(sample.row);
  }

  // Every unit and the Solver against the widest.
  void compare() {
    const double allowed_mm = batch_agreement * outcome_.length_mm;
    const fam::Options options = asked(arcs_given);
    const UnitOutcome widest = solve_on_unit(fam::lane_units().front(), scene_, rods_, values_, options);
    outcome_.converged = converged_rows(widest.result);
    outcome_.in_lanes = widest.in_lanes;
    outcome_.same_on_units = true;
    for (const fam::LaneUnit& unit : fam::lane_units().subspan(1)) {
      const UnitOutcome other = solve_on_unit(unit, scene_, rods_, values_, options);
      outcome_.same_on_units &= largest_difference_mm(widest.result, other.result) < allowed_mm;
    }
    outcome_.as_solver =
        largest_difference_mm(widest.result, solve_one_by_one(scene_, rods_, values_, options)) < allowed_mm;
  }

  // --quick: of an eighth of the rows.
  BatchValues timed_values() const { return values_.topRows(outcome_.timed_rows); }
  Timing time(const std::function<void()>& work) const { return time_of(options_, work, 0.2); }

  void measure_ways() {
    outcome_.timed_rows = options_.quick ? batch_rows / 8 : batch_rows;
    const BatchValues values = timed_values();
    for (const BatchWays way : {arcs_given, with_estimate, arcs_chosen, one_by_one}) {
      const fam::Options options = asked(way);
      outcome_.times[way] = time([&] {
        if (way == one_by_one) solve_one_by_one(scene_, rods_, values, options);
        else solved(values, options);
      });
    }
  }

  void measure_units() {
    const BatchValues values = timed_values();
    const fam::Options options = asked(arcs_given);
    for (const fam::LaneUnit& unit : fam::lane_units()) {
      outcome_.unit_times.emplace_back(unit.name, time([&] { solve_on_unit(unit, scene_, rods_, values, options); }));
    }
  }

  // Of rods in lanes so many rows that threads have something to do.
  void measure_threads() {
    const bool short_work = !options_.quick && 2 * outcome_.in_lanes > outcome_.rows;
    const fam::RowMajorMatrix values = timed_values().replicate(short_work ? 16 : 1, 1);
    outcome_.shared_rows = values.rows();
    fam::Options options = asked(arcs_given);
    outcome_.one_thread = time([&] { solved(values, options); });
    options.threads = 2;
    outcome_.two_threads = time([&] { solved(values, options); });
  }

  const StudyOptions& options_;
  scene::Scene scene_;
  const BatchCase& rods_;
  fam::RowMajorMatrix values_;
  BatchOutcome outcome_;
};

}  // namespace

void batch(const StudyOptions& options) {
  Progress progress("batch", batch_cases().size(), options.progress);
  BatchData data;
  for (const BatchCase& rods : batch_cases()) {
    progress.step(rods.key);
    data.push_back(BatchRun(options, rods).run());
  }
  std::map<std::string, std::string> files = {{"accuracy.csv", batch_accuracy_csv(data)},
                                              {"samples.csv", batch_samples_csv(data)},
                                              {"timing.csv", batch_times_csv(data)},
                                              {"timing_rods.svg", batch_picture(data)}};
  files.merge(batch_pages(data, options.pages / "batch" / "page.md"));
  write_results(options.output / "batch", "fam-studies batch", files);
}

}  // namespace studies
