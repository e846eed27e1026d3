#include "fam/measured_rows.h"

#include "fam/rotation.h"
#include "fam/skew.h"

#include <cmath>

namespace fam {
namespace {

using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;
using scene::Measurement;
using scene::Unknown;
using Vector6 = Solver::Vector6;
using Matrix63 = Solver::Matrix63;

// The total u of a solution.
Vector3d strain_at(const Solver& solver, double s_mm) {
  const Vector3d moment_S_Nmm = solver.pose_at(s_mm).rotation_BS.transpose() * solver.wrench_at(s_mm).moment_Nmm;
  return scene::curvature_per_mm(scene::section_at(solver.scene(), s_mm), moment_S_Nmm);
}

// What the six rows of pose, strain and wrench are by an unknown.
enum class Of { pose, strain, wrench };

// Of what one unit of an unknown may change, below which a change is round-off. Chosen: no share of a measurement's
// largest information, 1e-12, asks for less than the square of it.
constexpr double round_off_share = 1e-14;

// What a rod's pose, strain and wrench change by where it bends by a rad.
Vector6 natural_size(Of of, const scene::Scene& scene) {
  const double L_mm = scene::length_mm(scene);
  const double EI_Nmm2 = scene::stiffness_of(scene.sections.front()).bending_Nmm2.maxCoeff();
  double shift = L_mm, turn = 1;
  if (of == Of::strain) shift = 1 / L_mm;
  if (of == Of::wrench) shift = EI_Nmm2 / (L_mm * L_mm), turn = EI_Nmm2 / L_mm;
  return (Vector6() << shift, shift, shift, turn, turn, turn).finished();
}

Matrix63 by_load(const Solver& solver, Of of, std::size_t load, double s_mm) {
  if (of == Of::pose) return solver.by_load(load, s_mm);
  if (of == Of::strain) return solver.strain_by_load(load, s_mm);
  return solver.wrench_by_load(load, s_mm);
}

Vector6 by_place(const Solver& solver, Of of, std::size_t load, double s_mm) {
  if (of == Of::pose) return solver.by_place(load, s_mm);
  if (of == Of::strain) return solver.strain_by_place(load, s_mm);
  return solver.wrench_by_place(load, s_mm);
}

Matrix63 by_rest_curvature(const Solver& solver, Of of, std::size_t section, double s_mm) {
  if (of == Of::pose) return solver.by_rest_curvature(section, s_mm);
  if (of == Of::strain) return solver.strain_by_rest_curvature(section, s_mm);
  return solver.wrench_by_rest_curvature(section, s_mm);
}

Matrix63 by_stiffness(const Solver& solver, Of of, std::size_t section, double s_mm) {
  if (of == Of::pose) return solver.by_stiffness(section, s_mm);
  if (of == Of::strain) return solver.strain_by_stiffness(section, s_mm);
  return solver.wrench_by_stiffness(section, s_mm);
}

// By the unknowns at one place, in the unit of the scene; the components of a load that follow each other are asked for
// once.
class Derivatives {
 public:
  Derivatives(const Solver& solver, const scene::Scene& given, Of of, double s_mm)
      : solver_(solver), given_(given), of_(of), s_mm_(s_mm) {}

  Vector6 by(const Unknown& unknown) {
    switch (unknown.kind) {
      case Unknown::Kind::component:
        if (unknown.index != load_) by_load_ = by_load(solver_, of_, load_ = unknown.index, s_mm_);
        return by_load_.col(unknown.component);
      case Unknown::Kind::place: return by_place(solver_, of_, unknown.index, s_mm_);
      case Unknown::Kind::rest_curvature:
        return by_rest_curvature(solver_, of_, unknown.index, s_mm_).col(unknown.component);
      case Unknown::Kind::bending_factor:
      case Unknown::Kind::torsion_factor: break;
    }
    const scene::Stiffness stiffness = scene::stiffness_of(given_.sections[unknown.index]);
    const Vector3d change_Nmm2 = unknown.kind == Unknown::Kind::bending_factor
                                     ? Vector3d(0, stiffness.bending_Nmm2[0], stiffness.bending_Nmm2[1])
                                     : Vector3d(stiffness.torsion_Nmm2, 0, 0);
    return by_stiffness(solver_, of_, unknown.index, s_mm_) * change_Nmm2;
  }

 private:
  const Solver& solver_;
  const scene::Scene& given_;
  Of of_;
  double s_mm_;
  std::size_t load_ = static_cast<std::size_t>(-1);
  Matrix63 by_load_;
};

// d phi of log(exp(d phi) R) at the rotation vector r: the inverse left Jacobian of SO(3).
Eigen::Matrix3d inverse_left_jacobian(const Vector3d& r) {
  const double angle2 = r.squaredNorm(), angle = std::sqrt(angle2);
  const double c =
      angle < 1e-3 ? 1.0 / 12 + angle2 / 720 : 1 / angle2 - (1 + std::cos(angle)) / (2 * angle * std::sin(angle));
  const Eigen::Matrix3d cross = skew(r);
  return Eigen::Matrix3d::Identity() - 0.5 * cross + c * cross * cross;
}

// Pose, strain or wrench, where, and how the measured rows follow from its six.
struct Projection {
  Of of;
  double s_mm;
  Eigen::Matrix<double, 6, 6> rows = Eigen::Matrix<double, 6, 6>::Zero();  // the first rows_of()
};

Vector3d turn_off(const Solver& solver, double s_mm, const scene::RotationMeasurement& m) {
  return rotation_vector(Matrix3d(solver.pose_at(s_mm).rotation_BS * m.rotation_BS.transpose()));
}

Projection projection_of(const Solver& solver, const Measurement& measurement) {
  Projection to{Of::pose, measurement.s_mm};
  if (const auto* position = std::get_if<scene::PositionMeasurement>(&measurement.value)) {
    to.rows.topLeftCorner<3, 3>() = Matrix3d::Identity() / position->sd_mm;
  } else if (const auto* rotation = std::get_if<scene::RotationMeasurement>(&measurement.value)) {
    to.rows.topRightCorner<3, 3>() =
        inverse_left_jacobian(turn_off(solver, measurement.s_mm, *rotation)) / rotation->sd_rad;
  } else if (const auto* curvature = std::get_if<scene::CurvatureMeasurement>(&measurement.value)) {
    to.of = Of::strain;
    to.rows(0, 1) = to.rows(1, 2) = 1 / curvature->sd_per_mm;
  } else {
    const auto& wrench = std::get<scene::BaseWrenchMeasurement>(measurement.value);
    to.of = Of::wrench;
    to.s_mm = 0;
    to.rows.topLeftCorner<3, 3>() = Matrix3d::Identity() / wrench.sd_N;
    to.rows.bottomRightCorner<3, 3>() = Matrix3d::Identity() / wrench.sd_Nmm;
  }
  return to;
}

}  // namespace

int rows_of(const Measurement& measurement) {
  if (std::holds_alternative<scene::BaseWrenchMeasurement>(measurement.value)) return 6;
  return std::holds_alternative<scene::CurvatureMeasurement>(measurement.value) ? 2 : 3;
}

bool has_slopes_of(const Measurement& a, const Measurement& b) {
  if (a.s_mm != b.s_mm || a.value.index() != b.value.index()) return false;
  if (const auto* position = std::get_if<scene::PositionMeasurement>(&a.value))
    return position->sd_mm == std::get<scene::PositionMeasurement>(b.value).sd_mm;
  if (const auto* rotation = std::get_if<scene::RotationMeasurement>(&a.value))
    return rotation->sd_rad == std::get<scene::RotationMeasurement>(b.value).sd_rad;
  if (const auto* curvature = std::get_if<scene::CurvatureMeasurement>(&a.value))
    return curvature->sd_per_mm == std::get<scene::CurvatureMeasurement>(b.value).sd_per_mm;
  const auto &wrench = std::get<scene::BaseWrenchMeasurement>(a.value),
             &other = std::get<scene::BaseWrenchMeasurement>(b.value);
  return wrench.sd_N == other.sd_N && wrench.sd_Nmm == other.sd_Nmm;
}

void put_residual(const Solver& solver, const Measurement& measurement, Eigen::Ref<VectorXd> rows) {
  const double s_mm = measurement.s_mm;
  if (const auto* position = std::get_if<scene::PositionMeasurement>(&measurement.value)) {
    rows = (solver.pose_at(s_mm).position_B_mm - position->position_B_mm) / position->sd_mm;
  } else if (const auto* rotation = std::get_if<scene::RotationMeasurement>(&measurement.value)) {
    rows = turn_off(solver, s_mm, *rotation) / rotation->sd_rad;
  } else if (const auto* curvature = std::get_if<scene::CurvatureMeasurement>(&measurement.value)) {
    rows = (strain_at(solver, s_mm).tail<2>() - curvature->curvature_S_per_mm) / curvature->sd_per_mm;
  } else {
    const auto& measured = std::get<scene::BaseWrenchMeasurement>(measurement.value);
    const scene::Wrench wrench = solver.base_wrench_B();
    rows.head<3>() = (wrench.force_N - measured.wrench_B.force_N) / measured.sd_N;
    rows.tail<3>() = (wrench.moment_Nmm - measured.wrench_B.moment_Nmm) / measured.sd_Nmm;
  }
}

void put_slopes(const Solver& solver, const scene::MeasuredScene& given, std::size_t scene,
                const std::vector<Unknown>& unknowns, const VectorXd& unit, const Measurement& measurement,
                Eigen::Ref<MatrixXd> rows) {
  const Projection to = projection_of(solver, measurement);
  const Vector6 round_off = round_off_share * natural_size(to.of, given.scene);
  Derivatives derivatives(solver, given.scene, to.of, to.s_mm);
  for (std::size_t k = 0; k < unknowns.size(); ++k) {
    if (!is_of_section(unknowns[k]) && unknowns[k].scene != scene) continue;
    const auto i = static_cast<Eigen::Index>(k);
    Vector6 by = derivatives.by(unknowns[k]);
    by = (by.array().abs() * unit[i] <= round_off.array()).select(0, by);
    const Vector6 column = to.rows * by;
    rows.col(i) = column.head(rows.rows());
  }
}

}  // namespace fam
