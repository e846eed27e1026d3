// A fam::Solver for Python: what C++ answers with NaN, or forbids, raises.
#pragma once

#include "convert.h"

namespace fam_python {

class KeptSolver {
 public:
  KeptSolver(const scene::Scene& scene, const fam::Options& options);

  // Raises RuntimeError while another thread solves with it.
  fam::Solver& use() {
    if (busy_) raise_busy();
    return solver_;
  }
  // Raises RuntimeError before a converged solve.
  fam::Solver& solved() {
    if (!use().solved()) raise_not_solved();
    return solver_;
  }

  // Runs work(solver) while other threads may hold Python.
  template <class Work>
  auto alone(Work work) {
    fam::Solver& solver = use();
    const Busy busy{busy_};
    const py::gil_scoped_release others_run;
    return work(solver);
  }

  // An index of C++; raises IndexError.
  std::size_t load(py::ssize_t index) const { return index_below(index, loads_, "load"); }
  std::size_t section(py::ssize_t index) const { return index_below(index, sections_, "section"); }
  // An index for the set_...: what is too large the library refuses, a negative one with the same words.
  std::size_t load_to_set(py::ssize_t index) const { return not_negative(index, loads_, "loads", "loads"); }
  std::size_t section_to_set(py::ssize_t index) const {
    return not_negative(index, sections_, "rod.sections", "sections");
  }
  bool is_tendon(std::size_t load) const;
  // Of a force or a moment; raises ValueError.
  std::size_t point_load(py::ssize_t index) const;
  // Raises ValueError.
  double on_rod(double s_mm) const;

 private:
  struct Busy {
    bool& busy;
    explicit Busy(bool& flag) : busy(flag) { busy = true; }
    ~Busy() { busy = false; }
    Busy(const Busy&) = delete;
    Busy& operator=(const Busy&) = delete;
  };

  static std::size_t not_negative(py::ssize_t index, py::ssize_t count, const char* list, const char* what);
  static std::size_t index_below(py::ssize_t index, py::ssize_t count, const char* what);
  [[noreturn]] static void raise_busy();
  [[noreturn]] static void raise_not_solved();

  fam::Solver solver_;
  double length_mm_;
  py::ssize_t loads_, sections_;
  bool busy_ = false;  // read and written with Python held
};

// The getters of slopes, of the class that add_solver() makes.
void add_derivatives(py::class_<KeptSolver>& solver);

}  // namespace fam_python
