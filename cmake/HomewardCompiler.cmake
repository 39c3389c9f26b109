# SPDX-License-Identifier: GPL-3.0-or-later
set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)

if(NOT CMAKE_BUILD_TYPE)
  set(CMAKE_BUILD_TYPE Release)
endif()

find_program(CCACHE_PROGRAM ccache)
if(CCACHE_PROGRAM)
  # The sloppiness that ccache wants of who uses precompiled headers; nobody here uses __TIME__.
  set(CMAKE_CXX_COMPILER_LAUNCHER ${CMAKE_COMMAND} -E env CCACHE_SLOPPINESS=pch_defines,time_macros ${CCACHE_PROGRAM})
  set(CMAKE_C_COMPILER_LAUNCHER ${CCACHE_PROGRAM})
  add_compile_options($<$<COMPILE_LANG_AND_ID:CXX,GNU>:-fpch-preprocess>) # for ccache, too
endif()

set(HOMEWARD_SANITIZE "" CACHE STRING "Sanitizers for every target, for example address,undefined")
if(HOMEWARD_SANITIZE)
  add_compile_options(-fsanitize=${HOMEWARD_SANITIZE} -fno-sanitize-recover=all
                      -fno-omit-frame-pointer -O1 -g1) # -O2 -g compiles three times as long
  if(HOMEWARD_SANITIZE MATCHES "address") # it sees these two itself
    add_compile_options(-fno-sanitize=null,object-size)
  endif()
  add_link_options(-fsanitize=${HOMEWARD_SANITIZE})
endif()

# Warnings for our own code only; third-party headers come in as SYSTEM.
add_library(homeward_warnings INTERFACE)
target_compile_options(homeward_warnings INTERFACE
  -Wall -Wextra -Wpedantic -Wconversion -Wshadow -Werror)
# GCC 12 sees uninitialised members in every move of a std::variant, and overruns in sums of strings.
target_compile_options(homeward_warnings INTERFACE
  $<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized -Wno-array-bounds -Wno-restrict>)

# A third of what compiling a module takes is these headers, read once for all of them. Sources still
# include what they use: clang-tidy compiles each without.
add_library(homeward_precompiled OBJECT ${CMAKE_SOURCE_DIR}/cmake/precompiled.cpp)
target_link_libraries(homeward_precompiled PRIVATE homeward_warnings Eigen3::Eigen opencv_core opencv_imgproc)
target_precompile_headers(homeward_precompiled PRIVATE
  <Eigen/Geometry> <opencv2/core.hpp> <opencv2/imgproc.hpp>
  <algorithm> <array> <cmath> <filesystem> <fstream> <functional> <map> <memory> <optional> <span>
  <string> <vector>)
