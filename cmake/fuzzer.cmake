# The fuzzer of the scene file, built by clang++ beside the main compiler: scene/ alone, with both sanitizers. Left out
# where clang++ or its libFuzzer is missing (Debian: clang, libclang-rt-14-dev).
find_program(FUZZ_COMPILER clang++)
set(fuzz_flags -std=c++20 -O1 -g1 -DFMT_HEADER_ONLY -fsanitize=fuzzer,address,undefined -fno-sanitize-recover=undefined)

if(FUZZ_COMPILER AND NOT DEFINED FUZZ_COMPILER_WORKS)
  set(probe ${CMAKE_BINARY_DIR}/CMakeFiles/fuzzer_probe)
  file(WRITE ${probe}.cpp "#include <cstddef>\nextern \"C\" int LLVMFuzzerTestOneInput(const char*, std::size_t) { return 0; }\n")
  execute_process(COMMAND ${FUZZ_COMPILER} ${fuzz_flags} ${probe}.cpp -o ${probe} RESULT_VARIABLE status
                  OUTPUT_QUIET ERROR_QUIET)
  string(COMPARE EQUAL "${status}" "0" works)
  set(FUZZ_COMPILER_WORKS ${works} CACHE BOOL "clang++ can build fuzzers")
endif()
if(NOT FUZZ_COMPILER OR NOT FUZZ_COMPILER_WORKS)
  message(STATUS "No clang++ with libFuzzer: the scene file is not fuzzed, its corpus is replayed")
  return()
endif()

file(GLOB fuzz_sources CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/scene/*.cpp)
list(PREPEND fuzz_sources ${fuzz_folder}/scene_file_fuzzer.cpp)
file(GLOB fuzz_headers CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/scene/*.h)
# In one unit: half the time of one for each.
set(fuzz_unit ${CMAKE_BINARY_DIR}/CMakeFiles/scene_file_fuzzer.cpp)
list(TRANSFORM fuzz_sources REPLACE "(.+)" "#include \"\\1\"\n" OUTPUT_VARIABLE fuzz_includes)
list(JOIN fuzz_includes "" fuzz_includes)
file(CONFIGURE OUTPUT ${fuzz_unit} CONTENT "${fuzz_includes}" @ONLY)
get_target_property(eigen_folder Eigen3::Eigen INTERFACE_INCLUDE_DIRECTORIES)
set(fuzzer ${CMAKE_BINARY_DIR}/bin/scene_file_fuzzer)
add_custom_command(OUTPUT ${fuzzer}
                   COMMAND ${FUZZ_COMPILER} ${fuzz_flags} -I${CMAKE_SOURCE_DIR} -isystem ${eigen_folder} ${fuzz_unit} -o ${fuzzer}
                   DEPENDS ${fuzz_unit} ${fuzz_sources} ${fuzz_headers} COMMENT "Building the fuzzer of the scene file")
add_custom_target(scene_file_fuzzer ALL DEPENDS ${fuzzer})

# New inputs go to the build folder; the committed corpus is only read. No leak check: it needs ptrace, which containers
# may forbid.
set(found ${CMAKE_BINARY_DIR}/fuzz)
file(MAKE_DIRECTORY ${found})
add_test(NAME fuzz COMMAND ${fuzzer} -max_total_time=10 -seed=1 -timeout=5 -rss_limit_mb=1000 -max_len=4096
                           -detect_leaks=0 -verbosity=0 -dict=${fuzz_folder}/scene.dict -artifact_prefix=${found}/
                           ${found} ${fuzz_folder}/corpus)
