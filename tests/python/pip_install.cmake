# `pip install .` into an environment of its own that sees the system's packages, without the network; then a solve.
# -DPYTHON=<interpreter> -DSOURCE=<project> -DFOLDER=<scratch> -DVERSION=<of the project>
file(REMOVE_RECURSE ${FOLDER})
function(run)
  execute_process(COMMAND ${ARGN} WORKING_DIRECTORY ${FOLDER} RESULT_VARIABLE status OUTPUT_VARIABLE output
                  ERROR_VARIABLE output OUTPUT_STRIP_TRAILING_WHITESPACE)
  if(NOT status EQUAL 0)
    message(FATAL_ERROR "${ARGN}: ${output}")
  endif()
  set(output "${output}" PARENT_SCOPE)
endfunction()

set(ENV{PYTHONPATH} "")
file(MAKE_DIRECTORY ${FOLDER})
run(${PYTHON} -m venv --system-site-packages ${FOLDER}/venv)
run(${FOLDER}/venv/bin/pip install --no-index --no-build-isolation --disable-pip-version-check ${SOURCE})
file(WRITE ${FOLDER}/bend.py [[
import fam, importlib.metadata, math, pathlib
scene = {"rod": {"sections": [{"length_mm": 100, "stiffness": {"bending_Nmm2": 1500, "torsion_Nmm2": 1000}}]},
         "loads": [{"kind": "moment", "at": "tip", "frame": "follower", "value_Nmm": [0, 0, 15]}]}
assert abs(fam.solve(scene).tip_position_mm[0] - 100 * math.sin(1)) < 1e-9
assert pathlib.Path(fam.__file__).with_name("fam.pyi").exists()
assert "venv" in fam.__file__, fam.__file__
assert importlib.metadata.version("fam") == fam.__version__
print(fam.__version__)
]])
run(${FOLDER}/venv/bin/python bend.py)
if(NOT output STREQUAL VERSION)
  message(FATAL_ERROR "the installed module says version ${output}, the project ${VERSION}")
endif()
run(${FOLDER}/venv/bin/pip uninstall --yes --disable-pip-version-check fam)
