# SPDX-License-Identifier: GPL-3.0-or-later
include(CMakePackageConfigHelpers)
install(EXPORT HomewardTargets NAMESPACE homeward:: DESTINATION lib/cmake/Homeward)
set(HOMEWARD_DATA_DIR share/homeward)
configure_package_config_file(cmake/HomewardConfig.cmake.in
  ${CMAKE_CURRENT_BINARY_DIR}/HomewardConfig.cmake INSTALL_DESTINATION lib/cmake/Homeward
  PATH_VARS HOMEWARD_DATA_DIR)
write_basic_package_version_file(${CMAKE_CURRENT_BINARY_DIR}/HomewardConfigVersion.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/HomewardConfig.cmake
  ${CMAKE_CURRENT_BINARY_DIR}/HomewardConfigVersion.cmake DESTINATION lib/cmake/Homeward)
install(DIRECTORY data/ DESTINATION ${HOMEWARD_DATA_DIR} COMPONENT data)

# The pages link to each other, to the tutorials and to the data as they do in the sources.
install(FILES README.md CONTRIBUTING.md DESTINATION share/doc/homeward COMPONENT doc)
install(DIRECTORY doc tutorial DESTINATION share/doc/homeward COMPONENT doc
  PATTERN Doxyfile EXCLUDE)
