// Solved rods for the tests of derivatives: the kernel's own boundary value problem, its answers, and their central
// differences, extrapolated from two steps. Differences stand beside the code under test: they solve the changed scene.
#pragma once

#include "fam/boundary_value.h"
#include "fam/response.h"
#include "fam/rotation.h"
#include "fam/shape.h"
#include "fam/solver.h"
#include "support.h"

#include <memory>

namespace support {

using What = fam::Response::What;
using Columns = fam::Response::Columns;
using Vector6 = Eigen::Matrix<double, 6, 1>;
using Kind = fam::Parameter::Kind;

scene::RodModel model_of(const scene::Scene& scene);

// Of a fixed number of arcs in each span, from no load.
class SolvedRod {
 public:
  SolvedRod(scene::Scene scene, int arcs, fam::Law law = fam::Law::sixth_order);
  SolvedRod(scene::Scene scene, std::vector<int> arcs_per_span, fam::Law law);

  bool converged() const { return converged_; }
  const scene::Scene& scene() const { return scene_; }
  const std::vector<int>& arcs_per_span() const { return arcs_per_span_; }
  fam::Law law() const { return law_; }
  fam::SolvedRod<3> solved() const { return rod_->solved(); }
  double length_mm() const { return spans_.back().end_mm; }
  fam::BasicShape<3>::Section section(double s_mm) const;
  fam::BasicScrew<double, 3> strain_per_mm(double s_mm) const;
  fam::Response& response() { return response_; }

 private:
  std::pair<fam::ArcInterior<3>, double> place(double s_mm) const;  // its arc, and the fraction of that

  scene::Scene scene_;
  std::vector<scene::Span> spans_;
  scene::SpanCutter cutter_;
  fam::GrowingLoads loads_;
  std::vector<int> arcs_per_span_;
  fam::Law law_;
  std::unique_ptr<fam::BasicBoundaryValue<3>> rod_;
  std::unique_ptr<fam::BasicShape<3>> shape_;
  fam::Response response_;
  bool converged_;
};

// The scene with one of its numbers changed.
scene::Scene changed(scene::Scene scene, const fam::Parameter& parameter, double change);
// A step for the differences: small against the rod's stiffness.
double step_of(const scene::Scene& scene, const fam::Parameter& parameter);
// All of a scene: loads (three components, a tendon one), rest curvatures, stiffnesses, places below the tip.
std::vector<fam::Parameter> parameters_of(const scene::Scene& scene);

Vector6 derivative(fam::Response& response, const fam::Parameter& parameter, double s_mm, What what);
// Central differences by a parameter; by a slack tendon, which cannot push, towards more tension.
class Differences {
 public:
  Differences(const SolvedRod& rod, const fam::Parameter& parameter);
  // NaN where a changed rod is not solved.
  Vector6 at(double s_mm, What what) const;

 private:
  Vector6 between(std::size_t more, std::size_t less, double s_mm, What what) const;

  double step_;
  bool one_sided_;
  std::vector<SolvedRod> rods_;  // step, -step, step/2, -step/2; one-sided: step, 0, step/2, step/4
};

}  // namespace support
