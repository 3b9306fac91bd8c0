// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "readers/read_trajectory.h"

#include <fmt/format.h>

#include "model/errors.h"
#include "readers/file_content.h"
#include "readers/formats.h"
#include "readers/parse_trajectory.h"

namespace wellknit {

TrajectoryFile parse_trajectory(std::string_view text, const std::string& path, const TrajectoryOptions& options) {
  const ReaderFormat* format = recognise(path, text);
  if (format != nullptr && format->is_read && format->kind == FormatKind::wells)
    return format->read_wells(text, path, options);
  const std::string found = text.empty()        ? "an empty file"
                            : format == nullptr ? "none that is known"
                                                : fmt::format("a file in the format {}", format->name);
  const bool unread = format != nullptr && !format->is_read;
  throw ParseError({path, 0, ""}, {"a well path: CSV with MD,X,Y,TVD or MD,INC,AZI, or another of `wellknit formats`",
                                   found, unread ? not_read_advice(*format) : "see wellknit formats"});
}

TrajectoryFile read_trajectory(const std::string& path, const TrajectoryOptions& options) {
  const FileContent content = load_file(path);
  return parse_trajectory(content.text, path, options);
}

}  // namespace wellknit
