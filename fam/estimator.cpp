#include "fam/estimator.h"

#include "fam/rotation.h"
#include "fam/skew.h"

#include "scene/load_visitor.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <limits>

namespace fam {
namespace {

using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;
using scene::Measurement;
using scene::Status;
using scene::Unknown;
using UnknownKind = scene::Unknown::Kind;
using Vector6 = Solver::Vector6;

// All chosen, not measured.
constexpr double model_tolerance_over_L = 1e-6;
constexpr int most_iterations = 200;
constexpr double first_damping = 1e-3, least_damping = 1e-12, most_damping = 1e12;
constexpr double least_scaling = 1e-6;  // of the damping matrix, of its largest
constexpr double converged_decrease = 1e-10;
constexpr double longest_step = 2;                                   // in the unknowns' own units
constexpr double longest_place_step = 0.2;                           // of the length
constexpr double least_information = 1e-12, widest_posterior = 0.9;  // of what counts as observed: the contract's
constexpr double unobserved_share = 0.01;  // of an unknown's variance that comes from unobservable directions
constexpr double normal_999 = 3.0902;      // the normal quantile that one in 1000 exceeds
constexpr double nan_value = std::numeric_limits<double>::quiet_NaN();

// The unit of an unknown: EI/L^2, EI/L, L, 1, 1/L of the first section.
double unit_of(const Unknown& unknown, const scene::EstimationProblem& problem) {
  const scene::Scene& scene = problem.scenes[unknown.scene].scene;
  const double L = scene::length_mm(scene);
  const scene::Stiffness stiffness = scene::stiffness_of(scene.sections.front());
  const double EI = stiffness.bending_Nmm2.maxCoeff();
  switch (unknown.kind) {
    case UnknownKind::component:
      return scene::visit_load(
          scene.loads[unknown.index], [&](const scene::Force&) { return EI / (L * L); },
          [&](const scene::Moment&) { return EI / L; },
          [&](const scene::DistributedForce&) { return EI / (L * L * L); },
          [&](const scene::Gravity&) {
            const double mass = stiffness.mass_per_length_kg_per_m * 1e-3;  // kg/mm
            return mass > 0 ? EI / (L * L * L) / mass : 1;
          },
          [&](const scene::Tendon&) { return EI / (L * L); });
    case UnknownKind::place: return L;
    case UnknownKind::rest_curvature: return 1 / L;
    case UnknownKind::bending_factor:
    case UnknownKind::torsion_factor: break;
  }
  return 1;
}

bool is_of_section(const Unknown& unknown) {
  return unknown.kind != UnknownKind::component && unknown.kind != UnknownKind::place;
}

// The section at a place, that towards the clamp at a border.
std::size_t section_at(const scene::Scene& scene, double s_mm) {
  double end_mm = 0;
  for (std::size_t i = 0; i + 1 < scene.sections.size(); ++i) {
    end_mm += scene.sections[i].length_mm;
    if (s_mm <= end_mm) return i;
  }
  return scene.sections.size() - 1;
}

// The total u of a solution.
Vector3d strain_at(const Solver& solver, double s_mm) {
  const scene::Scene& scene = solver.scene();
  const scene::Section& section = scene.sections[section_at(scene, s_mm)];
  const scene::Stiffness stiffness = scene::stiffness_of(section);
  const Vector3d moment_S_Nmm = solver.pose_at(s_mm).rotation_BS.transpose() * solver.wrench_at(s_mm).moment_Nmm;
  return section.rest_curvature_per_mm +
         moment_S_Nmm.cwiseQuotient(
             Vector3d(stiffness.torsion_Nmm2, stiffness.bending_Nmm2[0], stiffness.bending_Nmm2[1]));
}

// What the six rows of pose, strain and wrench are by an unknown.
enum class Of { pose, strain, wrench };

Vector6 by_stiffness(const Solver& solver, Of of, std::size_t section, double s_mm, const Vector3d& change_Nmm2) {
  if (of == Of::pose) return solver.by_stiffness(section, s_mm) * change_Nmm2;
  if (of == Of::strain) return solver.strain_by_stiffness(section, s_mm) * change_Nmm2;
  return solver.wrench_by_stiffness(section, s_mm) * change_Nmm2;
}

Vector6 by_load(const Solver& solver, Of of, const Unknown& unknown, double s_mm) {
  if (of == Of::pose) return solver.by_load(unknown.index, s_mm).col(unknown.component);
  if (of == Of::strain) return solver.strain_by_load(unknown.index, s_mm).col(unknown.component);
  return solver.wrench_by_load(unknown.index, s_mm).col(unknown.component);
}

Vector6 by_place(const Solver& solver, Of of, const Unknown& unknown, double s_mm) {
  if (of == Of::pose) return solver.by_place(unknown.index, s_mm);
  if (of == Of::strain) return solver.strain_by_place(unknown.index, s_mm);
  return solver.wrench_by_place(unknown.index, s_mm);
}

Vector6 by_rest_curvature(const Solver& solver, Of of, const Unknown& unknown, double s_mm) {
  if (of == Of::pose) return solver.by_rest_curvature(unknown.index, s_mm).col(unknown.component);
  if (of == Of::strain) return solver.strain_by_rest_curvature(unknown.index, s_mm).col(unknown.component);
  return solver.wrench_by_rest_curvature(unknown.index, s_mm).col(unknown.component);
}

// Per unit of the unknown as the scene has it; `given` is the section before any factor.
Vector6 derivative(const Solver& solver, Of of, const Unknown& unknown, const scene::Scene& given, double s_mm) {
  switch (unknown.kind) {
    case UnknownKind::component: return by_load(solver, of, unknown, s_mm);
    case UnknownKind::place: return by_place(solver, of, unknown, s_mm);
    case UnknownKind::rest_curvature: return by_rest_curvature(solver, of, unknown, s_mm);
    case UnknownKind::bending_factor:
    case UnknownKind::torsion_factor: break;
  }
  const scene::Stiffness stiffness = scene::stiffness_of(given.sections[unknown.index]);
  const Vector3d change_Nmm2 = unknown.kind == UnknownKind::bending_factor
                                   ? Vector3d(0, stiffness.bending_Nmm2[0], stiffness.bending_Nmm2[1])
                                   : Vector3d(stiffness.torsion_Nmm2, 0, 0);
  return by_stiffness(solver, of, unknown.index, s_mm, change_Nmm2);
}

// d phi of log(exp(d phi) R) at the rotation vector r: the inverse left Jacobian of SO(3).
Eigen::Matrix3d inverse_left_jacobian(const Vector3d& r) {
  const double angle2 = r.squaredNorm(), angle = std::sqrt(angle2);
  const double c =
      angle < 1e-3 ? 1.0 / 12 + angle2 / 720 : 1 / angle2 - (1 + std::cos(angle)) / (2 * angle * std::sin(angle));
  const Eigen::Matrix3d cross = skew(r);
  return Eigen::Matrix3d::Identity() - 0.5 * cross + c * cross * cross;
}

int rows_of(const Measurement& measurement) {
  if (std::holds_alternative<scene::BaseWrenchMeasurement>(measurement.value)) return 6;
  return std::holds_alternative<scene::CurvatureMeasurement>(measurement.value) ? 2 : 3;
}

// Adds the rows of one measurement: what the model gives less what is measured, over sd, and its slopes.
class RowWriter {
 public:
  RowWriter(const Solver& solver, const scene::Scene& given, std::size_t scene, const std::vector<Unknown>& unknowns,
            VectorXd& residual, MatrixXd& slopes, Eigen::Index row)
      : solver_(solver),
        given_(given),
        scene_(scene),
        unknowns_(unknowns),
        residual_(residual),
        slopes_(slopes),
        row_(row) {}

  void write(const Measurement& measurement) {
    s_mm_ = measurement.s_mm;
    std::visit([this](const auto& value) { write(value); }, measurement.value);
    row_ += rows_of(measurement);
  }

  Eigen::Index row() const { return row_; }

 private:
  void write(const scene::PositionMeasurement& m) {
    residual_.segment<3>(row_) = (solver_.pose_at(s_mm_).position_B_mm - m.position_B_mm) / m.sd_mm;
    put_slopes(Of::pose, 3, [&](const Vector6& by) { return Vector3d(by.head<3>() / m.sd_mm); });
  }

  void write(const scene::RotationMeasurement& m) {
    const Eigen::Matrix3d apart = solver_.pose_at(s_mm_).rotation_BS * m.rotation_BS.transpose();
    const Vector3d off = rotation_vector(apart);
    residual_.segment<3>(row_) = off / m.sd_rad;
    const Eigen::Matrix3d turned = inverse_left_jacobian(off) / m.sd_rad;
    put_slopes(Of::pose, 3, [&](const Vector6& by) { return Vector3d(turned * by.tail<3>()); });
  }

  void write(const scene::CurvatureMeasurement& m) {
    residual_.segment<2>(row_) = (strain_at(solver_, s_mm_).tail<2>() - m.curvature_S_per_mm) / m.sd_per_mm;
    put_slopes(Of::strain, 2, [&](const Vector6& by) { return Eigen::Vector2d(by.segment<2>(1) / m.sd_per_mm); });
  }

  void write(const scene::BaseWrenchMeasurement& m) {
    const scene::Wrench wrench = solver_.base_wrench_B();
    residual_.segment<3>(row_) = (wrench.force_N - m.wrench_B.force_N) / m.sd_N;
    residual_.segment<3>(row_ + 3) = (wrench.moment_Nmm - m.wrench_B.moment_Nmm) / m.sd_Nmm;
    s_mm_ = 0;
    put_slopes(Of::wrench, 6, [&](const Vector6& by) {
      Vector6 row;
      row << by.head<3>() / m.sd_N, by.tail<3>() / m.sd_Nmm;
      return row;
    });
  }

  template <class Row>
  void put_slopes(Of of, Eigen::Index count, Row&& row) {
    for (std::size_t k = 0; k < unknowns_.size(); ++k) {
      const Unknown& unknown = unknowns_[k];
      if (!is_of_section(unknown) && unknown.scene != scene_) continue;
      slopes_.col(static_cast<Eigen::Index>(k)).segment(row_, count) =
          row(derivative(solver_, of, unknown, given_, s_mm_));
    }
  }

  const Solver& solver_;
  const scene::Scene& given_;
  std::size_t scene_;
  const std::vector<Unknown>& unknowns_;
  VectorXd& residual_;
  MatrixXd& slopes_;
  Eigen::Index row_;
  double s_mm_ = 0;
};

// Below this, chi-squared lies in 999 of 1000 (Wilson and Hilferty, PNAS 17, 1931).
double chi_squared_999(int degrees) {
  if (degrees <= 0) return std::numeric_limits<double>::infinity();
  const double share = 2.0 / (9 * degrees);
  return degrees * std::pow(1 - share + normal_999 * std::sqrt(share), 3);
}

}  // namespace

struct Estimator::Impl {
  scene::EstimationProblem given, now;
  Options options;
  std::vector<std::optional<Solver>> solvers;
  VectorXd unit;
  bool has_sections = false, starts_warm = false;
  VectorXd x;  // in units of their own
  Status failure = Status::not_converged;
  std::string failure_message;
  // At x: the measurements' rows, then the priors'.
  VectorXd residual;
  MatrixXd slopes;
  Eigen::Index measured_rows = 0;

  Impl(scene::EstimationProblem problem, const Options& asked) : given(std::move(problem)), options(asked) {
    now = given;
    if (options.arcs == 0 && !(options.tolerance_mm > 0))
      options.tolerance_mm = model_tolerance_over_L * scene::length_mm(given.scenes.front().scene);
    solvers.resize(given.scenes.size());
    const auto count = static_cast<Eigen::Index>(given.unknowns.size());
    unit.resize(count);
    x.resize(count);
    for (Eigen::Index k = 0; k < count; ++k) {
      const Unknown& unknown = given.unknowns[static_cast<std::size_t>(k)];
      has_sections |= is_of_section(unknown);
      unit[k] = unit_of(unknown, given);
      x[k] = unknown.prior_mean / unit[k];
    }
    x = bounded(x);
  }

  const Unknown& unknown(Eigen::Index k) const { return given.unknowns[static_cast<std::size_t>(k)]; }

  // Places on the rod, tensions that pull, factors above zero.
  VectorXd bounded(VectorXd at) const {
    for (Eigen::Index k = 0; k < at.size(); ++k) {
      const Unknown& u = unknown(k);
      if (u.kind == UnknownKind::place)
        at[k] = std::clamp(at[k], 0.0, scene::length_mm(given.scenes[u.scene].scene) / unit[k]);
      if (u.kind == UnknownKind::component && scene::tendon_of(given.scenes[u.scene].scene.loads[u.index]))
        at[k] = std::max(at[k], 0.0);
      if (u.kind == UnknownKind::bending_factor || u.kind == UnknownKind::torsion_factor) at[k] = std::max(at[k], 0.01);
    }
    return at;
  }

  void put_in(const VectorXd& at) {
    if (has_sections) {
      for (std::size_t i = 0; i < now.scenes.size(); ++i) now.scenes[i].scene.sections = given.scenes[i].scene.sections;
    }
    for (Eigen::Index k = 0; k < at.size(); ++k) scene::put(now, unknown(k), at[k] * unit[k]);
  }

  void set_loads(Solver& solver, std::size_t scene) const {
    for (const Unknown& u : given.unknowns) {
      if (is_of_section(u) || u.scene != scene) continue;
      scene::visit_load(
          now.scenes[scene].scene.loads[u.index],
          [&](const scene::Force& load) {
            if (u.kind == UnknownKind::place) solver.set_at_mm(u.index, load.at_mm);
            else solver.set_force_N(u.index, load.value_N);
          },
          [&](const scene::Moment& load) {
            if (u.kind == UnknownKind::place) solver.set_at_mm(u.index, load.at_mm);
            else solver.set_moment_Nmm(u.index, load.value_Nmm);
          },
          [&](const scene::DistributedForce& load) { solver.set_distributed_N_per_mm(u.index, load.value_N_per_mm); },
          [&](const scene::Gravity& load) { solver.set_acceleration_m_per_s2(u.index, load.acceleration_m_per_s2); },
          [&](const scene::Tendon& load) { solver.set_tension_N(u.index, load.tension_N); });
    }
  }

  bool solve(std::size_t scene) {
    std::optional<Solver>& solver = solvers[scene];
    const bool kept = solver.has_value() && !has_sections;
    if (!kept) {
      auto made = Solver::make(now.scenes[scene].scene, options);
      if (const auto* refusal = std::get_if<Refusal>(&made)) {
        failure = refusal->status;
        failure_message = refusal->message;
        return false;
      }
      solver.emplace(std::move(std::get<Solver>(made)));
    } else {
      set_loads(*solver, scene);
    }
    Solver::Outcome outcome = solver->solve();
    if (!outcome.converged() && kept) outcome = solver->solve(Solver::Start::unloaded);
    failure = outcome.status;
    failure_message = outcome.message;
    return outcome.converged();
  }

  // Residual and slopes at x; false where the rod cannot be solved there.
  bool evaluate(const VectorXd& at) {
    put_in(at);
    Eigen::Index rows = 0, priors = 0;
    for (const scene::MeasuredScene& scene : given.scenes)
      for (const Measurement& measurement : scene.measurements) rows += rows_of(measurement);
    for (const Unknown& u : given.unknowns) priors += u.prior_sd ? 1 : 0;
    measured_rows = rows;
    residual.setZero(rows + priors);
    slopes.setZero(rows + priors, at.size());
    Eigen::Index row = 0;
    for (std::size_t i = 0; i < given.scenes.size(); ++i) {
      if (!solve(i)) return false;
      RowWriter writer(*solvers[i], given.scenes[i].scene, i, given.unknowns, residual, slopes, row);
      for (const Measurement& measurement : given.scenes[i].measurements) writer.write(measurement);
      row = writer.row();
    }
    slopes.topRows(rows) *= unit.asDiagonal();
    for (Eigen::Index k = 0; k < at.size(); ++k) {
      const Unknown& u = unknown(k);
      if (!u.prior_sd) continue;
      residual[row] = (at[k] * unit[k] - u.prior_mean) / *u.prior_sd;
      slopes(row++, k) = unit[k] / *u.prior_sd;
    }
    failure = Status::not_finite;
    failure_message = "a derivative is not finite";
    return residual.allFinite() && slopes.allFinite();
  }

  // Shortened to what the unknowns may change by at once.
  VectorXd limited(VectorXd step) const {
    double share = 1;
    for (Eigen::Index k = 0; k < step.size(); ++k) {
      const double most = unknown(k).kind == UnknownKind::place ? longest_place_step : longest_step;
      share = std::min(share, most / std::max(std::abs(step[k]), most));
    }
    return share * step;
  }

  // How much a full step could bring chi-squared down: g^T H^-1 g where H is not small.
  static double possible_decrease(const MatrixXd& information, const VectorXd& gradient) {
    const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(information);
    const VectorXd along = eigen.eigenvectors().transpose() * gradient;
    const double largest = eigen.eigenvalues().maxCoeff();
    double decrease = 0;
    for (Eigen::Index k = 0; k < along.size(); ++k) {
      if (eigen.eigenvalues()[k] > least_information * largest)
        decrease += along[k] * along[k] / eigen.eigenvalues()[k];
    }
    return decrease;
  }

  bool minimise(Estimate& result) {
    if (!evaluate(x)) return false;
    double damping = first_damping, chi_squared = residual.squaredNorm();
    for (result.iterations = 0; result.iterations < most_iterations; ++result.iterations) {
      const MatrixXd information = slopes.transpose() * slopes;
      const VectorXd gradient = slopes.transpose() * residual;
      const double largest = information.diagonal().maxCoeff();
      if (!(largest > 0) || possible_decrease(information, gradient) <= converged_decrease * (1 + chi_squared))
        return true;
      const VectorXd scaling = information.diagonal().cwiseMax(least_scaling * largest);
      const VectorXd before = x;
      const VectorXd kept_residual = residual;
      const MatrixXd kept_slopes = slopes;
      bool better = false;
      while (!better && damping <= most_damping) {
        const MatrixXd damped = information + MatrixXd((damping * scaling).asDiagonal());
        const VectorXd trial = bounded(before + limited(-damped.ldlt().solve(gradient)));
        if (trial == before) break;
        better = evaluate(trial) && residual.squaredNorm() < chi_squared;
        if (better) x = trial;
        else damping *= 10;
      }
      if (!better) {  // the solver's own digits are reached, or a bound holds the unknowns
        residual = kept_residual;
        slopes = kept_slopes;
        return evaluate(before) && is_flat(before, gradient, information, chi_squared);
      }
      chi_squared = residual.squaredNorm();
      damping = std::max(least_damping, damping / 10);
    }
    failure = Status::not_converged;
    failure_message = std::to_string(most_iterations) + " iterations";
    return false;
  }

  // No step brought chi-squared down: at a minimum where what is left lies in unknowns at their bounds, or is the
  // round-off of a chi-squared with sqrt(eps) digits of its slopes.
  bool is_flat(const VectorXd& at, VectorXd gradient, const MatrixXd& information, double chi_squared) {
    for (Eigen::Index k = 0; k < at.size(); ++k) {
      VectorXd moved = at;
      moved[k] -= std::copysign(1e-9, gradient[k]);
      if (bounded(moved)[k] == at[k]) gradient[k] = 0;
    }
    if (possible_decrease(information, gradient) <= 1e-6 * (1 + chi_squared)) return true;
    failure = Status::not_converged;
    failure_message = "no step brings chi-squared down";
    return false;
  }

  // Covariance, what is observed, and whether the model fits.
  void judge(Estimate& result) const {
    const Eigen::Index count = x.size();
    const MatrixXd measured = slopes.topRows(measured_rows);
    const MatrixXd information = measured.transpose() * measured;
    const double largest =
        Eigen::SelfAdjointEigenSolver<MatrixXd>(information, Eigen::EigenvaluesOnly).eigenvalues().maxCoeff();
    const double least = 1 / (widest_posterior * widest_posterior) - 1;  // information over the prior's
    VectorXd width(count);  // priors; where there is none, so wide that least_information of the largest is least
    for (Eigen::Index k = 0; k < count; ++k) {
      const auto& sd = unknown(k).prior_sd;
      width[k] = sd ? *sd / unit[k] : std::sqrt(least / (least_information * std::max(largest, 1e-300)));
    }
    const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(
        MatrixXd(width.asDiagonal() * information * width.asDiagonal()));
    VectorXd hidden = VectorXd::Zero(count), variance = VectorXd::Zero(count);
    int free_directions = 0;
    for (Eigen::Index k = 0; k < count; ++k) {
      const VectorXd along = width.asDiagonal() * eigen.eigenvectors().col(k);
      const VectorXd share = along.cwiseAbs2() / (1 + std::max(0.0, eigen.eigenvalues()[k]));
      variance += share;
      if (eigen.eigenvalues()[k] > least) continue;
      hidden += share;
      VectorXd direction = along / along.norm();
      direction = direction.unaryExpr([](double c) { return std::abs(c) < 1e-6 ? 0.0 : c; });
      result.unobservable.push_back(direction);
      bool has_prior = false;
      for (Eigen::Index j = 0; j < count; ++j) has_prior |= direction[j] != 0 && unknown(j).prior_sd.has_value();
      free_directions += has_prior ? 0 : 1;
    }
    const MatrixXd narrow = (eigen.eigenvalues().cwiseMax(0).array() + 1).inverse().matrix().asDiagonal();
    const MatrixXd spread = width.asDiagonal() * eigen.eigenvectors();
    result.covariance = unit.asDiagonal() * MatrixXd(spread * narrow * spread.transpose()) * unit.asDiagonal();
    result.mean = x.cwiseProduct(unit);
    result.sd = variance.cwiseSqrt().cwiseProduct(unit);
    result.observable.assign(static_cast<std::size_t>(count), true);
    for (Eigen::Index k = 0; k < count; ++k) {
      if (hidden[k] <= unobserved_share * variance[k]) continue;
      result.observable[static_cast<std::size_t>(k)] = false;
      result.mean[k] = result.sd[k] = nan_value;
      result.covariance.row(k).setConstant(nan_value);
      result.covariance.col(k).setConstant(nan_value);
    }
    result.chi_squared = residual.squaredNorm();
    result.degrees_of_freedom = static_cast<int>(residual.size() - count) + free_directions;
    const double most = chi_squared_999(result.degrees_of_freedom);
    result.fits = result.chi_squared <= most;
  }

  Estimate estimate() {
    Estimate result;
    const VectorXd start = x;
    const bool solved = minimise(result);
    result.status = solved ? Status::converged : failure;
    if (!solved) {
      x = start;
      result.message = failure_message;
      return result;
    }
    judge(result);
    if (!result.fits)
      result.message = "the model does not fit the measurements: chi-squared is larger than one in 1000 would be";
    put_in(x);
    result.problem = now;
    return result;
  }
};

Estimator::Estimator(scene::EstimationProblem problem, const Options& options)
    : impl_(std::make_unique<Impl>(std::move(problem), options)) {}
Estimator::Estimator(Estimator&&) noexcept = default;
Estimator& Estimator::operator=(Estimator&&) noexcept = default;
Estimator::~Estimator() = default;

const scene::EstimationProblem& Estimator::problem() const {
  return impl_->given;
}

void Estimator::set_measurement(std::size_t scene, std::size_t measurement, const scene::Measurement& value) {
  impl_->given.scenes.at(scene).measurements.at(measurement) = value;
}

Estimate Estimator::estimate() {
  return impl_->estimate();
}

}  // namespace fam
