// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// dump_case FOLDER CASE [GRID_INCLUDE …]: every array that the reader makes of a case, as NAME.f64 (doubles of this
/// machine), and its notes and faults as text, for a comparison with other readers.
#include <cstdio>
#include <fstream>
#include <iostream>
#include <string>
#include <vector>

#include "model/errors.h"
#include "readers/read_case.h"

namespace {

template <class T>
void write(const std::string& folder, const std::string& name, const std::vector<T>& values) {
  if (values.empty()) return;
  const std::vector<double> out(values.begin(), values.end());
  std::ofstream file(folder + "/" + name + ".f64", std::ios::binary);
  file.write(reinterpret_cast<const char*>(out.data()), static_cast<std::streamsize>(out.size() * sizeof(double)));
}

void write_case(const std::string& folder, const wellknit::Case& read) {
  const wellknit::CornerPointGrid& grid = read.grid;
  write(folder, "dimensions", std::vector<std::int64_t>(grid.dimensions.begin(), grid.dimensions.end()));
  write(folder, "COORD", grid.coord);
  write(folder, "ZCORN", grid.zcorn);
  write(folder, "ACTNUM", grid.active);
  write(folder, "PORO", grid.porosity);
  write(folder, "NTG", grid.net_to_gross);
  for (std::size_t axis = 0; axis < 3; ++axis)
    write(folder, std::string("PERM") + "XYZ"[axis], grid.permeability[axis]);
  for (const auto& [name, property] : grid.properties)
    std::visit([&, &key = name](const auto& values) { write(folder, key, values); }, property);
  std::vector<double> volumes;
  for (std::int64_t cell = 0; cell < grid.cell_count(); ++cell)
    volumes.push_back(wellknit::bilinear_hexahedron_volume(grid.corners(wellknit::HostCellId(cell))));
  write(folder, "volume", volumes);
  for (std::size_t face = 0; face < grid.edits.face_multiplier.size(); ++face)
    write(folder, wellknit::multiplier_keyword(static_cast<wellknit::FaceDirection>(face)),
          grid.edits.face_multiplier[face]);
  write(folder, "MULTPV", grid.edits.pore_volume_multiplier);
  write(folder, "MULTPV edit", grid.edits.pore_volume_multiplier_edit);
  std::ofstream faults(folder + "/faults.txt");
  for (const wellknit::Fault& fault : grid.edits.faults)
    faults << fault.name << '\t' << fault.face_count() << '\t' << fault.multiplier << '\n';
  std::ofstream notes(folder + "/notes.txt");
  for (const std::string& note : read.notes) notes << note << '\n';
}

}  // namespace

int main(int argc, char** argv) {
  const std::vector<std::string> arguments(argv + 1, argv + argc);
  if (arguments.size() < 2) return 2;
  try {
    write_case(arguments[0], wellknit::read_case(arguments[1], {arguments.begin() + 2, arguments.end()}));
  } catch (const wellknit::ParseError& error) {
    std::cerr << error.what() << '\n';
    return 1;
  }
  return 0;
}
