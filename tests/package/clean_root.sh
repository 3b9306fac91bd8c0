#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The wellknit authors
# SPDX-License-Identifier: GPL-3.0-or-later
# clean_root.sh BUILD: installs BUILD's wellknit_*.deb on a root made with debootstrap (Debian 12, nothing else in it), runs the
# example there, and opens a manual page; then python3-wellknit and libwellknit-dev, and runs Python, C, Fortran and C++ programs. As root; needs debootstrap and Debian's packages. Run by hand and before a release.
set -euo pipefail
build=$(cd "$1" && pwd)
root=$(mktemp -d)
trap 'rm -rf "$root"' EXIT
# The sources of this machine: the same mirror, and what apt must know to reach it.
mirror=$(apt-get indextargets --format '$(SITE) $(CODENAME)' 'Created-By: Packages' | awk '$2 == "bookworm" {print $1; exit}')
[ -n "$mirror" ] || { echo "apt knows no mirror of bookworm; run apt-get update" >&2; exit 1; }
debootstrap --variant=minbase bookworm "$root" "$mirror" >"$root.log" 2>&1 || { tail "$root.log"; exit 1; }
cp /etc/resolv.conf "$root/etc/" 2>/dev/null || true
cp "$build"/*wellknit*.deb "$root/tmp/"
cp "$(dirname "$0")"/{CMakeLists.txt,main.cpp,program.c} "$root/tmp/"
inside() { chroot "$root" /usr/bin/env -i PATH=/usr/bin:/bin:/usr/sbin:/sbin LC_ALL=C.UTF-8 DEBIAN_FRONTEND=noninteractive bash -ec "$1"; }
inside 'apt-get update -qq && apt-get install -y -qq --no-install-recommends /tmp/wellknit_*.deb' >"$root.log" 2>&1 || { tail "$root.log"; exit 1; }
inside 'cd /tmp && cp -r /usr/share/wellknit/example . && cd example &&
  wellknit build example.GRDECL --well curved.csv --well steep.dev -o example.h5 --write deck=EXAMPLE.DATA --report example.html &&
  wellknit check example.h5 | head -n 1 && ls -l example.h5 EXAMPLE.DATA example.html &&
  test -s /usr/share/bash-completion/completions/wellknit && wellknit manual build | head -n 1'
inside 'apt-get install -y -qq --no-install-recommends /tmp/python3-wellknit_*.deb /tmp/libwellknit-dev_*.deb cmake g++ make gfortran pkg-config' >"$root.log" 2>&1 ||
  { tail "$root.log"; exit 1; }
inside 'cd /tmp/example && python3 -c "
import wellknit
mesh = wellknit.build(\"example.GRDECL\", [\"curved.csv\"])
print(\"Python:\", len(mesh[\"cells/volume\"]), \"cells\", mesh.violations())"
  cc ../program.c -o c $(pkg-config --cflags --libs wellknit)
  ./c example.GRDECL c.h5
  gfortran /usr/share/wellknit/fortran/{wellknit,example}.f90 -o f $(pkg-config --libs wellknit)
  ./f example.GRDECL curved.csv f.h5
  cmake -S /tmp -B /tmp/b >/dev/null 2>&1
  cmake --build /tmp/b >/dev/null
  /tmp/b/consumer example.GRDECL cpp.h5
  for file in c f cpp; do wellknit check $file.h5 >check.txt; head -n 1 check.txt; done'
rm -f "$root.log"
echo "installed and run on a clean root"
