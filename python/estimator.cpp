// fam.Estimator, fam.Estimate and fam.estimate.
#include "convert.h"

#include <atomic>
#include <cmath>

namespace fam_python {
namespace {

using fam::Estimate;
using scene::Measurement;

// Of these measurements' kinds; refused where the shape, a number or a rotation is wrong.
class NewValue {
 public:
  NewValue(py::handle value, std::string path) : value_(value), path_(std::move(path)) {}

  void operator()(scene::PositionMeasurement& m) const { m.position_B_mm = numbers(3, "3 numbers, mm"); }
  void operator()(scene::CurvatureMeasurement& m) const { m.curvature_S_per_mm = numbers(2, "2 numbers, 1/mm"); }
  void operator()(scene::BaseWrenchMeasurement& m) const {
    const Eigen::VectorXd wrench = numbers(6, "6 numbers: force, N, and moment, N mm");
    m.wrench_B = {wrench.head<3>(), wrench.tail<3>()};
  }
  void operator()(scene::RotationMeasurement& m) const {
    const Eigen::VectorXd rows = numbers(9, "3 rows of 3 numbers");
    const Eigen::Matrix3d rotation = Eigen::Map<const Eigen::Matrix3d>(rows.data()).transpose();
    const double off = (rotation.transpose() * rotation - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff();
    if (!(off <= 1e-6) || !(rotation.determinant() > 0))
      refuse(path_, value_, "must be a rotation: R^T R = 1 within 1e-6, det R = 1");
    m.rotation_BS = rotation;
  }

 private:
  Eigen::VectorXd numbers(py::ssize_t count, const std::string& what) const {
    const auto array = py::array_t<double, py::array::c_style | py::array::forcecast>::ensure(value_);
    PyErr_Clear();
    const bool is_matrix = array && array.ndim() == 2 && array.shape(0) == 3 && array.shape(1) == 3;
    const bool fits = array && array.size() == count && (count == 9 ? is_matrix : array.ndim() == 1);
    if (!fits) refuse(path_, value_, "must be " + what);
    const Eigen::VectorXd values = Eigen::Map<const Eigen::VectorXd>(array.data(), count);
    if (!values.allFinite()) refuse(path_, value_, "must be finite");
    return values;
  }

  py::handle value_;
  std::string path_;
};

class KeptEstimator {
 public:
  KeptEstimator(py::handle problem, const Keywords& keywords) : estimator_(problem_of(problem), options_of(keywords)) {}

  void set_measurement(py::ssize_t measurement, py::handle value, py::ssize_t scene) {
    const auto& scenes = estimator_.problem().scenes;
    if (scene < 0 || static_cast<std::size_t>(scene) >= scenes.size())
      throw py::index_error("scenes[" + std::to_string(scene) + "]: there are " + std::to_string(scenes.size()));
    const auto& list = scenes[static_cast<std::size_t>(scene)].measurements;
    if (measurement < 0 || static_cast<std::size_t>(measurement) >= list.size())
      throw py::index_error("measurements[" + std::to_string(measurement) + "]: there are " +
                            std::to_string(list.size()));
    Measurement changed = list[static_cast<std::size_t>(measurement)];
    std::visit(NewValue(value, "problem: measurements[" + std::to_string(measurement) + "].value"), changed.value);
    const Turn turn(busy_);
    estimator_.set_measurement(static_cast<std::size_t>(scene), static_cast<std::size_t>(measurement), changed);
  }

  Estimate estimate() {
    const Turn turn(busy_);
    const py::gil_scoped_release others_run;
    return estimator_.estimate();
  }

 private:
  struct Turn {
    explicit Turn(std::atomic<bool>& of_estimator) : busy(of_estimator) {
      if (busy.exchange(true)) throw std::runtime_error("another thread uses this estimator");
    }
    ~Turn() { busy = false; }
    std::atomic<bool>& busy;
  };

  fam::Estimator estimator_;
  std::atomic<bool> busy_ = false;
};

py::list names_of(const Estimate& estimate) {
  py::list names;
  for (const scene::Unknown& unknown : estimate.problem.unknowns)
    names.append(scene::name_of(unknown, estimate.problem));
  return names;
}

py::array_t<double> directions_of(const Estimate& estimate) {
  Eigen::MatrixXd rows(static_cast<Eigen::Index>(estimate.unobservable.size()), estimate.mean.size());
  for (std::size_t k = 0; k < estimate.unobservable.size(); ++k)
    rows.row(static_cast<Eigen::Index>(k)) = estimate.unobservable[k].transpose();
  return array_of(rows);
}

Estimate estimate_once(py::handle problem, py::object tolerance_mm, py::object arcs, py::object law, py::object model) {
  return KeptEstimator(problem, {tolerance_mm, arcs, law, model}).estimate();
}

void add_estimate(py::module_& module) {
  py::class_<Estimate>(
      module, "Estimate",
      "What fam.estimate gives. Unknowns are in the order of the problem's, in the units of the scene.")
      .def_property_readonly(
          "status", [](const Estimate& e) { return scene::name(e.status); }, "'converged', or why not.")
      .def_property_readonly("converged", &Estimate::converged, "status is 'converged'.")
      .def_readonly("message", &Estimate::message,
                    "One line: why not converged, or that the model does not fit; else empty.")
      .def_property_readonly("names", &names_of, "'loads[0].x, N', 'sections[1].bending_factor', ...")
      .def_property_readonly(
          "mean", [](const Estimate& e) { return array_of(e.mean); }, "(n,): NaN where an unknown cannot be observed.")
      .def_property_readonly(
          "sd", [](const Estimate& e) { return array_of(e.sd); }, "(n,): standard deviations, likewise.")
      .def_property_readonly(
          "observable",
          [](const Estimate& e) {
            py::list list;
            for (const bool one : e.observable) list.append(one);
            return list;
          },
          "(n,): of each unknown.")
      .def_property_readonly(
          "covariance", [](const Estimate& e) { return array_of(e.covariance); }, "(n, n).")
      .def_property_readonly("unobservable", &directions_of,
                             "(m, n): directions of the unknowns of which the measurements tell nothing, in units of "
                             "their own.")
      .def_readonly("chi_squared", &Estimate::chi_squared, "Sum of the squares of what is left, over deviations.")
      .def_readonly("degrees_of_freedom", &Estimate::degrees_of_freedom, "Rows, priors among them, less unknowns.")
      .def_readonly("fits", &Estimate::fits, "chi_squared is below what one in 1000 exceeds.")
      .def_readonly("iterations", &Estimate::iterations, "Steps of Gauss and Newton.")
      .def("__repr__", [](const Estimate& e) {
        return "<fam.Estimate: " + std::string(scene::name(e.status)) + ", chi-squared " +
               std::to_string(e.chi_squared) + ">";
      });
}

}  // namespace

void add_estimator(py::module_& module) {
  add_estimate(module);
  py::class_<KeptEstimator>(
      module, "Estimator",
      R"(Loads, places, stiffness factors and rest curvatures from what was measured of a rod's shape.

Kept for a stream: the next estimate starts from the last one. One estimator only in one thread at a time.)")
      .def(py::init([](py::handle problem, py::object tolerance_mm, py::object arcs, py::object law, py::object model) {
             return std::make_unique<KeptEstimator>(problem, Keywords{tolerance_mm, arcs, law, model});
           }),
           py::arg("problem"), py::arg("tolerance_mm") = py::none(), py::arg("arcs") = py::none(),
           py::arg("law") = "auto", py::arg("model") = "auto",
           "Estimator(problem, tolerance_mm=None, arcs=None, law='auto', model='auto')")
      .def("set_measurement", &KeptEstimator::set_measurement, py::arg("measurement"), py::arg("value"),
           py::arg("scene") = 0, "set_measurement(measurement, value, scene=0)")
      .def("estimate", &KeptEstimator::estimate, "estimate() -> Estimate");
  module.def("estimate", &estimate_once, py::arg("problem"), py::arg("tolerance_mm") = py::none(),
             py::arg("arcs") = py::none(), py::arg("law") = "auto", py::arg("model") = "auto",
             "estimate(problem, tolerance_mm=None, arcs=None, law='auto', model='auto') -> Estimate");
}

}  // namespace fam_python
