# SPDX-License-Identifier: GPL-3.0-or-later

# homeward_module(<name> [<public dependency>...] [CXX20] [PRIVATE <dependency>...] [VISP_SOURCES <file>...])
#
# Makes the library homeward::<name> from src/*.cpp and include/homeward/<name>/*.h. The line is the
# whole truth about what the module sees: public dependencies are transitive.
#
# VISP_SOURCES are compiled as C++17: ViSP 3.5's headers are no C++20. Headers that ViSP users include stay
# C++17 too. CXX20 says that the module's headers are C++20, to whoever links it, near or far.
function(homeward_module name)
  cmake_parse_arguments(ARG "CXX20" "" "PRIVATE;VISP_SOURCES" ${ARGN})
  set(target homeward_${name})
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/src/*.cpp)
  homeward_visp_sources(${ARG_VISP_SOURCES})
  if(sources)
    add_library(${target} STATIC ${sources})
    set(scope PUBLIC)
    target_link_libraries(${target} PRIVATE $<BUILD_INTERFACE:homeward_warnings> ${ARG_PRIVATE})
    target_precompile_headers(${target} REUSE_FROM homeward_precompiled)
  else()
    add_library(${target} INTERFACE)
    set(scope INTERFACE)
  endif()
  add_library(homeward::${name} ALIAS ${target})
  target_compile_features(${target} ${scope} $<IF:$<BOOL:${ARG_CXX20}>,cxx_std_20,cxx_std_17>)
  target_include_directories(${target} ${scope}
    $<BUILD_INTERFACE:${CMAKE_CURRENT_SOURCE_DIR}/include> $<INSTALL_INTERFACE:include>)
  target_link_libraries(${target} ${scope} ${ARG_UNPARSED_ARGUMENTS})
  set_target_properties(${target} PROPERTIES EXPORT_NAME ${name})
  install(TARGETS ${target} EXPORT HomewardTargets)
  install(DIRECTORY include/ DESTINATION include)
endfunction()

# Compiles source files of this folder as C++17, for ViSP's sake.
function(homeward_visp_sources)
  if(ARGN)
    set_source_files_properties(${ARGN} PROPERTIES COMPILE_OPTIONS -std=c++17
                                                   SKIP_PRECOMPILE_HEADERS ON)
  endif()
endfunction()

# homeward_run_tests(<target> <name> <label> <shards>)
#
# ctest runs a test program as so many processes side by side, <name>.1 and so on, each with its share of the
# tests: loading the libraries takes longer than most tests. `<target> --gtest_filter=...` runs one of them.
function(homeward_run_tests target name label shards)
  math(EXPR last "${shards} - 1")
  foreach(index RANGE ${last})
    math(EXPR number "${index} + 1")
    add_test(NAME ${name}.${number} COMMAND ${target})
    set_tests_properties(${name}.${number} PROPERTIES LABELS ${label} TIMEOUT 600 COST 10
      ENVIRONMENT "GTEST_TOTAL_SHARDS=${shards};GTEST_SHARD_INDEX=${index}")
  endforeach()
endfunction()

# homeward_test(<module> [SHARDS <n>] [<extra library>...]): every tests/<module>/*_test.cpp becomes one program.
function(homeward_test module)
  cmake_parse_arguments(ARG "" "SHARDS" "" ${ARGN})
  set(target test_${module})
  file(GLOB sources CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/tests/${module}/*_test.cpp)
  if(NOT sources)
    return()
  endif()
  add_executable(${target} ${sources})
  target_link_libraries(${target} PRIVATE homeward_warnings homeward_test_support ${ARG_UNPARSED_ARGUMENTS}
                                          GTest::gmock GTest::gtest_main)
  target_precompile_headers(${target} REUSE_FROM test_precompiled)
  if(NOT ARG_SHARDS)
    set(ARG_SHARDS 1)
  endif()
  homeward_run_tests(${target} ${module} unit ${ARG_SHARDS})
endfunction()
