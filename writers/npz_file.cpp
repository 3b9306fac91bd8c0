// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "writers/npz_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cstdlib>
#include <cstring>
#include <new>

#include "model/errors.h"

namespace wellknit {

static_assert(std::endian::native == std::endian::little, "the arrays are written as they lie in memory");

namespace {

/// What a .npy file begins with: magic, version 1.0, length, and a dictionary padded to a multiple of 64 bytes.
std::string npy_head(std::string_view type, std::size_t columns, std::size_t rows) {
  std::string text = fmt::format("{{'descr': '{}', 'fortran_order': False, 'shape': ({},{}), }}", type, rows,
                                 columns == 1 ? "" : fmt::format(" {}", columns));
  constexpr std::size_t fixed = 10;
  constexpr std::size_t multiple = 64;
  text.append(multiple - 1 - (fixed + text.size()) % multiple, ' ');
  text += '\n';
  std::string head("\x93NUMPY\x01\x00", 8);
  head += static_cast<char>(text.size() & 0xFFU);
  head += static_cast<char>(text.size() >> 8U);
  return head + text;
}

}  // namespace

NpzFile::NpzFile(const std::string& file, std::string shown_path) : shown_path_(std::move(shown_path)) {
  int error = 0;
  archive_ = zip_open(file.c_str(), ZIP_CREATE | ZIP_TRUNCATE, &error);
  if (archive_ == nullptr) fail("it cannot be opened");
}

NpzFile::~NpzFile() {
  if (archive_ != nullptr) zip_discard(archive_);
}

void NpzFile::strings(const std::string& name, const std::vector<std::string>& values) {
  std::size_t length = 1;
  for (const std::string& value : values) length = std::max(length, value.size());
  std::string bytes;
  for (const std::string& value : values) bytes += value + std::string(length - value.size(), '\0');
  add(name, fmt::format("|S{}", length), 1, values.size(), bytes.data(), bytes.size());
}

void NpzFile::add(const std::string& name, std::string_view type, std::size_t columns, std::size_t rows,
                  const void* data, std::size_t bytes) {
  const std::string head = npy_head(type, columns, rows);
  // The archive frees what it has been given.
  char* const content = static_cast<char*>(std::malloc(head.size() + bytes));
  if (content == nullptr) throw std::bad_alloc();
  std::memcpy(content, head.data(), head.size());
  if (bytes > 0) std::memcpy(content + head.size(), data, bytes);
  zip_source_t* const source = zip_source_buffer(archive_, content, head.size() + bytes, 1);
  if (source == nullptr) {
    std::free(content);
    fail(name);
  }
  const zip_int64_t place = zip_file_add(archive_, (name + ".npy").c_str(), source, ZIP_FL_ENC_UTF_8);
  if (place < 0) {
    zip_source_free(source);
    fail(name);
  }
  const auto index = static_cast<zip_uint64_t>(place);
  // The earliest day that ZIP knows: 1980-01-01.
  constexpr zip_uint16_t first_day = (1U << 5U) | 1U;
  if (zip_set_file_compression(archive_, index, ZIP_CM_STORE, 0) != 0 ||
      zip_file_set_dostime(archive_, index, 0, first_day, 0) != 0)
    fail(name);
}

void NpzFile::close() {
  if (zip_close(archive_) != 0) fail(fmt::format("{}; is the disk full?", zip_strerror(archive_)));
  archive_ = nullptr;
}

void NpzFile::fail(const std::string& why) const {
  throw WriteError(fmt::format("{}: cannot be written: {}", shown_path_, why));
}

}  // namespace wellknit
