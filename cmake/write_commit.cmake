# Writes ${OUTPUT} with the commit that is being built, when it changed. Run at every build.
execute_process(COMMAND git rev-parse --short=12 HEAD WORKING_DIRECTORY ${SOURCE} OUTPUT_VARIABLE commit
                OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
execute_process(COMMAND git diff --quiet HEAD -- . :!results WORKING_DIRECTORY ${SOURCE} RESULT_VARIABLE changed
                ERROR_QUIET)
if(changed)
  string(APPEND commit " with changes")
endif()
if(NOT commit)
  set(commit "unknown")
endif()
set(text "#pragma once\nnamespace studies::build_info {\ninline constexpr const char* commit = \"${commit}\";\n}\n")
if(EXISTS ${OUTPUT})
  file(READ ${OUTPUT} old)
endif()
if(NOT "${old}" STREQUAL "${text}")
  file(WRITE ${OUTPUT} "${text}")
endif()
