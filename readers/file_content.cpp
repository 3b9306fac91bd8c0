// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "readers/file_content.h"

#include <openssl/evp.h>

#include <algorithm>
#include <array>
#include <cstdio>
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

std::string read_bytes(const std::string& path) {
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rb"), &std::fclose);
  if (!file) fail(path, "a readable file", "one that cannot be opened", "check its permissions");
  std::error_code error;
  const auto size = fs::file_size(path, error);
  std::string text(error ? 0 : size, '\0');
  const std::size_t got = std::fread(text.data(), 1, text.size(), file.get());
  if (error || std::ferror(file.get()) != 0 || got != text.size())
    fail(path, "a readable file", "an error of the disk while reading it", "copy the file and try again");
  return text;
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
  return FileContent{*found, read_bytes(*found)};
}

std::optional<FileContent> MemoryFiles::load(const std::string& path) {
  const auto found = files_.find(path);
  if (found == files_.end()) return std::nullopt;
  return FileContent{found->first, found->second};
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
