# SPDX-FileCopyrightText: 2026 The wellknit authors
# SPDX-License-Identifier: GPL-3.0-or-later
# All from Debian 12; why each one: docs/decisions/0001-dependencies.md
find_package(Eigen3 3.4 REQUIRED NO_MODULE)
find_package(fmt 9 REQUIRED)
find_package(TBB REQUIRED)
find_package(CGAL 5.5 REQUIRED)
find_package(HDF5 REQUIRED COMPONENTS C)
find_package(CLI11 2.1 REQUIRED)
find_package(nlohmann_json 3 REQUIRED)
find_package(OpenSSL REQUIRED COMPONENTS Crypto)
find_package(ZLIB REQUIRED)
find_package(FastFloat REQUIRED)
find_package(tomlplusplus REQUIRED)
find_package(pugixml REQUIRED)
# Its own CMake package asks for programs that it needs not.
find_package(PkgConfig REQUIRED)
pkg_check_modules(libzip REQUIRED IMPORTED_TARGET libzip)
