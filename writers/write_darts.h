// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// Connection lists for open-DARTS, as arrays of numpy or of HDF5, and for AD-GPRS as text (docs/formats/darts.md).
/// Depth down, 0-based, millidarcy and metric transmissibilities.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "model/mesh.h"
#include "writers/output_file.h"

namespace wellknit {

/// cP rm3 / (day bar) for one mD m, as open-DARTS has it; Eclipse's differs by 3.5e-5 of it.
inline constexpr double darts_transmissibility_per_md_m = 0.0085267146719160105;

/// One .npz file. Writes beside the target and renames. Returns what its user must know, one sentence each. Throws
/// WriteError. The mesh's structure must be right (check_structure()); the others' as well.
std::vector<std::string> write_darts(const Mesh& mesh, const std::string& path,
                                     Overwrite overwrite = Overwrite::refuse);

/// The same arrays by the same names in one HDF5 file.
std::vector<std::string> write_darts_hdf5(const Mesh& mesh, const std::string& path,
                                          Overwrite overwrite = Overwrite::refuse);

/// What the folder of AD-GPRS may hold.
inline constexpr std::array<std::string_view, 9> adgprs_contents{"dimens.txt", "connections.txt", "volume.txt",
                                                                 "poro.txt",   "depth.txt",       "permx.txt",
                                                                 "permy.txt",  "permz.txt",       "wells.csv"};

/// Keyword files of AD-GPRS, which older open-DARTS reads too. Writes the folder beside its target and renames it.
std::vector<std::string> write_adgprs(const Mesh& mesh, const std::string& path,
                                      Overwrite overwrite = Overwrite::refuse);

}  // namespace wellknit
