# SPDX-FileCopyrightText: 2026 The wellknit authors
# SPDX-License-Identifier: GPL-3.0-or-later
# What `cmake --install` lays down: the program, the libraries with their headers, and find_package(wellknit).
include(CMakePackageConfigHelpers)

set(WELLKNIT_CMAKE_DIR ${CMAKE_INSTALL_LIBDIR}/cmake/wellknit)

install(TARGETS wellknit RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
install(TARGETS wellknit_model wellknit_readers wellknit_algorithm wellknit_writers
        EXPORT wellknit-targets
        ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(EXPORT wellknit-targets NAMESPACE wellknit:: DESTINATION ${WELLKNIT_CMAKE_DIR})

foreach(folder model readers algorithm writers)
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/${folder} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/wellknit
          FILES_MATCHING PATTERN "*.h")
endforeach()
install(FILES ${PROJECT_BINARY_DIR}/generated/wellknit_version.h DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/wellknit)
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE ${PROJECT_SOURCE_DIR}/README.md DESTINATION ${CMAKE_INSTALL_DOCDIR})

configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/wellknit-config.cmake.in
                              ${PROJECT_BINARY_DIR}/wellknit-config.cmake
                              INSTALL_DESTINATION ${WELLKNIT_CMAKE_DIR})
# Before 1.0 a minor version may break what the former one promised.
write_basic_package_version_file(${PROJECT_BINARY_DIR}/wellknit-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/wellknit-config.cmake ${PROJECT_BINARY_DIR}/wellknit-config-version.cmake
        DESTINATION ${WELLKNIT_CMAKE_DIR})
