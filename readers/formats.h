// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// The one table of what is read, and how a file is recognised: by its content, then by its extension.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "readers/file_content.h"
#include "readers/grid_part.h"
#include "readers/read_trajectory.h"

namespace wellknit {

enum class FormatKind { grid, wells, mesh };

struct ReaderFormat {
  std::string_view name;
  FormatKind kind;
  std::vector<std::string_view> extensions;  ///< lower case, with the dot
  std::string_view content;                  ///< how it is recognised, for documentation
  std::string_view description;
  bool is_read;  ///< false: recognised, and refused with advice
  bool is_binary;
  bool (*recognises)(std::string_view text);  ///< by content
  TrajectoryFile (*read_wells)(std::string_view text, const std::string& path,
                               const TrajectoryOptions& options) = nullptr;          ///< kind wells
  GridPart (*read_grid)(std::string_view bytes, const std::string& path) = nullptr;  ///< kind grid, not a deck
};

/// In the order in which they are tried.
const std::vector<ReaderFormat>& reader_formats();

/// The format of a file with this content, or nothing. The extension decides only where the content does not.
const ReaderFormat* recognise(const std::string& path, std::string_view text);

/// The binary format of this content, or nothing.
const ReaderFormat* recognise_binary(std::string_view text);

/// The format of a loaded file, whether it is read or not. Throws ParseError when it is empty or not recognised.
const ReaderFormat& recognise_content(const FileContent& content);

/// The format of a file on the disk. Throws ParseError when it is missing, empty, not recognised, or recognised and not
/// read.
const ReaderFormat& recognise_file(const std::string& path);

/// What to do with a file of this format where it is not read: "not read yet; …" for one that is recognised only.
std::string not_read_advice(const ReaderFormat& format);

}  // namespace wellknit
