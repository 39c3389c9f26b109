# SPDX-License-Identifier: GPL-3.0-or-later
# Every third-party package, found once. SQLite3 comes before sdformat, whose helper
# package shadows CMake's own FindSQLite3.
find_package(Threads REQUIRED)
find_package(SQLite3 REQUIRED)
find_package(Eigen3 REQUIRED)
find_package(OpenCV 4.5 REQUIRED COMPONENTS core imgproc imgcodecs features2d calib3d videoio video aruco dnn)
find_package(VISP 3.5 REQUIRED)
find_package(Boost REQUIRED)
find_package(urdfdom REQUIRED)
find_package(embree 3 REQUIRED)
find_package(assimp REQUIRED)
find_package(sdformat12 REQUIRED)
find_package(yaml-cpp REQUIRED)
find_package(spdlog REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(CLI11 REQUIRED)
find_package(ZLIB REQUIRED)
find_package(PkgConfig REQUIRED)
pkg_check_modules(hwy REQUIRED IMPORTED_TARGET libhwy)
pkg_check_modules(cairo REQUIRED IMPORTED_TARGET cairo)
pkg_check_modules(tinyxml2 REQUIRED IMPORTED_TARGET tinyxml2)
pkg_check_modules(httplib REQUIRED IMPORTED_TARGET cpp-httplib)

# Optional: lasers that MRPT drives. Last, since what it depends on looks for much.
find_package(mrpt-hwdrivers QUIET)
if(NOT mrpt-hwdrivers_FOUND)
  message(STATUS "No MRPT drivers (Debian: libmrpt-hwdrivers-dev): mrpt_lasers, for Hokuyo lasers, is left out")
endif()

# Packages without (namespaced) targets get one, so that module lines read alike.
add_library(homeward_urdfdom INTERFACE)
target_link_libraries(homeward_urdfdom INTERFACE ${urdfdom_LIBRARIES})
target_include_directories(homeward_urdfdom SYSTEM INTERFACE ${urdfdom_INCLUDE_DIRS})
set_target_properties(homeward_urdfdom PROPERTIES EXPORT_NAME urdfdom)
install(TARGETS homeward_urdfdom EXPORT HomewardTargets)
