# SPDX-License-Identifier: MIT
# Installs the library, its headers, find_package(insole) and pkg-config; the program installs itself.
include(CMakePackageConfigHelpers)

install(TARGETS insole EXPORT insole-targets)
install(DIRECTORY include/insole TYPE INCLUDE FILES_MATCHING PATTERN *.h)
install(FILES LICENSE TYPE DOC)

set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/insole)
install(EXPORT insole-targets NAMESPACE insole:: DESTINATION ${package_dir})
configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/insole-config.cmake.in
  ${PROJECT_BINARY_DIR}/insole-config.cmake INSTALL_DESTINATION ${package_dir})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/insole-config-version.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/insole-config.cmake
  ${PROJECT_BINARY_DIR}/insole-config-version.cmake DESTINATION ${package_dir})

# Paths relative to the .pc file, so that an installed tree may be moved.
file(RELATIVE_PATH pc_prefix /prefix/${CMAKE_INSTALL_LIBDIR}/pkgconfig /prefix)
if(INSOLE_DOUBLE)
  set(pc_definitions " -DINSOLE_DOUBLE")
else()
  set(pc_definitions "")
endif()
configure_file(${CMAKE_CURRENT_LIST_DIR}/insole.pc.in ${PROJECT_BINARY_DIR}/insole.pc @ONLY)
install(FILES ${PROJECT_BINARY_DIR}/insole.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
