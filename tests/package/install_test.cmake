# SPDX-FileCopyrightText: 2026 The wellknit authors
# SPDX-License-Identifier: GPL-3.0-or-later
# Installs the build BUILD below WORK, builds the consumer of SOURCE against it, and runs it on GRID.
file(REMOVE_RECURSE ${WORK})

function(step)
  execute_process(COMMAND ${ARGV} COMMAND_ECHO STDOUT RESULT_VARIABLE result)
  if(NOT result EQUAL 0)
    message(FATAL_ERROR "exit code ${result}")
  endif()
endfunction()

step(${CMAKE_COMMAND} --install ${BUILD} --prefix ${WORK}/prefix)
step(${CMAKE_COMMAND} -G Ninja -S ${SOURCE} -B ${WORK}/build -DCMAKE_PREFIX_PATH=${WORK}/prefix -DCMAKE_CXX_COMPILER=${COMPILER})
step(${CMAKE_COMMAND} --build ${WORK}/build)
step(${WORK}/build/consumer ${GRID} ${WORK}/out.h5)
step(${WORK}/prefix/bin/wellknit check ${WORK}/out.h5)

# A C program with what pkg-config says. CMake put the prefix of the build into wellknit.pc; this installation has another.
file(GLOB_RECURSE description ${WORK}/prefix/wellknit.pc)
get_filename_component(folder ${description} DIRECTORY)
get_filename_component(libraries ${folder} DIRECTORY)
execute_process(COMMAND ${CMAKE_COMMAND} -E env PKG_CONFIG_PATH=${folder} pkg-config --define-variable=prefix=${WORK}/prefix --cflags --libs wellknit
                OUTPUT_VARIABLE flags OUTPUT_STRIP_TRAILING_WHITESPACE RESULT_VARIABLE result)
if(NOT result EQUAL 0)
  message(FATAL_ERROR "pkg-config knows no wellknit")
endif()
separate_arguments(flags)
step(cc ${SOURCE}/program.c -o ${WORK}/program ${flags} -Wl,-rpath,${libraries})
step(${WORK}/program ${GRID} ${WORK}/c.h5)
step(${WORK}/prefix/bin/wellknit check ${WORK}/c.h5)

# The Python module, where it was built.
file(GLOB_RECURSE module ${WORK}/prefix/lib/python3/dist-packages/wellknit*.so)
if(module AND EXISTS /usr/bin/python3)
  step(${CMAKE_COMMAND} -E env PYTHONPATH=${WORK}/prefix/lib/python3/dist-packages /usr/bin/python3 -c
       "import wellknit; print(wellknit.build('${GRID}'), len(wellknit.read('${WORK}/c.h5')['cells/volume']))")
endif()
