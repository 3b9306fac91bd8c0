// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "writers/connection_notes.h"

#include <fmt/format.h>

#include <algorithm>

namespace wellknit {

std::vector<std::string> notes_of_geometry(const Mesh& mesh, std::string_view faces, std::string_view whole) {
  const auto& c = mesh.connections;
  const auto bare = std::count_if(c.face.begin(), c.face.end(), [](FaceId face) { return !face.is_valid(); });
  const auto multiplied = std::count_if(c.multiplier.begin(), c.multiplier.end(), [](double m) { return m != 1.0; });
  std::vector<std::string> notes;
  if (bare > 0)
    notes.push_back(fmt::format("{} connections without a face (NNC, pinch-outs) are not in {}", bare, faces));
  if (multiplied > 0) notes.push_back(fmt::format("multipliers of {} connections are not in {}", multiplied, whole));
  return notes;
}

}  // namespace wellknit
