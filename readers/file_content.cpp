// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "readers/file_content.h"

#include <fcntl.h>
#include <openssl/evp.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <vector>

#include "model/errors.h"
#include "readers/text.h"

namespace wellknit {

namespace fs = std::filesystem;

namespace {

/// The entry of a folder with this name in any case; the first in alphabetical order, so that runs agree.
std::optional<fs::path> entry_ignoring_case(const fs::path& folder, const std::string& name) {
  std::error_code error;
  std::vector<fs::path> matches;
  for (fs::directory_iterator at(folder.empty() ? fs::path(".") : folder, error), end; !error && at != end;
       at.increment(error)) {
    if (equal_ignoring_case(at->path().filename().string(), name)) matches.push_back(folder / at->path().filename());
  }
  if (matches.empty()) return std::nullopt;
  return *std::min_element(matches.begin(), matches.end());
}

[[noreturn]] void fail(const std::string& path, const std::string& expected, const std::string& found,
                       const std::string& advice) {
  throw ParseError({path, 0, ""}, {expected, found, advice});
}

class FileDescriptor {
 public:
  explicit FileDescriptor(const std::string& path) : number_(::open(path.c_str(), O_RDONLY | O_CLOEXEC)) {}
  ~FileDescriptor() {
    if (number_ >= 0) ::close(number_);
  }
  FileDescriptor(const FileDescriptor&) = delete;
  FileDescriptor& operator=(const FileDescriptor&) = delete;
  FileDescriptor(FileDescriptor&&) = delete;
  FileDescriptor& operator=(FileDescriptor&&) = delete;
  [[nodiscard]] int number() const { return number_; }

 private:
  int number_;
};

FileContent map_file(const std::string& path) {
  const FileDescriptor file(path);
  struct stat status {};
  if (file.number() < 0 || ::fstat(file.number(), &status) != 0)
    fail(path, "a readable file", "one that cannot be opened", "check its permissions");
  const auto size = static_cast<std::size_t>(status.st_size);
  if (size == 0) return {path, {}, nullptr};
  void* const begin = ::mmap(nullptr, size, PROT_READ, MAP_PRIVATE, file.number(), 0);
  if (begin == MAP_FAILED)
    fail(path, "a readable file", "one that cannot be mapped into memory", "copy the file and try again");
  std::shared_ptr<const void> owner(begin, [size](void* mapped) { ::munmap(mapped, size); });
  return {path, {static_cast<const char*>(begin), size}, std::move(owner)};
}

}  // namespace

std::optional<std::string> find_path_ignoring_case(const std::string& path) {
  std::error_code error;
  if (fs::exists(path, error)) return path;
  fs::path found;
  for (const fs::path& part : fs::path(path)) {
    if (fs::exists(found / part, error)) {
      found /= part;
      continue;
    }
    const auto match = entry_ignoring_case(found, part.string());
    if (!match) return std::nullopt;
    found = *match;
  }
  if (found.empty()) return std::nullopt;
  return found.string();
}

std::optional<FileContent> DiskFiles::load(const std::string& path) {
  const auto found = find_path_ignoring_case(path);
  if (!found) return std::nullopt;
  std::error_code error;
  if (fs::is_directory(*found, error)) fail(path, "a file", "a folder", "name a file inside it");
  if (!fs::is_regular_file(*found, error))
    fail(path, "a regular file", "a device or a pipe", "save its content as a file first");
  return map_file(*found);
}

std::optional<FileContent> MemoryFiles::load(const std::string& path) {
  const auto found = files_.find(path);
  if (found == files_.end()) return std::nullopt;
  return content_of(found->first, found->second);
}

FileContent content_of(std::string path, std::string text) {
  auto owner = std::make_shared<const std::string>(std::move(text));
  const std::string_view view = *owner;
  return {std::move(path), view, std::move(owner)};
}

FileContent load_file(const std::string& path) {
  auto content = DiskFiles().load(path);
  if (!content) fail(path, "a file", "none of this name", "check the path");
  return *std::move(content);
}

std::string sha256_hex(std::string_view bytes) {
  std::array<unsigned char, 32> digest{};
  unsigned int size = 0;
  if (EVP_Digest(bytes.data(), bytes.size(), digest.data(), &size, EVP_sha256(), nullptr) != 1 || size != digest.size())
    throw std::runtime_error("SHA-256 is not available in this build of libcrypto");
  static constexpr std::string_view digits = "0123456789abcdef";
  std::string out;
  for (const unsigned char byte : digest) {
    out += digits[byte >> 4];
    out += digits[byte & 15];
  }
  return out;
}

}  // namespace wellknit
