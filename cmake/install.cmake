# SPDX-FileCopyrightText: 2026 The wellknit authors
# SPDX-License-Identifier: GPL-3.0-or-later
# What `cmake --install` lays down, in components: the program with its manual and completions; the libraries with their
# headers and find_package(wellknit); and, from interface/, the shared library for C and the Python module.
include(CMakePackageConfigHelpers)

set(WELLKNIT_CMAKE_DIR ${CMAKE_INSTALL_LIBDIR}/cmake/wellknit)
set(CMAKE_INSTALL_DEFAULT_COMPONENT_NAME program)

install(TARGETS wellknit RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
# Scripts by which other programs load what is written.
install(DIRECTORY ${PROJECT_SOURCE_DIR}/writers/loaders DESTINATION ${CMAKE_INSTALL_DATADIR}/wellknit)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/testdata/example DESTINATION ${CMAKE_INSTALL_DATADIR}/wellknit)
install(FILES ${PROJECT_SOURCE_DIR}/README.md ${PROJECT_SOURCE_DIR}/CHANGELOG.md DESTINATION ${CMAKE_INSTALL_DOCDIR})
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR} RENAME copyright)

# Manual pages and completions come from the program's own table of options.
set(reference ${PROJECT_BINARY_DIR}/reference)
add_custom_command(
  OUTPUT ${reference}/made
  COMMAND ${CMAKE_COMMAND} -DPROGRAM=$<TARGET_FILE:wellknit> -DOUTPUT=${reference} -P
          ${PROJECT_SOURCE_DIR}/cmake/reference.cmake
  DEPENDS wellknit ${PROJECT_SOURCE_DIR}/cmake/reference.cmake
  VERBATIM)
add_custom_target(reference ALL DEPENDS ${reference}/made)
install(DIRECTORY ${reference}/man1 DESTINATION ${CMAKE_INSTALL_MANDIR})
install(FILES ${reference}/wellknit.bash DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions RENAME wellknit)
install(FILES ${reference}/_wellknit DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/vendor-completions)
install(FILES ${reference}/wellknit.fish DESTINATION ${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d)

set(CMAKE_INSTALL_DEFAULT_COMPONENT_NAME development)
install(TARGETS wellknit_model wellknit_readers wellknit_algorithm wellknit_writers wellknit_report wellknit_conversion
        EXPORT wellknit-targets
        ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(EXPORT wellknit-targets NAMESPACE wellknit:: DESTINATION ${WELLKNIT_CMAKE_DIR})
foreach(folder model readers algorithm writers report conversion)
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/${folder} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/wellknit
          FILES_MATCHING PATTERN "*.h")
endforeach()
install(FILES ${PROJECT_BINARY_DIR}/generated/wellknit_version.h DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/wellknit)

configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/wellknit-config.cmake.in
                              ${PROJECT_BINARY_DIR}/wellknit-config.cmake
                              INSTALL_DESTINATION ${WELLKNIT_CMAKE_DIR})
# Before 1.0 a minor version may break what the former one promised.
write_basic_package_version_file(${PROJECT_BINARY_DIR}/wellknit-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/wellknit-config.cmake ${PROJECT_BINARY_DIR}/wellknit-config-version.cmake
        DESTINATION ${WELLKNIT_CMAKE_DIR})
