// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// Recognises the HDF5 files that are written for other programs by the datasets in them.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "readers/exported_mesh.h"

namespace wellknit {

struct ExportedHdf5 {
  std::string_view format;
  ExportedCounts counts;
};

/// Unset for any other file, those that HDF5 cannot open among them.
std::optional<ExportedHdf5> describe_exported_hdf5(const std::string& path);

}  // namespace wellknit
