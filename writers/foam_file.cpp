// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "writers/foam_file.h"

#include <filesystem>

#include "model/errors.h"

namespace wellknit {

FoamFile::FoamFile(const std::string& folder, const std::string& name, std::string_view foam_class,
                   std::string shown_path, std::string_view note)
    : shown_path_(std::move(shown_path)), out_(folder + "/" + name, std::ios::binary | std::ios::trunc) {
  if (!out_) throw WriteError(fmt::format("{}: cannot be written: {} cannot be opened", shown_path_, name));
  const std::filesystem::path path(name);
  print("FoamFile\n{{\n    version     2.0;\n    format      ascii;\n    class       {};\n", foam_class);
  if (!note.empty()) print("    note        \"{}\";\n", note);
  print("    location    \"{}\";\n    object      {};\n}}\n\n", path.parent_path().generic_string(),
        path.filename().string());
}

void FoamFile::flush() {
  out_.write(buffer_.data(), static_cast<std::streamsize>(buffer_.size()));
  buffer_.clear();
}

void FoamFile::close() {
  flush();
  out_.close();
  if (out_.fail())
    throw WriteError(
        fmt::format("{}: cannot be written: not everything could be written; is the disk full?", shown_path_));
}

}  // namespace wellknit
