#include "exact_reference/certificate.h"

#include "exact_reference/boundary_value.h"
#include "exact_reference/shape.h"
#include "exact_reference/shooting.h"
#include "exact_reference/stability.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace exact_reference {
namespace {

using Eigen::Matrix3d;
using Eigen::Quaterniond;
using Eigen::Vector3d;
using scene::Station;

constexpr int most_intervals = 20'000;
constexpr int most_newton_steps = 8;
constexpr int unloaded_intervals = 8;
// A station between two nodes is left out where the interval stays as short as this; the mesh is refined afterwards.
constexpr double longest_interval = 1.0 / 6, most_turn_rad = 0.5;
constexpr double most_growth = 2;  // sqrt(N K_u^-1) h of a taut rod, which grows by its exponential along an interval

// The stations' states in the rod's units and axes, the tendons' pulls in the wrenches.
class Reader {
 public:
  explicit Reader(const ScaledRod& rod) : rod_(rod) {}

  // Of a station in this span. The quaternion's sign goes on from the last one's.
  State operator()(const Station& station, const ScaledSpan& span) {
    const Matrix3d& turn = rod_.turn_about_axis;
    Quaterniond q(Matrix3d(turn * station.X_BS.rotation_BS * turn.transpose()));
    if (q.dot(last_) < 0) q.coeffs() = -q.coeffs();
    last_ = q;
    const Matrix3d R = q.toRotationMatrix();
    const scene::Wrench own_S{R.transpose() * (turn * station.force_B_N / rod_.force_unit_N),
                              R.transpose() * (turn * station.moment_B_Nmm / rod_.moment_unit_Nmm)};
    const scene::Wrench all_S = with_tendons_S(own_S, span);
    State y;
    y << q.w(), q.vec(), R * all_S.force_N, R * all_S.moment_Nmm, turn * station.X_BS.position_B_mm / rod_.length_mm;
    return y;
  }

 private:
  static scene::Wrench with_tendons_S(scene::Wrench wrench, const ScaledSpan& span) {
    Vector6d strains;
    strains << span.rest_curvature_S + span.bending_compliance.cwiseProduct(wrench.moment_Nmm),
        Vector3d::UnitX() + span.shear_compliance.cwiseProduct(wrench.force_N);
    for (const ScaledTendon& tendon : span.tendons) {
      const Vector3d pull = tendon.tension * tendon_tangent_S(strains, tendon.arm_S).normalized();
      wrench.force_N += pull;
      wrench.moment_Nmm += tendon.arm_S.cross(pull);
    }
    return wrench;
  }

  const ScaledRod& rod_;
  Quaterniond last_ = Quaterniond::Identity();
};

double turn_between_rad(const Station& a, const Station& b) {
  return Quaterniond(Matrix3d(a.X_BS.rotation_BS)).angularDistance(Quaterniond(Matrix3d(b.X_BS.rotation_BS)));
}

// A mesh whose nodes are stations of the answer, and their states. Empty: a span's end is no station.
MeshedStates nodes_of(const ScaledRod& rod, const std::vector<Station>& stations) {
  MeshedStates nodes;
  Reader read(rod);
  nodes.y.push_back(read(stations.front(), rod.spans.front()));
  std::size_t last = 0, k = 1;
  for (std::size_t span = 0; span < rod.spans.size(); ++span) {
    const double end_mm = rod.spans[span].end * rod.length_mm;
    const double near_mm = scene::same_place_relative * rod.length_mm;
    for (bool at_end = false; !at_end; last = k++) {
      if (k == stations.size()) return {};
      const double force = stations[last].force_B_N.norm() / rod.force_unit_N;
      const double growth = std::sqrt(force * rod.spans[span].bending_compliance.maxCoeff());
      const double longest_mm = std::min(longest_interval, most_growth / growth) * rod.length_mm;
      const auto fits = [&](std::size_t next) {
        return next < stations.size() && stations[next].s_mm <= end_mm + near_mm &&
               stations[next].s_mm - stations[last].s_mm <= longest_mm &&
               turn_between_rad(stations[last], stations[next]) <= most_turn_rad &&
               turn_between_rad(stations[next - 1], stations[next]) <= most_turn_rad / 2;
      };
      while (fits(k + 1)) ++k;
      if (stations[k].s_mm > end_mm + near_mm) return {};
      at_end = stations[k].s_mm >= end_mm - near_mm;
      const double start = stations[last].s_mm / rod.length_mm;
      const double end = at_end ? rod.spans[span].end : stations[k].s_mm / rod.length_mm;
      nodes.mesh.push_back({static_cast<int>(span), start, end - start, at_end});
      nodes.y.push_back(read(stations[k], rod.spans[span]));
    }
  }
  return nodes;
}

struct Iteration {
  Shooting shooting;
  NodeStates y;

  bool newton(double tolerance) { return shooting.newton(y, 1, tolerance, most_newton_steps).converged; }

  // Newton's iteration, each time the mesh was too coarse.
  bool converge(double tolerance) {
    constexpr int most_rounds = 12;
    const double local = std::max(tolerance / 20, 1e-14), updates = std::max(tolerance / 100, 1e-15);
    for (int round = 0; round < most_rounds; ++round) {
      if (!newton(updates)) return false;
      shooting.integrate_positions(y, 1);
      if (!shooting.refine(y, 1, local, std::max(1e-6, tolerance), most_intervals)) return true;
    }
    return false;
  }
};

void measure(Certificate& certificate, const ScaledRod& rod, const Iteration& found,
             const std::vector<Station>& stations) {
  const std::vector<Station> exact = stations_at(stations, rod, found.shooting, found.y);
  double force_N = 0, moment_Nmm = 0, force_error_N = 0, moment_error_Nmm = 0;
  certificate.position = certificate.rotation_rad = 0;
  for (std::size_t k = 0; k < exact.size(); ++k) {
    const Station &a = stations[k], &b = exact[k];
    certificate.tip_position = (a.X_BS.position_B_mm - b.X_BS.position_B_mm).norm() / rod.length_mm;
    certificate.position = std::max(certificate.position, certificate.tip_position);
    certificate.rotation_rad = std::max(certificate.rotation_rad, turn_between_rad(a, b));
    force_N = std::max(force_N, b.force_B_N.norm());
    moment_Nmm = std::max(moment_Nmm, b.moment_B_Nmm.norm());
    force_error_N = std::max(force_error_N, (a.force_B_N - b.force_B_N).norm());
    moment_error_Nmm = std::max(moment_error_Nmm, (a.moment_B_Nmm - b.moment_B_Nmm).norm());
  }
  const double force_scale_N = std::max(force_N, moment_Nmm / rod.length_mm);
  const double moment_scale_Nmm = std::max(moment_Nmm, force_N * rod.length_mm);
  certificate.wrench = 0;
  if (force_scale_N > 0)
    certificate.wrench = std::max(force_error_N / force_scale_N, moment_error_Nmm / moment_scale_Nmm);
}

using Branch = Certificate::Branch;

bool signs_hold(const ScaledRod& rod, const Shooting& shooting, const NodeStates& y) {
  if (falling_directions(shooting, y).value_or(1) > 0) return false;
  if (rod.symmetry == scene::Symmetry::axis) return true;
  const Shooting coarse(rod, unloaded_intervals);
  return shooting.determinant(y, 1).negative == coarse.determinant(coarse.unloaded(), 0).negative;
}

Branch branch_of(const ScaledRod& rod, const MeshedStates& coarse, const Iteration& found) {
  if (!rod.has_fixed_load() || rod.moments_are_known() || rod.load_size() < 1) return Branch::alone;
  if (!signs_hold(rod, found.shooting, found.y)) return Branch::doubtful;
  const std::optional<bool> back = leads_back(rod, coarse);
  if (!back) return Branch::signs;
  return *back ? Branch::walked : Branch::doubtful;
}

}  // namespace

Certificate certify(const scene::Scene& scene, const scene::Equilibrium& answer, double tolerance, RodModel model) {
  const ScaledRod rod = scaled_rod(scene, model);
  Certificate result;
  const MeshedStates nodes = nodes_of(rod, answer.stations);
  if (nodes.mesh.empty()) {
    result.message = "a place where sections change or loads stand is no station of the answer";
    return result;
  }
  if (nodes.mesh.size() > most_intervals) {
    result.message = "more stations than the certificate takes";
    return result;
  }
  Iteration iteration{Shooting(rod, nodes.mesh), nodes.y};
  if (!iteration.converge(tolerance)) {
    result.message = "no equilibrium found near the stations";
    return result;
  }
  result.found = true;
  measure(result, rod, iteration, answer.stations);
  result.branch = branch_of(rod, nodes, iteration);
  return result;
}

}  // namespace exact_reference
