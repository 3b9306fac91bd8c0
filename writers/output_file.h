// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// An output, a file or a folder of files, that appears whole or not at all: written beside its target and renamed when
/// it is complete.
#pragma once

#include <cstdint>
#include <fstream>
#include <span>
#include <string>
#include <string_view>

namespace wellknit {

enum class Overwrite : std::uint8_t { refuse, allow };

/// What an output that is a folder may hold, as paths relative to it; one that ends in '/' stands for all that is
/// below. Empty: the output is a file.
using FolderContents = std::span<const std::string_view>;

/// Throws WriteError when `path` cannot become an output: its folder is missing or not writable, something of another
/// kind stands there, or it exists and `overwrite` refuses. A folder without any file in it counts as not existing; one
/// that holds anything but `contents` is never replaced. For asking before a long run.
void check_output_path(const std::string& path, Overwrite overwrite, FolderContents contents = {});

/// A temporary file or folder beside the target. Unless commit() was reached, the destructor removes it and the target
/// is as it was.
class OutputFile {
 public:
  /// Creates the empty temporary: a folder when there are `contents`, which must outlive it. Throws WriteError as
  /// check_output_path() does.
  OutputFile(const std::string& path, Overwrite overwrite, FolderContents contents = {});
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  [[nodiscard]] const std::string& temporary_path() const { return temporary_; }
  /// Bytes of the temporary, all of its files together.
  [[nodiscard]] std::int64_t size() const;
  /// Gives the file its name. It must be closed by then. Throws WriteError.
  void commit();

 private:
  std::string target_;  ///< a symbolic link is followed, so that it is its file that is replaced
  std::string temporary_;
  Overwrite overwrite_;
  FolderContents contents_;
  bool committed_ = false;
};

/// An OutputFile written through a stream: text or bytes.
class OutputStream {
 public:
  OutputStream(const std::string& path, Overwrite overwrite);
  std::ofstream& stream() { return stream_; }
  /// Closes and renames. Throws WriteError when anything could not be written (a full disk).
  void commit();

 private:
  std::string path_;
  OutputFile file_;
  std::ofstream stream_;
};

}  // namespace wellknit
