# Fails when a folder includes what it may not know. Run as a script with -DSOURCE=<project>.
#   fem_reference and exact_reference: scene/ and themselves; fam: scene/ and Eigen; scene: nothing of the others.
function(forbid folder pattern)
  file(GLOB files ${SOURCE}/${folder}/*.h ${SOURCE}/${folder}/*.cpp)
  if(NOT files)
    message(FATAL_ERROR "${folder}/ has no sources: this check would assert nothing")
  endif()
  foreach(file ${files})
    file(STRINGS ${file} lines REGEX "^[ \t]*#[ \t]*include[ \t]*[\"<](\\.\\.|${pattern})")
    if(lines)
      message(SEND_ERROR "${file}: ${lines}")
    endif()
  endforeach()
endfunction()

forbid(scene "fam/|fem_reference/|exact_reference/|studies/|apps/|gsl/|sundials/|deal.II/")
forbid(fam "fem_reference/|exact_reference/|studies/|apps/|gsl/|sundials/|deal.II/|fmt/|nlohmann/|CLI/")
forbid(fem_reference "fam/|exact_reference/|studies/|apps/")
forbid(exact_reference "fam/|fem_reference/|studies/|apps/|deal.II/")
