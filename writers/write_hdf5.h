// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// The mesh file: HDF5, schema 1.0 (docs/formats/hdf5.md). The same mesh gives the same bytes.
#pragma once

#include <string>

#include "model/mesh.h"
#include "model/provenance.h"
#include "writers/output_file.h"

namespace wellknit {

/// Writes beside the target and renames, so that a failed run leaves nothing. Throws WriteError.
/// An empty `mesh.transfer` leaves out the group `transfer`.
void write_hdf5(const Mesh& mesh, const Provenance& provenance, const std::string& path,
                Overwrite overwrite = Overwrite::refuse);

}  // namespace wellknit
