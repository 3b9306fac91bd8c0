// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// Whole files, mapped from the disk or, for tests and fuzzers, from memory.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

namespace wellknit {

struct FileContent {
  std::string path;       ///< as it was found; may differ in case from the name that was asked for
  std::string_view text;  ///< lives as long as `owner`
  std::shared_ptr<const void> owner;
};

/// The content of a text in memory.
FileContent content_of(std::string path, std::string text);

/// Where the files of one run come from.
class FileStore {
 public:
  virtual ~FileStore() = default;
  /// The file of this name, or nothing. Throws ParseError when it is there and cannot be read.
  virtual std::optional<FileContent> load(const std::string& path) = 0;

 protected:
  FileStore() = default;
  FileStore(const FileStore&) = default;
  FileStore& operator=(const FileStore&) = default;
};

/// The disk. A name that is not there is looked for once more without regard to case.
class DiskFiles final : public FileStore {
 public:
  std::optional<FileContent> load(const std::string& path) override;
};

class MemoryFiles final : public FileStore {
 public:
  explicit MemoryFiles(std::map<std::string, std::string> files) : files_(std::move(files)) {}
  std::optional<FileContent> load(const std::string& path) override;

 private:
  std::map<std::string, std::string> files_;
};

/// Maps a file of the disk; it must not become shorter meanwhile. Throws ParseError when it is missing, a folder, or
/// unreadable.
FileContent load_file(const std::string& path);

/// The path as it stands on the disk: itself, else the first match without regard to case, else nothing.
std::optional<std::string> find_path_ignoring_case(const std::string& path);

/// SHA-256 in 64 lower-case hexadecimal digits.
std::string sha256_hex(std::string_view bytes);

}  // namespace wellknit
