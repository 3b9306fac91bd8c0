# SPDX-FileCopyrightText: 2026 The wellknit authors
# SPDX-License-Identifier: GPL-3.0-or-later
# `cpack` in the build folder makes the Debian packages wellknit, libwellknit-dev and, where the module was built, python3-wellknit.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME wellknit)
set(CPACK_PACKAGE_VENDOR "The wellknit authors")
set(CPACK_PACKAGE_CONTACT "The wellknit authors <wellknit@localhost>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "${PROJECT_DESCRIPTION}")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_VERBATIM_VARIABLES ON)

set(CPACK_COMPONENTS_ALL program development)
if(TARGET wellknit_python)
  list(APPEND CPACK_COMPONENTS_ALL python)
endif()
set(CPACK_COMPONENTS_GROUPING IGNORE)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME wellknit)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PROGRAM_DESCRIPTION
    "wellknit reads a deck or a corner-point grid and well paths, and writes one\npolyhedral mesh with its finite-volume connections, ready for a simulator.")
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME libwellknit-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
# The libraries are static: whoever links them needs what they link.
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS
    "libeigen3-dev, libfmt-dev, libtbb-dev, libcgal-dev, libhdf5-dev, nlohmann-json3-dev, libssl-dev, libfast-float-dev, libtomlplusplus-dev, libpugixml-dev, libzip-dev, zlib1g-dev, pkg-config")
set(CPACK_DEBIAN_DEVELOPMENT_DESCRIPTION
    "Readers, the method, writers and the report of wellknit, for find_package(wellknit).")
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-wellknit)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS "python3, python3-numpy")
set(CPACK_DEBIAN_PYTHON_DESCRIPTION "Builds, reads, checks and writes meshes of wellknit from Python, with arrays of NumPy.")
include(CPack)
