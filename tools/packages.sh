# SPDX-FileCopyrightText: 2026 The wellknit authors
# SPDX-License-Identifier: GPL-3.0-or-later
# Debian 12 packages by purpose, and their installation; sourced by the scripts beside it.
# shellcheck shell=bash disable=SC2034

build_packages=(cmake ninja-build g++ libeigen3-dev libfmt-dev libtbb-dev libcgal-dev libhdf5-dev libcli11-dev
                nlohmann-json3-dev libssl-dev libfast-float-dev libtomlplusplus-dev libpugixml-dev libzip-dev
                zlib1g-dev pkg-config)
simulation_packages=(libopm-simulators-bin)
test_packages=(libgtest-dev libmatio-dev python3 python3-numpy python3-h5py python3-vtk9)
# Consumers whose tests are skipped without them; openfoam installs in half a minute, with --no-install-recommends.
# Without gfortran and pybind11 the Fortran example and the Python module are not built.
optional_packages=(gfortran pybind11-dev python3-dev python3-opm-common openfoam libopm-grid-dev octave chromium chromium-driver python3-selenium mkdocs)
site_packages=(mkdocs)
picture_packages=(python3-matplotlib)  # of docs/validation.md, when they are made anew
benchmark_packages=(libbenchmark-dev libopm-common-dev libopm-grid-dev)
ci_packages=(clang libclang-rt-14-dev clang-format clang-tidy gcovr llvm-14 ccache libbenchmark-dev git)

# install_missing PACKAGE…: asks apt only for what is not there, and not at all when nothing is missing.
install_missing() {
  local missing=() package
  for package in "$@"; do
    dpkg-query -W -f '${Status}' "$package" 2>/dev/null | grep -q 'ok installed' || missing+=("$package")
  done
  [ ${#missing[@]} -eq 0 ] && return 0
  if [ "$(id -u)" -ne 0 ]; then
    echo "these packages are missing; install them as root: apt-get install ${missing[*]}" >&2
    return 1
  fi
  echo "installing ${missing[*]}"
  export DEBIAN_FRONTEND=noninteractive
  apt-get update -qq
  apt-get install -y -qq --no-install-recommends "${missing[@]}" >/dev/null
}

# quietly LOG COMMAND…: runs it with its output in LOG, which is shown when it fails.
quietly() {
  local log=$1
  shift
  if ! "$@" >"$log" 2>&1; then
    tail -n 60 "$log" >&2
    echo "failed: $* (all of its output: $log)" >&2
    return 1
  fi
}
