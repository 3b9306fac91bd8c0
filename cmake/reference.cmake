# SPDX-FileCopyrightText: 2026 The wellknit authors
# SPDX-License-Identifier: GPL-3.0-or-later
# cmake -DPROGRAM=wellknit -DOUTPUT=folder -P reference.cmake: manual pages in man1/, a completion for each shell, and the
# file `made` when all are there.
set(commands build check info convert report solve map formats completion manual)
file(MAKE_DIRECTORY ${OUTPUT}/man1)

function(print file)
  execute_process(COMMAND ${PROGRAM} ${ARGN} OUTPUT_FILE ${OUTPUT}/${file} RESULT_VARIABLE result)
  if(NOT result EQUAL 0)
    message(FATAL_ERROR "${PROGRAM} ${ARGN}: exit code ${result}")
  endif()
endfunction()

print(man1/wellknit.1 manual)
foreach(command ${commands})
  print(man1/wellknit-${command}.1 manual ${command})
endforeach()
print(wellknit.bash completion bash)
print(_wellknit completion zsh)
print(wellknit.fish completion fish)
file(TOUCH ${OUTPUT}/made)
