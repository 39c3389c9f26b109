# SPDX-License-Identifier: GPL-3.0-or-later
# Installs the build tree BUILD into PREFIX, afresh.
file(REMOVE_RECURSE ${PREFIX})
execute_process(COMMAND ${CMAKE_COMMAND} --install ${BUILD} --prefix ${PREFIX}
                OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
