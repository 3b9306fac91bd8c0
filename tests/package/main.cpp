// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// consumer GRID OUT: a grid through all four libraries.
#include <algorithm/build_mesh.h>
#include <readers/read_case.h>
#include <wellknit_version.h>
#include <writers/write_hdf5.h>

#include <iostream>

int main(int, char** argv) {
  const wellknit::Case source = wellknit::read_case(argv[1]);
  const wellknit::BuildResult result = wellknit::build_mesh(source, {}, {});
  wellknit::write_hdf5(result.mesh, {"consumer", "consumer", "", source.sources}, argv[2]);
  std::cout << wellknit::version << ' ' << result.mesh.cells.size() << '\n';
}
