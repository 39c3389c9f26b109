# SPDX-License-Identifier: GPL-3.0-or-later
# Makes the Debian packages of the build tree BUILD, in WORK, and installs them into an empty system of their own:
# programs run, manual pages and completions are there, and removing them leaves nothing behind.
cmake_minimum_required(VERSION 3.25)
function(run)
  execute_process(COMMAND ${ARGN} OUTPUT_VARIABLE out ERROR_VARIABLE out RESULT_VARIABLE status)
  if(NOT status EQUAL 0)
    message(FATAL_ERROR "${ARGN}\n${out}")
  endif()
  set(out "${out}" PARENT_SCOPE)
endfunction()

function(expect text what)
  if(NOT text MATCHES "${what}")
    message(FATAL_ERROR "expected '${what}' in\n${text}")
  endif()
endfunction()

run(id -u)
if(NOT out STREQUAL "0\n")
  message(STATUS "skipped: dpkg installs for root only")
  return()
endif()

file(REMOVE_RECURSE ${WORK})
run(${CPACK} --config ${BUILD}/CPackConfig.cmake -B ${WORK}/packages)
file(GLOB packages ${WORK}/packages/*.deb)
list(LENGTH packages count)
if(NOT count EQUAL 4)
  message(FATAL_ERROR "expected 4 packages, got ${packages}")
endif()

set(root ${WORK}/root)
file(MAKE_DIRECTORY ${root}/var/lib/dpkg/updates ${root}/var/lib/dpkg/info)
file(TOUCH ${root}/var/lib/dpkg/status)
set(dpkg dpkg --root=${root} --log=/dev/null)
# Nothing else is installed there; what they depend on is installed here.
run(${dpkg} --force-depends -i ${packages})

unset(ENV{HOMEWARD_DATA})
run(${root}/usr/bin/homeward --version)
expect("${out}" "^${VERSION}\n$")
execute_process(COMMAND ${root}/usr/bin/homeward explore --max-time 20 --map ${WORK}/lab.hwm
                OUTPUT_VARIABLE out ERROR_VARIABLE out)
expect("${out}" "nodes [1-9]")
foreach(program homeward homeward-calibrate pioneer-sim)
  file(READ ${root}/usr/share/man/man1/${program}.1 page)
  expect("${page}" "^.TH ")
endforeach()

# Completion: a subcommand, an option of it, one of a nested command.
foreach(case "expl=explore" "explore --forw=--forward-distance" "map render --out=--output")
  string(REGEX MATCH "^(.*)=(.*)$" ignored "${case}")
  set(typed "${CMAKE_MATCH_1}")
  set(wanted "${CMAKE_MATCH_2}")
  # (lines, not semicolons, which would end an argument here)
  run(bash -c "source '${root}/usr/share/bash-completion/completions/homeward'
    COMP_WORDS=(homeward ${typed}) COMP_CWORD=$((\${#COMP_WORDS[@]} - 1))
    _homeward
    echo \"\${COMPREPLY[@]}\"")
  if(NOT out STREQUAL "${wanted}\n")
    message(FATAL_ERROR "homeward ${typed} completes to ${out}, not to ${wanted}")
  endif()
endforeach()

run(${dpkg} --purge homeward libhomeward-dev homeward-data homeward-doc)
file(GLOB_RECURSE left LIST_DIRECTORIES true ${root}/*)
list(FILTER left EXCLUDE REGEX "^${root}/var")
if(left)
  message(FATAL_ERROR "left behind: ${left}")
endif()
