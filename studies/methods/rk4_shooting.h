// The competitor "plain shooting": the Cosserat rod equations as they are commonly integrated in continuum robotics.
// The internal force and moment at the clamp are guessed, the rod is integrated from the clamp to the tip by the
// classical Runge-Kutta method with steps of fixed length, and Newton's method with forward differences mends the
// guess until what is left beyond the tip vanishes:
//
//   p' = R v   q' = 1/2 q (0, u)   n' = -f_B - R f_S   m' = -p' x n   u = u0 + K_u^-1 R^T m   v = e_x + K_v^-1 R^T n
//
// all in the base frame, q a unit quaternion, normalised after each step. No load steps, no damping, no safeguard: from
// zero, or from a guess that is handed in. Units inside: the length L of the rod, the least bending or torsional
// stiffness EI, forces EI/L^2, moments EI/L.
//
// Where tendons run, n and m are the rod's with the tendons', which balance the loads as before; the rod's own, in the
// equations of u and v, are less by T t/|t| and r x T t/|t|, t = v + u x r (Rucker and Webster, IEEE T-RO 27(6), 2011).
// That makes u and v implicit: found in each stage by Newton's iteration from the strains at the start of the span,
// with the slope there, inverted once a span and shot. Nothing watches for tendons whose path collapses.
//
// Any load of a scene, several sections.
#pragma once

#include "scene/equilibrium.h"
#include "scene/span.h"

#include <span>
#include <vector>

namespace studies {

class Rk4Shooting {
 public:
  using Vector6d = Eigen::Matrix<double, 6, 1>;
  using Matrix6d = Eigen::Matrix<double, 6, 6>;
  using State = Eigen::Matrix<double, 13, 1>;  // q (w, x, y, z), p, n, m

  static constexpr double tolerance = 1e-10;  // largest component of the residual, units above
  static constexpr int max_iterations = 50;

  // Allocates all it needs. steps_per_span: at least one for each span.
  Rk4Shooting(std::span<const scene::Span> spans, std::span<const int> steps_per_span, bool with_shear);

  // Newton from a guess of the internal force and moment at the clamp (scaled, base frame).
  //   converged      residual <= tolerance
  //   not_converged  residual > tolerance after max_iterations
  //   not_finite     overflow, or strains that were not found where tendons run
  // Nothing keeps Newton to the equilibrium that the rod reaches from its unloaded shape.
  scene::Status run(const Vector6d& guess = Vector6d::Zero()) noexcept;

  const Vector6d& base_wrench() const { return base_wrench_; }  // scaled, with the tendons'
  double residual() const { return residual_; }
  int iterations() const { return iterations_; }

  // After run(), in mm, N, N mm, the rod's own: at the ends of the steps and at s = k L/40, where a shorter step leads.
  std::vector<scene::Station> stations() const;

 private:
  enum class Section { kirchhoff, reissner, tendons };  // what its strains are found from
  struct Strains {
    Eigen::Vector3d u, v;  // section frame
  };
  // What Newton's iteration for the strains of a section with tendons starts from.
  struct Near {
    Strains strains;
    Matrix6d slope_inverse;  // of the equations of (u, v)
  };
  struct SpanSteps {
    Section section;
    double step;
    int count;
    Eigen::Vector3d rest_curvature, bending_compliance, shear_compliance;
    Eigen::Vector3d fixed_density_B, follower_density_S;
    bool has_follower_density;
    scene::Wrench fixed_load_B, follower_load_S;  // at the span's distal end, scaled
    Eigen::Matrix3d fixed_force_arms;             // sum F r^T of the fixed forces off the centreline there, scaled
    bool has_arms;
    std::vector<scene::SectionTendon> tendons;  // scaled
    Near at_rest, at_start;                     // of the span, in this shot
  };

  // What the tendons of a section press it with: the rod's own wrench is the total less this.
  static scene::Wrench tendon_pull_S(const SpanSteps& span, const Strains& strains);
  static Near near(const SpanSteps& span, const Strains& strains);
  static Strains strains_of(const SpanSteps& span, const Near& start, const State& y);

  template <Section section>
  static State derivative(const SpanSteps& span, const State& y);
  template <Section section>
  static State step(const SpanSteps& span, const State& y, double h);
  static State step(const SpanSteps& span, const State& y, double h);
  static State beyond_point_loads(const SpanSteps& span, const State& y);
  scene::Station station(const SpanSteps& span, double place, const State& y) const;
  template <bool keep_states>
  Vector6d residual_of(const Vector6d& base_wrench);

  double length_mm_, stiffness_Nmm2_;
  std::vector<SpanSteps> spans_;
  std::vector<State> states_;  // clamp to tip, at the ends of the steps
  Vector6d base_wrench_ = Vector6d::Zero();
  double residual_ = 0;
  int iterations_ = 0;
};

}  // namespace studies
