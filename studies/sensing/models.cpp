#include "studies/sensing/models.h"

#include "exact_reference/solve.h"
#include "fam/estimator.h"
#include "fam/solve.h"
#include "studies/compare/stopwatch.h"
#include "studies/scenes/sensing_problem.h"

#include <fmt/format.h>
#include <Eigen/Dense>

#include <algorithm>
#include <cmath>

namespace studies {
namespace {

using Eigen::Vector3d;

// --- Other starts ----------------------------------------------------------------------------------------------------

constexpr int start_truths = 20, starts_each = 12;
constexpr double widest_start = 2;     // EI/L^2, each component
constexpr double same_minimum = 1e-2;  // of 1 + chi-squared
constexpr double L_mm = 40, EI_Nmm2 = 1500, GJ_Nmm2 = 1000;

struct Starts {
  int all = 0, none = 0, unobservable = 0, lowest = 0, seen = 0, unseen = 0;
};

void scatter(scene::EstimationProblem& problem, Noise& random) {
  for (scene::Unknown& unknown : problem.unknowns) {
    const bool is_place = unknown.kind == scene::Unknown::Kind::place;
    unknown.prior_mean = is_place ? L_mm * random.uniform(0.05, 0.95)
                                  : EI_Nmm2 / (L_mm * L_mm) * random.uniform(-widest_start, widest_start);
    scene::put(problem, unknown, unknown.prior_mean);
  }
}

void add_starts(Starts& sum, scene::EstimationProblem problem, std::uint64_t seed) {
  Noise random(3'000'000 + seed);
  for (scene::Measurement& measurement : problem.scenes[0].measurements) measurement = noisy(measurement, random);
  std::vector<fam::Estimate> found;
  for (int i = 0; i < starts_each; ++i) {
    scatter(problem, random);
    found.push_back(fam::Estimator(problem).estimate());
  }
  double lowest = HUGE_VAL;
  for (const fam::Estimate& estimate : found)
    if (estimate.converged()) lowest = std::min(lowest, estimate.chi_squared);
  for (const fam::Estimate& estimate : found) {
    ++sum.all;
    if (!estimate.converged()) ++sum.none;
    else if (!estimate.unobservable.empty()) ++sum.unobservable;
    else if (estimate.chi_squared <= lowest + same_minimum * (1 + lowest)) ++sum.lowest;
    else ++(estimate.fits ? sum.unseen : sum.seen);
  }
}

// --- The laws --------------------------------------------------------------------------------------------------------

constexpr int law_truths = 20;
constexpr double places[] = {0.25, 0.5, 0.75, 1};

scene::Scene rod_under(const Vector3d& force_S_N) {
  scene::Stiffness stiffness;
  stiffness.bending_Nmm2.setConstant(EI_Nmm2);
  stiffness.torsion_Nmm2 = GJ_Nmm2;
  scene::Scene scene;
  scene.sections = {{L_mm, stiffness, Vector3d::Zero()}};
  scene.loads = {scene::Force{L_mm, scene::Frame::follower, force_S_N}};
  return scene;
}

using Positions = Eigen::Matrix<double, 12, 1>;

Positions positions_of(const scene::Equilibrium& answer) {
  Positions all;
  for (std::size_t k = 0; k < std::size(places); ++k) {
    const auto& station = *std::min_element(answer.stations.begin(), answer.stations.end(), [&](auto& a, auto& b) {
      return std::abs(a.s_mm - places[k] * L_mm) < std::abs(b.s_mm - places[k] * L_mm);
    });
    all.segment<3>(3 * static_cast<Eigen::Index>(k)) = station.X_BS.position_B_mm;
  }
  return all;
}

Positions modelled(const Vector3d& force_S_N, fam::Law law, int arcs) {
  fam::Options options;
  options.law = law;
  options.arcs = arcs;
  options.model = fam::RodModel::kirchhoff;
  options.estimate_error = false;
  return positions_of(fam::solve(rod_under(force_S_N), options));
}

// Gauss-Newton by central differences from the truth: how far the law's own minimum is from it.
Vector3d force_S_N_by(const Positions& measured_mm, const Vector3d& start_S_N, fam::Law law, int arcs) {
  constexpr double step_N = 1e-5;
  Vector3d force_S_N = start_S_N;
  for (int i = 0; i < 30; ++i) {
    Eigen::Matrix<double, 12, 3> slopes;
    for (int k = 0; k < 3; ++k) {
      const Vector3d change = step_N * Vector3d::Unit(k);
      slopes.col(k) =
          (modelled(force_S_N + change, law, arcs) - modelled(force_S_N - change, law, arcs)) / (2 * step_N);
    }
    const Vector3d step = slopes.colPivHouseholderQr().solve(measured_mm - modelled(force_S_N, law, arcs));
    force_S_N += step;
    if (step.norm() < 1e-9) return force_S_N;
  }
  return Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());
}

struct Truth {
  Vector3d force_S_N;
  Positions exact_mm;
};

std::vector<Truth> law_problems() {
  std::vector<Truth> truths;
  for (int seed = 1; seed <= law_truths; ++seed) {
    Noise random(static_cast<std::uint64_t>(4'000'000 + seed));
    const double unit_N = EI_Nmm2 / (L_mm * L_mm), size_N = unit_N * random.uniform(0.2, 2);
    const double angle = random.uniform(0, 2 * M_PI), along_N = unit_N * random.uniform(-0.5, 0.5);
    const Vector3d force_S_N(along_N, size_N * std::cos(angle), size_N * std::sin(angle));
    const auto exact = exact_reference::solve(rod_under(force_S_N), {scene::RodModel::kirchhoff, 1e-10});
    if (!exact.converged()) throw std::runtime_error("sensing: the exact reference says " + exact.message);
    truths.push_back({force_S_N, positions_of(exact)});
  }
  return truths;
}

// --- Time ------------------------------------------------------------------------------------------------------------

constexpr int timed_truths = 10, timed_noises = 20;

struct Times {
  std::vector<double> cold_us, warm_us;
};

double quantile(std::vector<double> values, double share) {
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
}

Times times_of(Sensing kind, double noise, int positions, const std::filesystem::path& cases) {
  Times times;
  for (std::uint64_t seed = 1; seed <= timed_truths; ++seed) {
    const scene::EstimationProblem exact =
        sensing_problem(kind, seed, noise, cases, Mismatch::none, positions).estimation;
    Noise random(5'000'000 + seed);
    fam::Estimator kept(exact);
    kept.track();
    for (int i = 0; i < timed_noises; ++i) {
      scene::EstimationProblem trial = exact;
      for (std::size_t k = 0; k < trial.scenes.size(); ++k) {
        for (std::size_t m = 0; m < trial.scenes[k].measurements.size(); ++m) {
          scene::Measurement& measurement = trial.scenes[k].measurements[m];
          measurement = noisy(measurement, random);
          kept.set_measurement(k, m, measurement);
        }
      }
      times.cold_us.push_back(1e6 * seconds_of([&] { fam::Estimator(trial).estimate(); }));
      times.warm_us.push_back(1e6 * seconds_of([&] { kept.track(); }));
    }
  }
  return times;
}

}  // namespace

Table times_table(const std::filesystem::path& cases) {
  Table table({"problem", "noise", "cold: median, µs", "99 of 100 below", "warm: median, µs", "99 of 100 below"});
  const auto add = [&](const char* name, Sensing kind, int positions) {
    const double noise = words_of(kind).noises.front();
    const Times times = times_of(kind, noise, positions, cases);
    table.add({name, fmt::format("{:g}", noise), significant(quantile(times.cold_us, 0.5), 3),
               significant(quantile(times.cold_us, 0.99), 3), significant(quantile(times.warm_us, 0.5), 3),
               significant(quantile(times.warm_us, 0.99), 3)});
  };
  add("tip position alone", Sensing::four_positions, 1);
  for (const Sensing kind : all_sensing) add(words_of(kind).name, kind, 4);
  return table;
}

Table starts_table(const std::filesystem::path& cases) {
  Table table({"problem", "noise", "starts", "no answer", "unobservable", "lowest minimum",
               "another, chi-squared fails", "another, chi-squared passes"});
  const std::pair<Sensing, double> problems[] = {{Sensing::tip_pose, 0.01},       {Sensing::tip_pose, 0.1},
                                                 {Sensing::four_positions, 0.01}, {Sensing::four_positions, 0.1},
                                                 {Sensing::two_contacts, 1e-5},   {Sensing::two_contacts, 1e-4}};
  for (const auto& [kind, noise] : problems) {
    Starts sum;
    for (std::uint64_t seed = 1; seed <= start_truths; ++seed)
      add_starts(sum, sensing_problem(kind, seed, noise, cases).estimation, seed);
    table.add({words_of(kind).name, fmt::format("{:g}", noise), std::to_string(sum.all), std::to_string(sum.none),
               std::to_string(sum.unobservable), std::to_string(sum.lowest), std::to_string(sum.seen),
               std::to_string(sum.unseen)});
  }
  return table;
}

Table laws_table() {
  Table table({"law", "arcs", "force off by: median", "largest"});
  const std::vector<Truth> truths = law_problems();
  const auto add = [&](fam::Law law, int arcs) {
    std::vector<double> off;
    for (const auto& [force_S_N, exact_mm] : truths)
      off.push_back((force_S_N_by(exact_mm, force_S_N, law, arcs) - force_S_N).norm() / force_S_N.norm());
    std::sort(off.begin(), off.end());
    table.add({fam::name(law), std::to_string(arcs), significant(off[off.size() / 2], 2), significant(off.back(), 2)});
  };
  for (const int arcs : {4, 8, 16, 48, 100, 400, 1000}) add(fam::Law::published, arcs);
  for (const int arcs : {4, 8, 16}) add(fam::Law::sixth_order, arcs);
  return table;
}

}  // namespace studies
