// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// An output file that appears whole or not at all: written beside its target and renamed when it is complete.
#pragma once

#include <cstdint>
#include <fstream>
#include <string>

namespace wellknit {

enum class Overwrite : std::uint8_t { refuse, allow };

/// Throws WriteError when `path` cannot become an output file: its folder is missing or not writable, something that is
/// not a regular file stands there, or a file exists and `overwrite` refuses. For asking before a long run.
void check_output_path(const std::string& path, Overwrite overwrite);

/// A temporary file beside the target. Unless commit() was reached, the destructor removes it and the target is as it
/// was.
class OutputFile {
 public:
  /// Creates the empty temporary. Throws WriteError as check_output_path() does.
  OutputFile(const std::string& path, Overwrite overwrite);
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  [[nodiscard]] const std::string& temporary_path() const { return temporary_; }
  /// Gives the file its name. It must be closed by then. Throws WriteError.
  void commit();

 private:
  std::string target_;  ///< a symbolic link is followed, so that it is its file that is replaced
  std::string temporary_;
  Overwrite overwrite_;
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
