// The planar elastica in closed form: a straight, uniform, inextensible, unshearable cantilever under a force and a
// moment at its tip, by elliptic integrals and Jacobi functions. The oldest of the exact references; it judges the
// others.
//
// The angle between tangent and force obeys EI psi'' = F sin psi, a pendulum. With w = sqrt(F L^2/EI):
//
//   error of position / L and of angle         while
//   < 1e-13                                    0.05 <= w <= 200, follower loads or a fixed force alone
//   about 1e-16 / w                            w < 0.05, with k = M L / (2 EI w) < 1
//   about 1e-15 k^2                            k > 1: the moment dominates (exact at F = 0: a circle)
//   about 1e-16 exp(w)                         a fixed force together with a moment, w > 6
//
// k near 1 is no weak point: the complementary modulus is carried itself, not as 1 - k^2. GSL's gsl_sf_elljac_e takes
// k^2 and loses it there, so sn and cn are found here by Bulirsch's descending Landen steps from the complementary
// modulus; a test holds the two together where both are good. Integrals: GSL's Carlson forms R_F, R_D.
#pragma once

#include <Eigen/Core>

#include <optional>

namespace exact_reference {

struct PlanarCantilever {
  double length_mm = 0;
  double bending_stiffness_Nmm2 = 0;
  Eigen::Vector2d tip_force_N = Eigen::Vector2d::Zero();
  double tip_moment_Nmm = 0;
};

struct PlanarPose {
  Eigen::Vector2d position_B_mm = Eigen::Vector2d::Zero();
  double angle_rad = 0;  // of the tangent, counted through full turns
};

// Jacobi's amplitude am(u) for any real u, from the square of the complementary modulus, 0 < k'^2 <= 1.
double jacobi_amplitude(double u, double complementary_modulus_squared);

// Legendre's integrals F(phi, k), E(phi, k) for any real phi.
double elliptic_integral_F(double phi, double complementary_modulus_squared);
double elliptic_integral_E(double phi, double complementary_modulus_squared);

class Elastica {
 public:
  // Force and moment in the tip's frame.
  static Elastica with_follower_load(const PlanarCantilever& cantilever);

  // Force in the base frame, on the branch that grows from no load; a rod pushed exactly along its axis stays straight.
  // Empty if that branch cannot be followed (force together with moment only).
  static std::optional<Elastica> with_fixed_load(const PlanarCantilever& cantilever);

  PlanarPose at(double s_mm) const;
  PlanarPose tip() const { return at(length_mm_); }

 private:
  Elastica(double length_mm, double w, double force_angle, double angle_to_force, double curvature);

  // Tangent's angle to the force and the integrals of its cosine and sine, at `distance` / L from the tip.
  struct FromTip {
    double angle_to_force = 0;
    Eigen::Vector2d along_force = Eigen::Vector2d::Zero();
  };
  FromTip from_tip(double distance) const;
  FromTip swinging(double distance) const;  // k < 1: the pendulum turns back
  FromTip rolling(double distance) const;   // k > 1

  double length_mm_;
  double w_;               // sqrt(F L^2/EI)
  double force_angle_;     // rad, in the base frame
  double angle_to_force_;  // of the tip's tangent, rad
  double curvature_;       // M L/EI at the tip
};

}  // namespace exact_reference
