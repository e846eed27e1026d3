# cmake --install and cpack: the library fam with its headers, and the command fam.
#   find_package(fam CONFIG REQUIRED)
#   target_link_libraries(robot PRIVATE fam::fam)
# Needs Eigen alone. Relocatable; versions are compatible within a major one.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

foreach(library scene fam)
  set_target_properties(${library} PROPERTIES VERSION ${PROJECT_VERSION}
                                              SOVERSION ${PROJECT_VERSION_MAJOR} INSTALL_RPATH "$ORIGIN")
  target_include_directories(${library} PUBLIC $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
endforeach()
set_target_properties(scene PROPERTIES OUTPUT_NAME fam_scene)
set_target_properties(fam_command PROPERTIES INSTALL_RPATH "$ORIGIN/../${CMAKE_INSTALL_LIBDIR}")

install(TARGETS fam scene EXPORT fam_targets)
install(TARGETS fam_command)
file(GLOB library_headers CONFIGURE_DEPENDS fam/*.h)
file(GLOB scene_headers CONFIGURE_DEPENDS scene/*.h)
list(FILTER scene_headers EXCLUDE REGEX "_file.h$")
install(FILES ${library_headers} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/fam)
install(FILES ${scene_headers} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/scene)
install(EXPORT fam_targets NAMESPACE fam:: FILE famTargets.cmake DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/fam)
configure_package_config_file(cmake/famConfig.cmake.in ${CMAKE_BINARY_DIR}/famConfig.cmake
                              INSTALL_DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/fam)
write_basic_package_version_file(${CMAKE_BINARY_DIR}/famConfigVersion.cmake COMPATIBILITY SameMajorVersion)
install(FILES ${CMAKE_BINARY_DIR}/famConfig.cmake ${CMAKE_BINARY_DIR}/famConfigVersion.cmake
        DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/fam)

install(FILES ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/finite-arc-method RENAME copyright)

set(CPACK_GENERATOR TGZ DEB)
set(CPACK_PACKAGE_NAME finite-arc-method)  # Debian once had another fam
set(CPACK_PACKAGE_CONTACT "the authors of fam")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "Finite arc method: static shapes of slender, soft rods")
set(CPACK_RESOURCE_FILE_LICENSE ${PROJECT_SOURCE_DIR}/LICENSE)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_PACKAGE_DEPENDS "libeigen3-dev")
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "python3-numpy")
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
include(CPack)
