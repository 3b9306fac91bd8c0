// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "writers/text_file.h"

#include <filesystem>

#include "model/errors.h"

namespace wellknit {

TextFile::TextFile(const std::string& file, std::string shown_path)
    : shown_path_(std::move(shown_path)), out_(file, std::ios::binary | std::ios::trunc) {
  if (!out_)
    throw WriteError(fmt::format("{}: cannot be written: {} cannot be opened", shown_path_,
                                 std::filesystem::path(file).filename().string()));
}

void TextFile::flush() {
  out_.write(buffer_.data(), static_cast<std::streamsize>(buffer_.size()));
  buffer_.clear();
}

void TextFile::close() {
  flush();
  out_.close();
  if (out_.fail())
    throw WriteError(
        fmt::format("{}: cannot be written: not everything could be written; is the disk full?", shown_path_));
}

}  // namespace wellknit
