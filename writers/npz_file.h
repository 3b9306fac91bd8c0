// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// numpy's .npz: a ZIP file, stored, of .npy arrays. Without times: the same arrays give the same bytes.
#pragma once

#include <zip.h>

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "model/geometry.h"

namespace wellknit {

/// A file under construction; arrays are kept until it is closed. Throws WriteError.
class NpzFile {
 public:
  /// `file` is where it goes; `shown_path` stands in messages.
  NpzFile(const std::string& file, std::string shown_path);
  ~NpzFile();
  NpzFile(const NpzFile&) = delete;
  NpzFile& operator=(const NpzFile&) = delete;

  void array(const std::string& name, std::span<const double> values) {
    add(name, "<f8", 1, values.size(), values.data(), values.size_bytes());
  }
  void array(const std::string& name, std::span<const std::int32_t> values) {
    add(name, "<i4", 1, values.size(), values.data(), values.size_bytes());
  }
  void array(const std::string& name, std::span<const Vec3> values) {
    add(name, "<f8", 3, values.size(), values.data(), values.size_bytes());
  }
  /// As numpy's byte strings, each as long as the longest.
  void strings(const std::string& name, const std::vector<std::string>& values);
  void close();

 private:
  void add(const std::string& name, std::string_view type, std::size_t columns, std::size_t rows, const void* data,
           std::size_t bytes);
  [[noreturn]] void fail(const std::string& why) const;

  std::string shown_path_;
  zip_t* archive_ = nullptr;
};

}  // namespace wellknit
