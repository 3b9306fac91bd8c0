// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "writers/foam_file.h"

#include <filesystem>

namespace wellknit {

FoamFile::FoamFile(const std::string& folder, const std::string& name, std::string_view foam_class,
                   std::string shown_path, std::string_view note)
    : TextFile(folder + "/" + name, std::move(shown_path)) {
  const std::filesystem::path path(name);
  print("FoamFile\n{{\n    version     2.0;\n    format      ascii;\n    class       {};\n", foam_class);
  if (!note.empty()) print("    note        \"{}\";\n", note);
  print("    location    \"{}\";\n    object      {};\n}}\n\n", path.parent_path().generic_string(),
        path.filename().string());
}

}  // namespace wellknit
