#include "exact_reference/initial_value.h"

#include "exact_reference/rod_equations.h"
#include "exact_reference/stations.h"

#include <cvode/cvode.h>
#include <nvector/nvector_serial.h>
#include <sundials/sundials_context.h>
#include <sunnonlinsol/sunnonlinsol_fixedpoint.h>

#include <algorithm>
#include <cmath>

namespace exact_reference {
namespace {

using Eigen::Vector3d;
using Eigen::Vector4d;

// State of the march, in the tip's frame T: q 0-3 (section frame in T), n 4-6 and m 7-9 (section frame), p 10-12 (in
// T). The independent variable is the arc length from the tip.
using MarchState = Eigen::Matrix<double, 13, 1>;

int march_derivative(realtype, N_Vector y_vector, N_Vector dy_vector, void* equations) {
  const RodEquations& rod = *static_cast<const RodEquations*>(equations);
  const Eigen::Map<const MarchState> y(N_VGetArrayPointer(y_vector));
  Eigen::Map<MarchState> dy(N_VGetArrayPointer(dy_vector));
  const Vector4d q = y.head<4>();
  const Vector3d n = y.segment<3>(4), m = y.segment<3>(7);
  Vector3d dn, dm;
  rod.wrench_derivative_S(n, m, dn, dm);
  dy.head<4>() = -quaternion_derivative(q, rod.curvature_S(m));
  dy.segment<3>(4) = -dn;
  dy.segment<3>(7) = -dm;
  dy.tail<3>() = -(rotation_of(q) * rod.stretch_S(n));
  return dy.allFinite() ? 0 : -1;
}

constexpr long most_steps = 1'000'000;  // of a march, some three seconds

// SUNDIALS objects of one march.
class Integrator {
 public:
  explicit Integrator(double tolerance)
      : vector_(N_VNew_Serial(MarchState::RowsAtCompileTime, context_)),
        cvode_(CVodeCreate(CV_ADAMS, context_)),
        solver_(SUNNonlinSol_FixedPoint(vector_, 0, context_)) {
    state().setZero();
    CVodeInit(cvode_, march_derivative, 0, vector_);
    CVodeSStolerances(cvode_, tolerance, tolerance);
    CVodeSetNonlinearSolver(cvode_, solver_);
    CVodeSetMaxNumSteps(cvode_, most_steps);
    CVodeSetErrHandlerFn(
        cvode_, [](int, const char*, const char*, char*, void*) {}, nullptr);
  }
  ~Integrator() {
    CVodeFree(&cvode_);
    SUNNonlinSolFree(solver_);
    N_VDestroy(vector_);
  }
  Integrator(const Integrator&) = delete;
  Integrator& operator=(const Integrator&) = delete;

  Eigen::Map<MarchState> state() { return Eigen::Map<MarchState>(N_VGetArrayPointer(vector_)); }

  // Forgets the steps taken so far: the equations change at t.
  void restart(double t, RodEquations& rod) {
    CVodeSetUserData(cvode_, &rod);
    state().head<4>().normalize();
    CVodeReInit(cvode_, t, vector_);
  }

  // Ends exactly there, without interpolation.
  bool advance_to(double t) {
    realtype reached = 0;
    CVodeSetStopTime(cvode_, t);
    return CVode(cvode_, t, vector_, &reached, CV_NORMAL) >= 0 && state().allFinite();
  }

  long steps() const {
    long count = 0;
    CVodeGetNumSteps(cvode_, &count);
    return count;
  }

 private:
  sundials::Context context_;
  N_Vector vector_;
  void* cvode_;
  SUNNonlinearSolver solver_;
};

struct March {
  bool finished = false;
  std::vector<MarchState> states;  // at the places given, clamp first
  double invariant_drift = 0;      // of |n| and m.n within a span, relative
  long steps = 0;
};

double drift(const MarchState& a, const MarchState& b) {
  const Vector3d n0 = a.segment<3>(4), m0 = a.segment<3>(7), n1 = b.segment<3>(4), m1 = b.segment<3>(7);
  return std::max(std::abs(n1.norm() - n0.norm()) / (1 + n0.norm()),
                  std::abs(m1.dot(n1) - m0.dot(n0)) / (1 + n0.norm() * m0.norm()));
}

March march(const ScaledRod& rod, const std::vector<double>& places, double tolerance) {
  March result;
  result.states.resize(places.size());
  Integrator integrator(tolerance);
  integrator.state()[0] = 1;
  const double tip = rod.spans.back().end;
  std::size_t k = places.size() - 1;
  result.states[k] = integrator.state();
  for (auto span = rod.spans.rbegin(); span != rod.spans.rend(); ++span) {
    RodEquations equations(*span, 1);
    integrator.state().segment<3>(4) += span->follower_load_S.force_N;
    integrator.state().segment<3>(7) += span->follower_load_S.moment_Nmm;
    integrator.restart(tip - span->end, equations);
    const MarchState start = integrator.state();
    while (k > 0 && places[k] > span->start) {
      if (result.steps + integrator.steps() > most_steps) return result;
      if (!integrator.advance_to(tip - places[--k])) return result;
      result.states[k] = integrator.state();
    }
    result.steps += integrator.steps();
    const bool invariant = span->follower_density_S.isZero(0) && span->tendon_S.is_zero();
    if (invariant) result.invariant_drift = std::max(result.invariant_drift, drift(start, integrator.state()));
  }
  result.finished = true;
  return result;
}

// The stations in the base frame: the clamp's frame, which the march reaches last.
std::vector<scene::Station> stations_of(const ScaledRod& rod, const std::vector<double>& places, const March& march) {
  const Vector4d clamp = march.states[0].head<4>().normalized();
  const Vector4d clamp_inverse(clamp[0], -clamp[1], -clamp[2], -clamp[3]);
  const Eigen::Matrix3d R_BT = rotation_of(clamp_inverse);
  std::vector<scene::Station> stations;
  for (std::size_t k = 0; k < places.size(); ++k) {
    const MarchState& y = march.states[k];
    scene::Station station = station_of(rod, places[k], y.head<4>(), R_BT * (y.tail<3>() - march.states[0].tail<3>()));
    station.X_BS.rotation_BS = R_BT * station.X_BS.rotation_BS;
    stations.push_back(station);
  }
  return stations;
}

double turning_rad(const ScaledRod& rod, const std::vector<double>& places, const March& march) {
  double turning = 0;
  std::size_t k = 1;
  for (const ScaledSpan& span : rod.spans) {
    const RodEquations equations(span, 1);
    for (; k < places.size() && places[k] <= span.end; ++k) {
      turning += (places[k] - places[k - 1]) * equations.curvature_S(march.states[k].segment<3>(7)).norm();
    }
  }
  return turning;
}

// Two marches, the second with a tenth of the first one's tolerance, at more places where the rod turns much.
struct MarchPair {
  std::vector<double> places;
  March rough, fine;
  bool finished() const { return rough.finished && fine.finished; }
};

MarchPair march_twice(const ScaledRod& rod, double tolerance) {
  MarchPair pair;
  pair.places = station_places(rod, equal_parts_for(0));
  pair.rough = march(rod, pair.places, 10 * tolerance);
  if (!pair.rough.finished) return pair;
  const int equal_parts = equal_parts_for(turning_rad(rod, pair.places, pair.rough));
  pair.places = station_places(rod, equal_parts);
  pair.fine = march(rod, pair.places, tolerance);
  return pair;
}

}  // namespace

scene::Equilibrium solve_initial_value(const ScaledRod& rod, double tolerance) {
  scene::Equilibrium result;
  const double cvode_tolerance = std::clamp(tolerance / 500, 2e-15, 1e-6);
  MarchPair pair = march_twice(rod, cvode_tolerance);
  if (!pair.finished()) pair = march_twice(rod, 10 * cvode_tolerance);  // round-off can keep CVODE from the tighter one
  if (!pair.finished()) {
    result.status = scene::Status::not_converged;
    result.message = "the integration from the tip stopped: more than 1e6 steps, or a value that is not finite";
    return result;
  }
  const March &rough = pair.rough, &fine = pair.fine;
  result.status = scene::Status::converged;
  result.stations = stations_of(rod, pair.places, fine);
  const scene::Pose rough_tip = stations_of(rod, {0, 1}, {true, {rough.states.front(), rough.states.back()}})[1].X_BS;
  const double difference = (rough_tip.position_B_mm - result.tip().position_B_mm).norm() / rod.length_mm +
                            (rough_tip.rotation_BS - result.tip().rotation_BS).norm();
  constexpr double roundoff_per_step = 2e-16;
  result.error_estimate_mm = rod.length_mm * (std::max(difference, fine.invariant_drift) +
                                              roundoff_per_step * static_cast<double>(fine.steps));
  result.tip_angle_rad = scene::total_angle_rad(result.stations);
  set_base_wrench(result, rod, fine.states[0].segment<3>(4), fine.states[0].segment<3>(7));
  result.model.emplace_back("steps", static_cast<int>(fine.steps));
  return result;
}

}  // namespace exact_reference
