# SPDX-License-Identifier: GPL-3.0-or-later

# homeward_install_program(<target>): installs a program with its manual page and its bash completion. It prints both
# itself, so that they say what it understands.
function(homeward_install_program target)
  set(man ${CMAKE_CURRENT_BINARY_DIR}/${target}.1)
  set(completion ${CMAKE_CURRENT_BINARY_DIR}/${target}.bash)
  add_custom_command(TARGET ${target} POST_BUILD BYPRODUCTS ${man} ${completion}
    COMMAND ${target} --man > ${man}
    COMMAND ${target} --completion > ${completion})
  install(TARGETS ${target} COMPONENT tools)
  install(FILES ${man} DESTINATION share/man/man1 COMPONENT tools)
  install(FILES ${completion} DESTINATION share/bash-completion/completions RENAME ${target}
          COMPONENT tools)
endfunction()
