# SPDX-License-Identifier: GPL-3.0-or-later
# Runs PROGRAM in the empty folder WORK: it must print what the file EXPECTED holds, and draw a picture.
file(REMOVE_RECURSE ${WORK})
file(MAKE_DIRECTORY ${WORK})
execute_process(COMMAND ${PROGRAM} WORKING_DIRECTORY ${WORK}
                OUTPUT_VARIABLE printed RESULT_VARIABLE status)
if(NOT status EQUAL 0)
  message(FATAL_ERROR "${PROGRAM} ended with ${status}, having printed\n${printed}")
endif()
file(READ ${EXPECTED} expected)
if(NOT printed STREQUAL expected)
  message(FATAL_ERROR "${PROGRAM} printed\n${printed}\nbut ${EXPECTED} says\n${expected}")
endif()
cmake_path(GET PROGRAM FILENAME name)
if(NOT EXISTS ${WORK}/${name}.png)
  message(FATAL_ERROR "${PROGRAM} drew no ${name}.png")
endif()
