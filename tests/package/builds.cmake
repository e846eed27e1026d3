# Another build of the library, the command and the user's project, warnings as errors: solves what the default build
# solves. Run as a script with -DSOURCE=<project> -DFOLDER=<scratch> -DFAM=<command of the default build>
# -DOPTIONS=<of the build> [-DUSER_OPTIONS=<of the user's project>].
include(${CMAKE_CURRENT_LIST_DIR}/steps.cmake)
set(scene ${SOURCE}/studies/cases/study2/study2_gravity_y.json)
set(largest_mm 1e-9)  # round-off: FMA and the order of sums differ

run(${CMAKE_COMMAND} -S ${SOURCE} -B ${FOLDER}/build -G Ninja -DFAM_STUDIES=OFF "-DCMAKE_CXX_FLAGS_RELEASE=-O0 -DNDEBUG"
    -DCMAKE_UNITY_BUILD=ON -DCMAKE_UNITY_BUILD_BATCH_SIZE=30
    -DCMAKE_DISABLE_FIND_PACKAGE_pybind11=ON ${OPTIONS})  # the Python module has builds of its own
run(${CMAKE_COMMAND} --build ${FOLDER}/build --parallel 1)
file(REMOVE_RECURSE ${FOLDER}/prefix ${FOLDER}/user)
run(${CMAKE_COMMAND} --install ${FOLDER}/build --prefix ${FOLDER}/prefix)
build_user(${FOLDER}/user -DCMAKE_PREFIX_PATH=${FOLDER}/prefix ${USER_OPTIONS})

# Largest difference of any number of two CSV files, "none" where they do not have the same cells.
file(WRITE ${FOLDER}/difference.awk [[
  NR == FNR { line[FNR] = $0; lines = FNR; next }
  { if (split(line[FNR], cell, ",") != NF) bad = 1
    for (i = 1; FNR > 1 && i <= NF; ++i) { d = $i - cell[i]; if (d < 0) d = -d; if (d > largest) largest = d } }
  END { if (bad || FNR != lines || lines < 40) print "none"; else printf "%.3g", largest }
]])
function(difference_of result file)
  run(awk -F, -f ${FOLDER}/difference.awk ${FOLDER}/default.csv ${file})
  set(${result} ${output} PARENT_SCOPE)
endfunction()
function(solve_to file)
  execute_process(COMMAND ${ARGN} --tolerance-mm 1e-6 --format csv OUTPUT_FILE ${file} COMMAND_ERROR_IS_FATAL ANY)
endfunction()

solve_to(${FOLDER}/default.csv ${FAM} solve ${scene})
solve_to(${FOLDER}/this.csv ${FOLDER}/prefix/bin/fam solve ${scene})
difference_of(differ_mm ${FOLDER}/this.csv)
message(STATUS "differs from the default build by at most ${differ_mm} (mm, N, N mm), limit ${largest_mm}")
if(differ_mm STREQUAL "none" OR differ_mm GREATER largest_mm)
  message(SEND_ERROR "the answers differ")
endif()

# The twin: gravity that is one part in 1e8 larger is seen.
file(READ ${scene} text)
string(REPLACE "9.81" "9.8100001" heavier "${text}")
file(WRITE ${FOLDER}/heavier.json "${heavier}")
solve_to(${FOLDER}/heavier.csv ${FOLDER}/prefix/bin/fam solve ${FOLDER}/heavier.json)
difference_of(differ_mm ${FOLDER}/heavier.csv)
if(NOT differ_mm GREATER largest_mm)
  message(SEND_ERROR "another scene gives the same answer: this check would assert nothing")
endif()
