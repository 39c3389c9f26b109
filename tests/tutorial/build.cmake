# SPDX-License-Identifier: GPL-3.0-or-later
# Builds all tutorials in SOURCE with the package installed in PREFIX, in WORK/build.
execute_process(
  COMMAND ${CMAKE_COMMAND} -S ${SOURCE} -B ${WORK}/build -G ${GENERATOR} --fresh
          -DCMAKE_PREFIX_PATH=${PREFIX} -DCMAKE_BUILD_TYPE=Release
          -DCMAKE_CXX_COMPILER_LAUNCHER=${CCACHE}
          "-DCMAKE_CXX_FLAGS=-Wall -Wextra -Wpedantic -Wconversion -Wshadow -Werror"
  OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND ${CMAKE_COMMAND} --build ${WORK}/build -j 2 COMMAND_ERROR_IS_FATAL ANY)
