#include "exact_reference/initial_value.h"

#include "exact_reference/rod_equations.h"
#include "exact_reference/solve.h"
#include "exact_reference/stations.h"

#include <Eigen/Geometry>

#include <cvode/cvode.h>
#include <nvector/nvector_serial.h>
#include <sundials/sundials_context.h>
#include <sunnonlinsol/sunnonlinsol_fixedpoint.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

namespace exact_reference {
namespace {

using Eigen::Vector3d;
using Eigen::Vector4d;

// State of the march, in the frame T that it starts from: q 0-3 (section frame in T), n 4-6 and m 7-9 (section frame),
// p 10-12 (in T). T is the tip's, and the independent variable the arc length from there, where all loads follow; it is
// the clamp's, and the arc length the rod's, where the moments are known (ScaledRod::moments_are_known).
using MarchState = Eigen::Matrix<double, 13, 1>;

// The equations of a span, and whether a tendon's path lost its length where they were last evaluated.
struct MarchedSpan {
  RodEquations rod;
  double way = -1;  // 1: from the clamp
  bool has_tendon = false;
  bool tendon_collapsed = false;
};

int march_derivative(realtype, N_Vector y_vector, N_Vector dy_vector, void* marched_span) {
  MarchedSpan& span = *static_cast<MarchedSpan*>(marched_span);
  const RodEquations& rod = span.rod;
  const Eigen::Map<const MarchState> y(N_VGetArrayPointer(y_vector));
  Eigen::Map<MarchState> dy(N_VGetArrayPointer(dy_vector));
  const Vector4d q = y.head<4>();
  const Vector3d n = y.segment<3>(4), m = y.segment<3>(7);
  const auto [u, v] = rod.strains_S(n, m);
  Vector3d dn, dm;
  rod.wrench_derivative_S(n, m, {u, v}, dn, dm);
  dy.head<4>() = span.way * quaternion_derivative(q, u);
  dy.segment<3>(4) = span.way * dn;
  dy.segment<3>(7) = span.way * dm;
  dy.tail<3>() = span.way * (rotation_of(q) * v);
  span.tendon_collapsed = span.has_tendon && y.allFinite() && !u.allFinite();
  if (span.tendon_collapsed) return 1;  // a shorter step may do
  return dy.allFinite() ? 0 : -1;
}

// Of a march, some three seconds; a section with tendons takes ten times as long to solve.
constexpr long most_steps_elastic = 1'000'000, most_steps_tendons = 50'000;

long most_steps(const ScaledRod& rod) {
  const bool tendons =
      std::any_of(rod.spans.begin(), rod.spans.end(), [](const ScaledSpan& span) { return !span.tendons.empty(); });
  return tendons ? most_steps_tendons : most_steps_elastic;
}

// SUNDIALS objects of one march.
class Integrator {
 public:
  Integrator(double tolerance, long most_steps)
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
  void restart(double t, MarchedSpan& span) {
    CVodeSetUserData(cvode_, &span);
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
  bool tendon_collapsed = false;
  std::vector<MarchState> states;  // at the places given, clamp first
  double invariant_drift = 0;      // of |n| and m.n within a span, relative
  long steps = 0;
};

Vector4d product(const Vector4d& a, const Vector4d& b) {
  const Vector3d v = a.tail<3>(), w = b.tail<3>();
  Vector4d q;
  q << a[0] * b[0] - v.dot(w), a[0] * w + b[0] * v + v.cross(w);
  return q;
}

double drift(const MarchState& a, const MarchState& b) {
  const Vector3d n0 = a.segment<3>(4), m0 = a.segment<3>(7), n1 = b.segment<3>(4), m1 = b.segment<3>(7);
  return std::max(std::abs(n1.norm() - n0.norm()) / (1 + n0.norm()),
                  std::abs(m1.dot(n1) - m0.dot(n0)) / (1 + n0.norm() * m0.norm()));
}

March march_from_clamp(const ScaledRod& rod, const std::vector<double>& places, double tolerance) {
  March result;
  result.states.resize(places.size());
  Integrator integrator(tolerance, most_steps(rod));
  integrator.state()[0] = 1;
  for (const ScaledSpan& span : rod.spans) integrator.state().segment<3>(7) += span.fixed_load_B.moment_Nmm;
  result.states[0] = integrator.state();
  std::size_t k = 0;
  for (const ScaledSpan& span : rod.spans) {
    MarchedSpan marched{RodEquations(span, 1), 1};
    integrator.restart(span.start, marched);
    const double moment = integrator.state().segment<3>(7).norm();
    while (k + 1 < places.size() && places[k + 1] <= span.end) {
      if (result.steps + integrator.steps() > most_steps(rod) || !integrator.advance_to(places[++k])) return result;
      result.states[k] = integrator.state();
    }
    result.steps += integrator.steps();
    const double change = std::abs(integrator.state().segment<3>(7).norm() - moment);
    result.invariant_drift = std::max(result.invariant_drift, change / (1 + moment));
    integrator.state().segment<3>(7) -=
        rotation_of(integrator.state().head<4>().normalized()).transpose() * span.fixed_load_B.moment_Nmm;
  }
  result.finished = true;
  return result;
}

March march(const ScaledRod& rod, const std::vector<double>& places, double tolerance) {
  if (rod.moments_are_known()) return march_from_clamp(rod, places, tolerance);
  March result;
  result.states.resize(places.size());
  Integrator integrator(tolerance, most_steps(rod));
  integrator.state()[0] = 1;
  const double tip = rod.spans.back().end;
  std::size_t k = places.size() - 1;
  for (auto span = rod.spans.rbegin(); span != rod.spans.rend(); ++span) {
    MarchedSpan marched{RodEquations(*span, 1), -1, !span->tendons.empty()};
    integrator.state().segment<3>(4) += span->follower_load_S.force_N;
    integrator.state().segment<3>(7) += span->follower_load_S.moment_Nmm;
    integrator.restart(tip - span->end, marched);
    const MarchState start = result.states[k] = integrator.state();
    while (k > 0 && places[k] > span->start) {
      if (result.steps + integrator.steps() > most_steps(rod)) return result;
      if (!integrator.advance_to(tip - places[--k])) {
        result.tendon_collapsed = marched.tendon_collapsed;
        return result;
      }
      result.states[k] = integrator.state();
    }
    result.steps += integrator.steps();
    const bool invariant = span->follower_density_S.isZero(0);
    if (invariant) result.invariant_drift = std::max(result.invariant_drift, drift(start, integrator.state()));
  }
  result.finished = true;
  return result;
}

// The states in the base frame: the clamp's frame, which the march reaches last.
std::vector<PlacedState> states_in_base_frame(const std::vector<double>& places, const March& march) {
  const Vector4d clamp = march.states[0].head<4>().normalized();
  const Vector4d clamp_inverse(clamp[0], -clamp[1], -clamp[2], -clamp[3]);
  const Eigen::Matrix3d R_BT = rotation_of(clamp_inverse);
  std::vector<PlacedState> states;
  for (std::size_t k = 0; k < places.size(); ++k) {
    const MarchState& y = march.states[k];
    const Vector4d q = product(clamp_inverse, y.head<4>().normalized());
    const Eigen::Matrix3d R = rotation_of(q);
    PlacedState& state = states.emplace_back();
    state.place = places[k];
    state.state << q, R * y.segment<3>(4), R * y.segment<3>(7), R_BT * (y.tail<3>() - march.states[0].tail<3>());
  }
  return states;
}

// Two marches, `fine` with a tenth of the tolerance of `rough`.
struct MarchPair {
  std::vector<double> places;
  March rough, fine;
  bool finished() const { return rough.finished && fine.finished; }
};

// Close enough together for the turn of the rod, which quick marches tell.
std::vector<double> places_by_turn(const ScaledRod& rod) {
  constexpr double tolerance = 1e-6;
  constexpr int most_rounds = 8;
  std::vector<double> places = station_places(rod);
  for (int round = 0; round < most_rounds; ++round) {
    const March quick = march(rod, places, tolerance);
    if (!quick.finished) break;
    std::vector<double> closer = station_places(rod, turns_of(rod, states_in_base_frame(places, quick)));
    if (closer.size() <= places.size()) break;
    places = std::move(closer);
  }
  return places;
}

MarchPair march_twice(const ScaledRod& rod, const std::vector<double>& places, double tolerance) {
  MarchPair pair;
  pair.places = places;
  pair.rough = march(rod, places, 10 * tolerance);
  if (!pair.rough.finished) return pair;
  pair.fine = march(rod, places, tolerance);
  if (pair.fine.finished) return pair;
  pair.fine = std::move(pair.rough);  // round-off can keep CVODE from the tighter one
  pair.rough = march(rod, places, 100 * tolerance);
  return pair;
}

// Largest distance of the rough march's stations from the fine one's, and the change of the tip's rotation.
double difference(const std::vector<PlacedState>& rough, const std::vector<PlacedState>& fine) {
  double distance = 0;
  for (std::size_t k = 0; k < fine.size(); ++k) {
    distance = std::max(distance, (rough[k].state.tail<3>() - fine[k].state.tail<3>()).norm());
  }
  return distance + (rotation_of(rough.back().state.head<4>()) - rotation_of(fine.back().state.head<4>())).norm();
}

scene::Equilibrium stopped(bool tendon_collapsed) {
  scene::Equilibrium result;
  result.status = tendon_collapsed ? scene::Status::tendon_collapsed : scene::Status::work_limit;
  result.message = tendon_collapsed
                       ? "the rod bends so far that the path of a tendon has no length somewhere"
                       : "the integration along the rod stopped: more than 1e6 steps, or a value that is not finite";
  return result;
}

double error_over_L(const MarchPair& pair) {
  constexpr double roundoff_per_step = 2e-16;
  const double change =
      difference(states_in_base_frame(pair.places, pair.rough), states_in_base_frame(pair.places, pair.fine));
  return std::max(change, pair.fine.invariant_drift) + roundoff_per_step * static_cast<double>(pair.fine.steps);
}

scene::Equilibrium not_accurate(double error) {
  scene::Equilibrium result;
  result.status = scene::Status::not_converged;
  char text[100];
  std::snprintf(text, sizeof text, "two tolerances of the integration still differ by %.3g of the length", error);
  result.message = text;
  return result;
}

}  // namespace

scene::Equilibrium solve_initial_value(const ScaledRod& rod, double tolerance) {
  constexpr double tightest = 2e-15, tighter = 0.01;  // the latter chosen, not measured
  const double allowed = std::max(worst_error, tolerance);
  const std::vector<double> places = places_by_turn(rod);
  MarchPair pair;
  double error = HUGE_VAL;
  for (double cvode = std::clamp(tolerance / 500, tightest, 1e-6);; cvode = std::max(tightest, tighter * cvode)) {
    pair = march_twice(rod, places, cvode);
    if (!pair.finished()) return stopped(pair.rough.tendon_collapsed || pair.fine.tendon_collapsed);
    error = error_over_L(pair);
    if (error <= allowed || cvode <= tightest) break;
  }
  if (!(error <= allowed)) return not_accurate(error);
  const std::vector<PlacedState> states = states_in_base_frame(places, pair.fine);
  scene::Equilibrium result;
  result.status = scene::Status::converged;
  set_shape(result, rod, states);
  result.tendon_shortening_mm = tendon_shortening_mm(rod, states);
  result.error_estimate_mm = rod.length_mm * error;
  result.model.emplace_back("steps", static_cast<int>(pair.fine.steps));
  return result;
}

}  // namespace exact_reference
