# SPDX-FileCopyrightText: 2026 The wellknit authors
# SPDX-License-Identifier: GPL-3.0-or-later
# Language level, warnings, sanitizers, coverage. Every target of ours links wellknit_options.
set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)

find_program(CCACHE_PROGRAM ccache)
if(CCACHE_PROGRAM AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  # Without these ccache keeps nothing that uses precompiled headers.
  set(CMAKE_CXX_COMPILER_LAUNCHER ${CMAKE_COMMAND} -E env CCACHE_SLOPPINESS=pch_defines,time_macros ${CCACHE_PROGRAM})
endif()

set(WELLKNIT_SANITIZE "" CACHE STRING "Sanitizers, as for -fsanitize= (address,undefined or thread)")
option(WELLKNIT_COVERAGE "Instrument algorithm/ for line coverage" OFF)
option(WELLKNIT_WERROR "Warnings are errors" ON)
option(WELLKNIT_PRECOMPILE "Compile the headers that most sources include once for each target" ON)

add_library(wellknit_options INTERFACE)
# No contraction: the same input gives the same bytes on every machine of one architecture.
target_compile_options(wellknit_options INTERFACE -ffp-contract=off -Wall -Wextra -Wpedantic -Wshadow -Wconversion
                                                  -Wnon-virtual-dtor -Woverloaded-virtual -Wnull-dereference)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  # g++ 12 reports these inside Eigen and the standard library after inlining.
  target_compile_options(wellknit_options INTERFACE -Wno-null-dereference -Wno-maybe-uninitialized -Wno-array-bounds
                                                    -Wno-restrict -Wno-stringop-overflow -Wno-stringop-overread)
endif()
if(WELLKNIT_WERROR)
  target_compile_options(wellknit_options INTERFACE -Werror)
endif()
if(WELLKNIT_SANITIZE)
  # A null or misaligned pointer stops the program under the address sanitizer too; checked at each access of Eigen's they double the
  # time to compile and treble the code.
  target_compile_options(wellknit_options INTERFACE -fsanitize=${WELLKNIT_SANITIZE} -fno-sanitize=null,alignment
                                                    -fno-omit-frame-pointer -fno-sanitize-recover=all)
  target_link_options(wellknit_options INTERFACE -fsanitize=${WELLKNIT_SANITIZE})
endif()
if(WELLKNIT_COVERAGE)
  target_link_options(wellknit_options INTERFACE --coverage)
endif()

# wellknit_precompile(TARGET HEADERS…): the headers that most sources include, compiled once.
function(wellknit_precompile target)
  if(WELLKNIT_PRECOMPILE)
    target_precompile_headers(${target} PRIVATE ${PROJECT_SOURCE_DIR}/cmake/precompiled.h ${ARGN})
    target_compile_options(${target} PRIVATE $<IF:$<CXX_COMPILER_ID:GNU>,-fpch-preprocess,SHELL:-Xclang -fno-pch-timestamp>)
  endif()
endfunction()

# wellknit_library(NAME SOURCES… LINK targets…): one static library, headers included from the project's root.
function(wellknit_library name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "" "SOURCES;LINK;PRIVATE_LINK")
  add_library(wellknit_${name} STATIC ${arg_SOURCES})
  add_library(wellknit::${name} ALIAS wellknit_${name})
  set_target_properties(wellknit_${name} PROPERTIES EXPORT_NAME ${name})
  target_include_directories(wellknit_${name} PUBLIC $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>
                                                     $<BUILD_INTERFACE:${PROJECT_BINARY_DIR}/generated>
                                                     $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/wellknit>)
  target_compile_features(wellknit_${name} PUBLIC cxx_std_20)
  target_link_libraries(wellknit_${name} PUBLIC ${arg_LINK} PRIVATE $<BUILD_INTERFACE:wellknit_options> ${arg_PRIVATE_LINK})
  wellknit_precompile(wellknit_${name})
endfunction()
