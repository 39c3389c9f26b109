# SPDX-License-Identifier: GPL-3.0-or-later

# homeward_module(<name> [<public dependency>...] [PRIVATE <dependency>...])
#
# Makes the library homeward::<name> from src/*.cpp and include/homeward/<name>/*.h. The line is the
# whole truth about what the module sees: public dependencies are transitive.
function(homeward_module name)
  cmake_parse_arguments(ARG "" "" "PRIVATE" ${ARGN})
  set(target homeward_${name})
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/src/*.cpp)
  if(sources)
    add_library(${target} STATIC ${sources})
    set(scope PUBLIC)
    target_link_libraries(${target} PRIVATE $<BUILD_INTERFACE:homeward_warnings> ${ARG_PRIVATE})
  else()
    add_library(${target} INTERFACE)
    set(scope INTERFACE)
  endif()
  add_library(homeward::${name} ALIAS ${target})
  target_compile_features(${target} ${scope} cxx_std_20)
  target_include_directories(${target} ${scope}
    $<BUILD_INTERFACE:${CMAKE_CURRENT_SOURCE_DIR}/include> $<INSTALL_INTERFACE:include>)
  target_link_libraries(${target} ${scope} ${ARG_UNPARSED_ARGUMENTS})
  set_target_properties(${target} PROPERTIES EXPORT_NAME ${name})
  install(TARGETS ${target} EXPORT HomewardTargets)
  install(DIRECTORY include/ DESTINATION include)
endfunction()

# homeward_test(<module> [<extra library>...]): every tests/<module>/*_test.cpp becomes one program.
function(homeward_test module)
  set(target test_${module})
  file(GLOB sources CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/tests/${module}/*_test.cpp)
  if(NOT sources)
    return()
  endif()
  add_executable(${target} ${sources})
  target_link_libraries(${target} PRIVATE homeward_warnings homeward_test_support ${ARGN}
                                          GTest::gmock GTest::gtest_main)
  gtest_discover_tests(${target} TEST_PREFIX ${module}. DISCOVERY_TIMEOUT 60
                       PROPERTIES LABELS unit TIMEOUT 120)
endfunction()
