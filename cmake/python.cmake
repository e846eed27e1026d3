# The Python module `fam`, beside its stub in the build folder: `PYTHONPATH=build/release python3 -c "import fam"`.
# Left out where Python's headers or pybind11 are missing, and with sanitizers, which an interpreter would have to load.
if(FAM_SANITIZE)
  return()
endif()
if(NOT DEFINED Python3_EXECUTABLE AND EXISTS /usr/bin/python3)
  set(Python3_EXECUTABLE /usr/bin/python3)  # whose packages .ci/prepare installs, before any other on the PATH
endif()
find_package(Python3 COMPONENTS Interpreter Development.Module)
if(Python3_FOUND)
  find_package(pybind11 2.10 CONFIG)
endif()
if(NOT Python3_FOUND OR NOT pybind11_FOUND)
  message(STATUS "The Python module is left out: it needs Python's headers and pybind11")
  return()
endif()

file(GLOB python_sources CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/python/*.cpp)
pybind11_add_module(fam_python NO_EXTRAS ${python_sources})
set_target_properties(fam_python PROPERTIES OUTPUT_NAME fam LIBRARY_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR})
if(BUILD_SHARED_LIBS)
  set_target_properties(fam_python PROPERTIES INSTALL_RPATH "\$ORIGIN/../../../${CMAKE_INSTALL_LIBDIR}")
endif()
target_compile_definitions(fam_python PRIVATE FAM_VERSION="${PROJECT_VERSION}")
target_link_libraries(fam_python PRIVATE fam scene_file warnings)
configure_file(${CMAKE_SOURCE_DIR}/python/fam.pyi ${CMAKE_BINARY_DIR}/fam.pyi COPYONLY)

set_target_properties(scene_file PROPERTIES POSITION_INDEPENDENT_CODE ON)  # part of a shared object

# Where Debian's Python looks under /usr; elsewhere, `pip install .`.
install(TARGETS fam_python LIBRARY DESTINATION lib/python3/dist-packages COMPONENT python)
install(FILES ${CMAKE_SOURCE_DIR}/python/fam.pyi DESTINATION lib/python3/dist-packages COMPONENT python)
