# SPDX-License-Identifier: GPL-3.0-or-later
# Debian packages, by `cpack` in the build folder: programs, development files, data, documentation. The libraries
# are static, so there is no package of shared ones.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME homeward)
set(CPACK_PACKAGE_VENDOR Homeward)
set(CPACK_PACKAGE_CONTACT "The authors of Homeward <homeward@localhost>")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_COMPONENTS_ALL tools dev data doc)

set(CPACK_DEBIAN_TOOLS_PACKAGE_NAME homeward)
set(CPACK_DEBIAN_DEV_PACKAGE_NAME libhomeward-dev)
set(CPACK_DEBIAN_DATA_PACKAGE_NAME homeward-data)
set(CPACK_DEBIAN_DOC_PACKAGE_NAME homeward-doc)
set(CPACK_DEBIAN_DATA_PACKAGE_ARCHITECTURE all)
set(CPACK_DEBIAN_DOC_PACKAGE_ARCHITECTURE all)

# Below the summary, which is the same for all.
set(CPACK_COMPONENT_TOOLS_DESCRIPTION "Programs: explores a building with a Pioneer robot or its simulation, maps it, and drives back to any place by sight.")
set(CPACK_COMPONENT_DEV_DESCRIPTION "Libraries to build on: mirror camera, home vectors, visual servoing, places, planning, simulator; for find_package(Homeward).")
set(CPACK_COMPONENT_DATA_DESCRIPTION "Worlds, robots, cameras: what the programs and the tutorials of Homeward need.")
set(CPACK_COMPONENT_DOC_DESCRIPTION "Documentation: pages, and the tutorials with their sources.")

set(same "homeward-data (= ${PROJECT_VERSION})")
set(CPACK_DEBIAN_TOOLS_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_TOOLS_PACKAGE_DEPENDS "${same}")
# As HomewardConfig.cmake looks for them.
string(JOIN ", " CPACK_DEBIAN_DEV_PACKAGE_DEPENDS "${same}" libvisp-dev libopencv-dev libeigen3-dev libboost-dev
  liburdfdom-dev libsdformat-dev libassimp-dev libembree-dev libsqlite3-dev libhwy-dev zlib1g-dev
  libyaml-cpp-dev libspdlog-dev nlohmann-json3-dev pkg-config)

foreach(component ${CPACK_COMPONENTS_ALL})
  string(TOUPPER ${component} upper)
  install(FILES LICENSE DESTINATION share/doc/${CPACK_DEBIAN_${upper}_PACKAGE_NAME} RENAME copyright
          COMPONENT ${component})
endforeach()
include(CPack)
