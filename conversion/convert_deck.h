// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// A user's whole deck on the mesh: the main job of `wellknit build CASE.DATA --write deck=OUT.DATA`
/// (docs/formats/deck.md).
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "conversion/conversion_report.h"
#include "model/case.h"
#include "model/mesh.h"
#include "readers/whole_deck.h"

namespace wellknit {

/// What the folder beside the new deck may hold (FolderContents).
inline constexpr std::array<std::string_view, 3> deck_folder_contents{"grid.inc", "edit.inc", "files/"};

/// The folder's name beside a deck of this path: OUT.DATA has OUT_parts.
std::string deck_folder_of(const std::string& path);

/// Throws ParseError: the first thing in the deck that cannot be converted. To be asked before any work.
void refuse_what_cannot_be_converted(const WholeDeck& deck);

/// Cells around the wells of a mesh that the converted deck is to run on. What is empty stays as it is for a mesh
/// alone.
struct DeckRings {
  std::optional<int> sectors = {};
  std::optional<int> rings = {};
  std::optional<double> growth = {};  ///< ratio of successive ring widths
};

/// What the mesh for this deck has where its user says nothing. With several phases the cells at a bore must not be so
/// small that the flow replaces their pores hundreds of times a day (docs/validation_decks.md#rings). A deck of one
/// phase has no such limit: both are empty.
DeckRings rings_for(const WholeDeck& deck);

/// Opens what the deck ever completes, so that the mesh has a connection for everything that the schedule may open.
void open_all_completions(const CornerPointGrid& grid, Well& well);

struct DeckConversion {
  const WholeDeck& deck;
  const Case& source;
  const std::vector<Well>& wells;   ///< what the mesh was built with, in the mesh's order
  const std::vector<bool>& meshed;  ///< by well: it has a radial mesh
  const Mesh& mesh;
  DeckRings chosen = {};  ///< what of rings_for() made the meshes: the report says so
};

/// Where it goes. The folder exists and is empty.
struct DeckPlace {
  std::string file;         ///< the new main file
  std::string folder;       ///< what it includes
  std::string folder_name;  ///< as the new deck calls the folder, relative to itself
};

/// Writes the new deck. Throws ParseError, InvalidInput, WriteError.
ConversionReport convert_deck(const DeckConversion& conversion, const DeckPlace& place);

}  // namespace wellknit
