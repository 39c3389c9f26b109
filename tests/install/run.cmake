# SPDX-License-Identifier: GPL-3.0-or-later
# Builds and runs, in WORK, the program beside this file with the package installed in PREFIX.
function(run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE status OUTPUT_VARIABLE out ERROR_VARIABLE out)
  if(NOT status EQUAL 0)
    message(FATAL_ERROR "${ARGN}\n${out}")
  endif()
endfunction()

file(REMOVE_RECURSE ${WORK})
set(includes "")
foreach(module core camera homing servo)
  file(GLOB headers RELATIVE ${PREFIX}/include ${PREFIX}/include/homeward/${module}/*.h)
  foreach(header ${headers})
    string(APPEND includes "#include <${header}>\n")
  endforeach()
endforeach()
file(WRITE ${WORK}/include/all_headers.h "${includes}")
run(${CMAKE_COMMAND} -S ${CMAKE_CURRENT_LIST_DIR} -B ${WORK}/build
    -DCMAKE_PREFIX_PATH=${PREFIX} -DCMAKE_BUILD_TYPE=Release
    -DCMAKE_CXX_FLAGS=-I${WORK}/include)
run(${CMAKE_COMMAND} --build ${WORK}/build)
run(${WORK}/build/consumer)
