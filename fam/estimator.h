// Loads, places, stiffness factors and rest curvatures from what was measured of a rod's shape: maximum a posteriori,
// by Gauss-Newton on the derivatives of fam/solver.h.
//
// With x the unknowns in units of their own (EI/L^2, EI/L, L, 1, 1/L), r(x) what is measured less what the model gives,
// over the standard deviations, the priors' rows among them, and J = dr/dx, a step solves
//   (J^T J + lambda D) dx = -J^T r,   D = diag(J^T J), at least 1e-6 of its largest,
// and lambda falls where chi-squared r.r does. Converged: r.r could fall by less than 1e-8 (1 + r.r) in a step without
// damping, in the directions that can be observed, or where none is left to unknowns that a bound or corner does not
// hold. Where places are unknown and the minimum found does not fit, or none is found, the search begins again from
// twelve places spread over the rod, and the lowest minimum counts; then each cell of a place between sensors of
// curvature is looked at (fam/place_cells.h), in a stream those next to it.
#pragma once

#include "fam/solver.h"

#include "scene/estimation.h"

#include <Eigen/Core>

#include <string>
#include <vector>

namespace fam {

struct Estimate {
  scene::Status status = scene::Status::not_converged;
  std::string message;  // empty when converged and the model fits
  // In the order of the unknowns, in the units of the scene. NaN: not observable; all of it where not converged.
  Eigen::VectorXd mean, sd;
  std::vector<bool> observable;
  // The inverse of J^T J, J from no farther off than the last, small step; where other cells of a place count too, the
  // second moment of all about the mean. Rows and columns of what is not observable are NaN.
  Eigen::MatrixXd covariance;
  // The directions of the unknowns (in units of their own, of length 1) of which the measurements tell nothing: whose
  // posterior is no narrower than 0.9 of the prior, or, without a prior, of which their information is below 1e-12 of
  // the largest.
  std::vector<Eigen::VectorXd> unobservable;
  double chi_squared = 0;
  int degrees_of_freedom = 0;
  bool fits = false;  // chi-squared is below what one in 1000 exceeds
  int iterations = 0;
  scene::EstimationProblem problem;  // with the values put in

  bool converged() const { return status == scene::Status::converged; }
};

// Keeps its solvers and its last solution: the next estimate starts there. New measurements of the same kinds
// come by set_measurement. Throws scene::SceneError on wrong input.
class Estimator {
 public:
  // Options as of solve(); without arcs and tolerance the model is solved within 0.03 of the smallest standard
  // deviation (rotations times L, curvatures times L^2; 1e-8 to 1e-6 L).
  explicit Estimator(scene::EstimationProblem problem, const Options& options = {});
  Estimator(Estimator&&) noexcept;
  Estimator& operator=(Estimator&&) noexcept;
  ~Estimator();

  const scene::EstimationProblem& problem() const;
  void set_measurement(std::size_t scene, std::size_t measurement, const scene::Measurement& value);
  Estimate estimate();
  // The same where it is kept, for streams: the first takes the memory of the next ones, which take none once a rod
  // with these loads has been solved (directions that cannot be observed, other cells of a place and failures do).
  const Estimate& track();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace fam
