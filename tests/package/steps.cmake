# Shared by the scripts here.
function(run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT status EQUAL 0)
    message(FATAL_ERROR "${ARGN}: ${output}")
  endif()
  set(output ${output} PARENT_SCOPE)
endfunction()

# Builds the user's project in `folder` with the arguments given, and runs it.
function(build_user folder)
  run(${CMAKE_COMMAND} -S ${CMAKE_CURRENT_FUNCTION_LIST_DIR} -B ${folder} -DCMAKE_BUILD_TYPE=Release -G Ninja ${ARGN})
  run(${CMAKE_COMMAND} --build ${folder} --parallel 1)
  foreach(program robot controller)
    run(${folder}/${program})
    message(STATUS "${program}: ${output}")
  endforeach()
endfunction()
