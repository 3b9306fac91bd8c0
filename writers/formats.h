// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// The table of writers. `--write FORMAT=PATH`, `wellknit formats` and the README's matrix come from it.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "model/mesh.h"
#include "model/provenance.h"
#include "writers/output_file.h"
#include "writers/writer_options.h"

namespace wellknit {

/// One output that is to be written.
struct WriteRequest {
  const Mesh& mesh;
  const Provenance& provenance;
  std::string path;
  Overwrite overwrite = Overwrite::refuse;
  WriterOptions options = {};
  const CornerPointGrid* source = nullptr;   ///< of the mesh, where it is known
  std::vector<std::string> side_paths = {};  ///< of WriterFormat::side_files; empty: where they belong
};

struct WriterFormat {
  std::string_view name;                         ///< as in `--write name=PATH`
  std::span<const std::string_view> extensions;  ///< lower case, with the dot; the first is the usual one
  std::string_view description;                  ///< one line
  std::string_view document;                     ///< page under docs/formats
  FolderContents contents;                       ///< of a format that is a folder; empty: it is a file
  /// Writes the mesh; returns what its user must know, one sentence each. Throws WriteError, and InvalidInput where the
  /// mesh or the options cannot be written so.
  std::vector<std::string> (*write)(const WriteRequest& request);
  /// Further files beside the output of this path, whole paths; null: none.
  std::vector<std::string> (*side_files)(const std::string& path, const WriterOptions& options) = nullptr;
};

std::span<const WriterFormat> writer_formats();

/// By name, upper or lower case; nullptr when there is none.
const WriterFormat* find_writer(std::string_view name);

/// By the extension of a path, upper or lower case; nullptr when no writer has it.
const WriterFormat* writer_of_path(const std::string& path);

}  // namespace wellknit
