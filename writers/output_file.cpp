// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "writers/output_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>

#include "model/errors.h"

namespace wellknit {

namespace fs = std::filesystem;

namespace {

[[noreturn]] void fail(const std::string& path, const std::string& why) {
  throw WriteError(fmt::format("{}: cannot be written: {}", path, why));
}

fs::path folder_of(const fs::path& path) { return path.has_parent_path() ? path.parent_path() : fs::path("."); }

/// The file that a symbolic link stands for, so that the link itself survives the renaming.
std::string resolved(const std::string& path) {
  std::error_code error;
  if (!fs::is_symlink(path, error)) return path;
  const fs::path target = fs::weakly_canonical(path, error);
  return error ? path : target.string();
}

/// Creates a file that did not exist, with the permissions that the user's mask gives, and returns its name.
std::string create_beside(const std::string& target) {
  // The number in the name only has to step over what is there already: creation itself is exclusive.
  constexpr int attempts = 1000;
  for (int n = 0; n < attempts; ++n) {
    std::string name = fmt::format("{}.{}-{}.part", target, ::getpid(), n);
    const int descriptor = ::open(name.c_str(), O_CREAT | O_EXCL | O_WRONLY | O_CLOEXEC, 0666);
    if (descriptor >= 0) {
      ::close(descriptor);
      return name;
    }
    if (errno != EEXIST) fail(target, std::string(std::strerror(errno)) + "; choose a folder where you may write");
  }
  fail(target, "too many unfinished files stand beside it; remove the files that end in .part");
}

}  // namespace

void check_output_path(const std::string& path, Overwrite overwrite) {
  if (path.empty()) throw WriteError("the name of an output file is empty; give a path");
  const std::string target = resolved(path);
  std::error_code error;
  const fs::file_status status = fs::status(target, error);
  if (fs::exists(status)) {
    if (fs::is_directory(status)) fail(path, "it is a folder; give the name of a file in it");
    // Renaming onto a device would replace the device.
    if (!fs::is_regular_file(status)) fail(path, "it is not a regular file; give the name of one");
    if (overwrite == Overwrite::refuse) fail(path, "it exists already; pass --overwrite to replace it");
  }
  const fs::path folder = folder_of(target);
  if (!fs::is_directory(folder, error))
    fail(path, fmt::format("there is no folder {}; make it first", folder.string()));
  if (::access(folder.c_str(), W_OK | X_OK) != 0)
    fail(path, fmt::format("the folder {} is not writable; choose another", folder.string()));
}

OutputFile::OutputFile(const std::string& path, Overwrite overwrite) : target_(resolved(path)), overwrite_(overwrite) {
  check_output_path(path, overwrite);
  temporary_ = create_beside(target_);
}

OutputFile::~OutputFile() {
  if (!committed_) ::unlink(temporary_.c_str());
}

void OutputFile::commit() {
  // Somebody else may have made the target since the beginning.
  check_output_path(target_, overwrite_);
  std::error_code error;
  fs::rename(temporary_, target_, error);
  if (error) fail(target_, error.message());
  committed_ = true;
}

OutputStream::OutputStream(const std::string& path, Overwrite overwrite)
    : path_(path), file_(path, overwrite), stream_(file_.temporary_path(), std::ios::binary | std::ios::trunc) {
  if (!stream_) fail(path, "it cannot be opened");
}

void OutputStream::commit() {
  stream_.close();
  if (stream_.fail()) fail(path_, "not everything could be written; is the disk full?");
  file_.commit();
}

}  // namespace wellknit
