// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "writers/output_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>

#include "model/errors.h"
#include "writers/unfinished_outputs.h"

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

enum class Kind { file, folder };

/// Creates a file or folder unless something of this name is there; false and errno otherwise.
bool create(const std::string& name, Kind kind) {
  if (kind == Kind::folder) return ::mkdir(name.c_str(), 0777) == 0;
  const int descriptor = ::open(name.c_str(), O_CREAT | O_EXCL | O_WRONLY | O_CLOEXEC, 0666);
  if (descriptor < 0) return false;
  ::close(descriptor);
  return true;
}

/// Creates what did not exist, with the permissions that the user's mask gives, and returns its name.
std::string create_beside(const std::string& target, Kind kind) {
  // The number in the name only has to step over what is there already: creation itself is exclusive.
  constexpr int attempts = 1000;
  for (int n = 0; n < attempts; ++n) {
    std::string name = fmt::format("{}.{}-{}.part", target, ::getpid(), n);
    if (create(name, kind)) return name;
    if (errno != EEXIST) fail(target, std::string(std::strerror(errno)) + "; choose a folder where you may write");
  }
  fail(target, "too many unfinished files stand beside it; remove the files that end in .part");
}

/// The path without slashes at its end: what it names can then be renamed and has a parent.
std::string without_last_slash(std::string path) {
  while (path.size() > 1 && path.back() == '/') path.pop_back();
  return path;
}

bool is_among(const std::string& file, FolderContents contents) {
  return std::any_of(contents.begin(), contents.end(), [&](std::string_view known) {
    return known.back() == '/' ? file.starts_with(known) : file == known;
  });
}

/// Refuses unless all that a replacement would delete is a former output.
void check_folder(const std::string& path, const std::string& folder, Overwrite overwrite, FolderContents contents) {
  std::error_code error;
  auto entry = fs::recursive_directory_iterator(folder, error);
  for (; !error && entry != fs::recursive_directory_iterator(); entry.increment(error)) {
    if (entry->is_directory(error) && !entry->is_symlink(error)) continue;
    if (overwrite == Overwrite::refuse) fail(path, "it exists already; pass --overwrite to replace it");
    const std::string name = entry->path().lexically_relative(folder).generic_string();
    if (!is_among(name, contents))
      fail(path,
           fmt::format("the folder there holds {}, which is no file of this format; choose another folder", name));
  }
  if (error) fail(path, error.message());
}

/// Puts a folder in the place of another one, which comes back if that fails.
void replace_folder(const std::string& fresh, const std::string& target, std::error_code& error) {
  fs::rename(fresh, target, error);  // works when there is none or an empty one
  if (!error || !fs::is_directory(target)) return;
  const std::string aside = fresh + ".old";
  fs::rename(target, aside, error);
  if (error) return;
  fs::rename(fresh, target, error);
  std::error_code ignored;  // what is left of the old one does no harm
  if (error)
    fs::rename(aside, target, ignored);
  else
    fs::remove_all(aside, ignored);
}

}  // namespace

void check_output_path(const std::string& path, Overwrite overwrite, FolderContents contents) {
  if (path.empty()) throw WriteError("the name of an output file is empty; give a path");
  const bool is_folder = !contents.empty();
  const std::string target = resolved(is_folder ? without_last_slash(path) : path);
  std::error_code error;
  const fs::file_status status = fs::status(target, error);
  if (fs::exists(status) && is_folder) {
    if (!fs::is_directory(status)) fail(path, "it is a file; this format is a folder, give the name of one");
    check_folder(path, target, overwrite, contents);
  } else if (fs::exists(status)) {
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

OutputFile::OutputFile(const std::string& path, Overwrite overwrite, FolderContents contents)
    : target_(resolved(contents.empty() ? path : without_last_slash(path))),
      overwrite_(overwrite),
      contents_(contents) {
  check_output_path(path, overwrite, contents);
  const auto hold = hold_unfinished_outputs();
  temporary_ = create_beside(target_, contents.empty() ? Kind::file : Kind::folder);
  add_unfinished_output(temporary_);
}

OutputFile::~OutputFile() {
  std::error_code ignored;  // nothing more can be done about what cannot be removed
  if (committed_) return;
  fs::remove_all(temporary_, ignored);
  forget_unfinished_output(temporary_);
}

std::int64_t OutputFile::size() const {
  if (contents_.empty()) return static_cast<std::int64_t>(fs::file_size(temporary_));
  std::uintmax_t bytes = 0;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(temporary_))
    if (entry.is_regular_file()) bytes += entry.file_size();
  return static_cast<std::int64_t>(bytes);
}

void OutputFile::commit() {
  // Somebody else may have made the target since the beginning.
  check_output_path(target_, overwrite_, contents_);
  const auto hold = hold_unfinished_outputs();
  std::error_code error;
  if (contents_.empty())
    fs::rename(temporary_, target_, error);
  else
    replace_folder(temporary_, target_, error);
  if (error) fail(target_, error.message());
  committed_ = true;
  forget_unfinished_output(temporary_);
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
