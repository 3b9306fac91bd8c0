// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// Recognises the files that are written for other programs, and counts what is in them. They are not read as meshes.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

namespace wellknit {

bool looks_like_opm_grid(std::string_view text);
bool looks_like_mat_file(std::string_view text);
bool looks_like_pflotran_grid(std::string_view text);
bool looks_like_tough_mesh(std::string_view text);
bool looks_like_darts_arrays(std::string_view text);
bool looks_like_adgprs_connections(std::string_view text);
bool looks_like_cell_table(std::string_view text);
bool looks_like_connection_table(std::string_view text);
bool looks_like_fehm_stor(std::string_view text);
bool looks_like_dgf(std::string_view text);
bool looks_like_vtk_grid(std::string_view text);
bool looks_like_vtk_lines(std::string_view text);
bool looks_like_foam_labels(std::string_view text);

/// What such a file says of itself; unset where it does not, or not in a way that can be told without reading it all.
struct ExportedCounts {
  std::optional<std::int64_t> cells;
  std::optional<std::int64_t> faces;
  std::optional<std::int64_t> vertices;
  std::optional<std::int64_t> connections;
};

/// Files of an output that is a folder, relative to it: those that are counted.
std::span<const std::string_view> counted_files_of_folders();

/// By content; nothing is set for any other file, or where a count is not a number.
ExportedCounts count_exported_mesh(std::string_view text);

}  // namespace wellknit
