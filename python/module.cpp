// The Python module fam. Its types and words for readers and checkers: fam.pyi.
#include "convert.h"

PYBIND11_MODULE(fam, module) {
  pybind11::options words;
  words.disable_function_signatures();
  module.doc() = "The finite arc method: static shapes of clamped slender rods. Units: mm, N, N mm, rad.";
  module.attr("__version__") = FAM_VERSION;
  pybind11::register_exception<scene::SceneError>(module, "SceneError", PyExc_ValueError).attr("__doc__") =
      "Wrong input: one line, what, where and what is allowed.";
  fam_python::add_solve(module);
  fam_python::add_solver(module);
  fam_python::add_batch(module);
  fam_python::add_estimator(module);
}
