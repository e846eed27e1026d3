# A kind of load that is added and forgotten somewhere must not compile there. With a made-up kind in scene/load.h every
# source that tells kinds of load apart fails, and names it; with the kinds that there are it compiles. Nor may a source
# ask for one kind and pass over the others (std::get refuses them and may): only the studies named below, of the loads in
# their own case files (known_load of studies/scenes/cases.h). Run as a script with -DSOURCE=<project>
# -DFOLDER=<scratch> -DCOMPILER=<c++> -DEIGEN=<include folder>.
set(kinds "Force|Moment|DistributedForce|Gravity|Tendon")
set(accessor studies/scenes/cases.h)
set(own_files "^studies/(benchmarks|paths|segmentation|stream|study2|torsion)/")
set(houses scene fam fem_reference exact_reference studies apps)

# The header with a sixth kind.
file(READ ${SOURCE}/scene/load.h header)
string(REPLACE "Gravity, Tendon>;" "Gravity, Tendon, MadeUpLoad>;" sixth "${header}")
string(REPLACE "using Load =" "struct MadeUpLoad {\n  double size = 0;\n};\n\nusing Load =" sixth "${sixth}")
if(sixth STREQUAL header OR NOT sixth MATCHES "Tendon, MadeUpLoad")
  message(FATAL_ERROR "scene/load.h does not look as expected: this check would assert nothing")
endif()
file(WRITE ${FOLDER}/scene/load.h "${sixth}")

function(compile result output source)
  execute_process(COMMAND ${COMPILER} -std=c++20 -fsyntax-only -w ${ARGN} -I${SOURCE} -isystem ${EIGEN} ${SOURCE}/${source}
                  RESULT_VARIABLE status OUTPUT_QUIET ERROR_VARIABLE text)
  set(${result} ${status} PARENT_SCOPE)
  set(${output} "${text}" PARENT_SCOPE)
endfunction()

set(telling 0)
foreach(house ${houses})
  file(GLOB_RECURSE files RELATIVE ${SOURCE} ${SOURCE}/${house}/*.h ${SOURCE}/${house}/*.cpp)
  foreach(file ${files})
    file(READ ${SOURCE}/${file} text)
    if(text MATCHES "((get_if|holds_alternative)<(const )?(scene::)?(${kinds})|get_if<Kind)>" AND NOT file STREQUAL accessor)
      message(SEND_ERROR "${file} asks for one kind of load (${CMAKE_MATCH_0}): scene/load_visitor.h asks for all")
    endif()
    if(text MATCHES "known_load<" AND NOT file MATCHES ${own_files})
      message(SEND_ERROR "${file} asks for one kind of load, and not of its own case files")
    endif()
    if(NOT file MATCHES "\\.cpp$" OR NOT text MATCHES "visit_load\\(|std::visit\\([^\n]*(, load\\)|loads\\[|kinds\\[)")
      continue()
    endif()
    math(EXPR telling "${telling} + 1")
    compile(status output ${file} -I${FOLDER})
    if(status EQUAL 0)
      message(SEND_ERROR "${file} compiles with a kind of load that it does not handle")
    elseif(NOT output MATCHES "MadeUpLoad")
      message(SEND_ERROR "${file}: the made-up kind of load is not named:\n${output}")
    endif()
  endforeach()
endforeach()
if(telling LESS 5)
  message(FATAL_ERROR "only ${telling} sources tell kinds of load apart: this check would assert nothing")
endif()

compile(status output scene/load_visitor.cpp)
if(NOT status EQUAL 0)
  message(SEND_ERROR "the unchanged kinds of load do not compile:\n${output}")
endif()
message(STATUS "${telling} sources refuse a made-up kind of load")
