#include "scene/estimation.h"
#include "scene/load_visitor.h"
#include "scene/text.h"

#include <Eigen/LU>

#include <cmath>
#include <tuple>

namespace scene {
namespace {

using Kind = Unknown::Kind;

constexpr double rotation_tolerance = 1e-6;  // of R^T R against the identity: files print six digits and more

bool is_same_rod(const Section& a, const Section& b) {
  const Stiffness k = stiffness_of(a), l = stiffness_of(b);
  const auto numbers = [](const Stiffness& s) {
    return std::tuple(s.torsion_Nmm2, s.bending_Nmm2, s.axial_N, s.shear_N, s.mass_per_length_kg_per_m);
  };
  return a.length_mm == b.length_mm && a.rest_curvature_per_mm == b.rest_curvature_per_mm && numbers(k) == numbers(l);
}

[[noreturn]] void refuse_at(const std::string& source, const std::string& path, const std::string& value,
                            const std::string& rule) {
  throw SceneError(source + ": " + path + " = " + value + ": " + rule);
}

// Checks one measurement, and makes no string where it is right: kept estimators meet a thousand a second.
class MeasurementChecker {
 public:
  MeasurementChecker(const std::string& source, const std::string& path) : source_(source), path_(path) {}

  void is_place(double s_mm, double length_mm) const {
    if (!(s_mm >= 0 && s_mm <= length_mm * (1 + same_place_relative)))
      refuse(".at", text(s_mm), "must be on the rod, 0 ... " + text(length_mm) + " mm");
  }
  void is_sd(const char* key, double sd) const {
    if (!(sd > 0)) refuse(key, text(sd), "a standard deviation must be > 0");
  }
  void operator()(const PositionMeasurement& position) const {
    is_finite(".value_mm", position.position_B_mm);
    is_sd(".sd_mm", position.sd_mm);
  }
  void operator()(const RotationMeasurement& rotation) const {
    const Eigen::Matrix3d& R = rotation.rotation_BS;
    const double off = (R.transpose() * R - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff();
    if (!(off <= rotation_tolerance && R.determinant() > 0)) {
      std::string rows;
      for (int i = 0; i < 3; ++i) rows += (i ? ", " : "") + text(R.row(i));
      refuse(".value", "[" + rows + "]", "must be a rotation: R^T R = 1 within 1e-6, det R = 1");
    }
    is_sd(".sd_rad", rotation.sd_rad);
  }
  void operator()(const CurvatureMeasurement& curvature) const {
    is_finite(".value_per_mm", curvature.curvature_S_per_mm);
    is_sd(".sd_per_mm", curvature.sd_per_mm);
  }
  void operator()(const BaseWrenchMeasurement& wrench) const {
    is_finite(".force_N", wrench.wrench_B.force_N);
    is_finite(".moment_Nmm", wrench.wrench_B.moment_Nmm);
    is_sd(".sd_N", wrench.sd_N);
    is_sd(".sd_Nmm", wrench.sd_Nmm);
  }

 private:
  [[noreturn]] void refuse(const char* key, const std::string& value, const std::string& rule) const {
    refuse_at(source_, path_ + key, value, rule);
  }
  template <class Vector>
  void is_finite(const char* key, const Vector& values) const {
    if (!values.allFinite()) refuse(key, text(values), "must be finite");
  }

  const std::string& source_;
  const std::string& path_;
};

// Checks one problem; each check names the JSON path of the value that it looks at.
class EstimationChecker {
 public:
  EstimationChecker(const EstimationProblem& problem, const std::string& source, bool in_list)
      : problem_(problem), source_(source), in_list_(in_list) {}

  void check() const {
    require(!problem_.scenes.empty(), "scenes", "[]", "must hold a scene");
    for (std::size_t i = 0; i < problem_.scenes.size(); ++i) check(problem_.scenes[i], path_of_scene(i));
    require(!problem_.unknowns.empty(), "unknowns", "[]", "must hold an unknown");
    for (std::size_t i = 0; i < problem_.unknowns.size(); ++i) check_unknown(i, "unknowns[" + std::to_string(i) + "]");
  }

 private:
  std::string path_of_scene(std::size_t i) const { return in_list_ ? "scenes[" + std::to_string(i) + "]." : ""; }
  void require(bool rule_holds, const std::string& path, const std::string& value, const std::string& rule) const {
    if (!rule_holds) refuse_at(source_, path, value, rule);
  }

  void check(const MeasuredScene& measured, const std::string& path) const {
    validate(measured.scene, source_, path + "scene");
    const double length = length_mm(measured.scene);
    require(!measured.measurements.empty(), path + "measurements", "[]", "must hold a measurement");
    for (std::size_t i = 0; i < measured.measurements.size(); ++i)
      validate(measured.measurements[i], length, source_, path + "measurements[" + std::to_string(i) + "]");
    const std::vector<Section>&sections = measured.scene.sections, &first = problem_.scenes.front().scene.sections;
    require(sections.size() == first.size(), path + "scene.rod.sections", std::to_string(sections.size()) + " sections",
            "must be those of the first scene: the rod is one");
    for (std::size_t i = 0; i < sections.size(); ++i)
      require(is_same_rod(sections[i], first[i]), path + "scene.rod.sections[" + std::to_string(i) + "]", "another one",
              "must be that of the first scene: the rod is one");
  }

  void is_one_of(const std::string& path, std::size_t index, std::size_t count, const std::string& what) const {
    require(index < count, path, std::to_string(index),
            "there are " + std::to_string(count) + " " + what + ", counted from 0");
  }

  void check_unknown(std::size_t i, const std::string& path) const {
    const Unknown& unknown = problem_.unknowns[i];
    is_one_of(path + ".scene", unknown.scene, problem_.scenes.size(), "scenes");
    const Scene& scene = problem_.scenes[unknown.scene].scene;
    if (unknown.kind == Kind::component || unknown.kind == Kind::place) check_load(unknown, scene, path);
    else check_section(unknown, scene, path);
    const std::string mean = path + ".prior_mean";
    require(std::isfinite(unknown.prior_mean), mean, text(unknown.prior_mean), "must be finite");
    if (unknown.prior_sd) MeasurementChecker(source_, path).is_sd(".prior_sd", *unknown.prior_sd);
    const auto key = [](const Unknown& u) { return std::tuple(u.kind, u.scene, u.index, u.component); };
    for (std::size_t other = 0; other < i; ++other)
      require(key(problem_.unknowns[other]) != key(unknown), path, name_of(unknown, problem_), "is unknown already");
  }
  void check_load(const Unknown& unknown, const Scene& scene, const std::string& path) const {
    is_one_of(path + ".load", unknown.index, scene.loads.size(), "loads");
    const Load& load = scene.loads[unknown.index];
    const double length = length_mm(scene);
    if (unknown.kind == Kind::place) {
      require(has_place(load), path + ".load", std::to_string(unknown.index),
              "only a force or a moment stands at a place that can be found");
      require(unknown.prior_mean >= 0 && unknown.prior_mean <= length * (1 + same_place_relative), path + ".prior_mean",
              text(unknown.prior_mean), "must be on the rod, 0 ... " + text(length) + " mm");
    } else {
      const int components = tendon_of(load) ? 1 : 3;
      require(unknown.component >= 0 && unknown.component < components, path + ".component",
              std::to_string(unknown.component),
              std::string("the component of a ") + kind_name(load) + " must be below " + std::to_string(components));
    }
  }
  void check_section(const Unknown& unknown, const Scene& scene, const std::string& path) const {
    is_one_of(path + ".section", unknown.index, scene.sections.size(), "sections");
    if (unknown.kind == Kind::rest_curvature) {
      require(unknown.component == 1 || unknown.component == 2, path + ".component", std::to_string(unknown.component),
              "of a rest curvature must be 1 or 2");
    } else {
      require(unknown.prior_mean > 0, path + ".prior_mean", text(unknown.prior_mean), "a factor must be > 0");
    }
  }

  const EstimationProblem& problem_;
  const std::string& source_;
  const bool in_list_;
};

}  // namespace

void validate(const Measurement& measurement, double length_mm, const std::string& source, const std::string& path) {
  const MeasurementChecker check(source, path);
  if (!std::holds_alternative<BaseWrenchMeasurement>(measurement.value)) check.is_place(measurement.s_mm, length_mm);
  std::visit(check, measurement.value);
}

void validate(const EstimationProblem& problem, const std::string& source, std::optional<bool> in_list) {
  EstimationChecker(problem, source, in_list.value_or(problem.scenes.size() > 1)).check();
}

}  // namespace scene
