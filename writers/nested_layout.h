// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// The source grid with the made cells in columns beyond its last I: what others call a nested hybrid grid.
#pragma once

#include <memory>

#include "writers/deck_layout.h"

namespace wellknit {

/// Throws InvalidInput as make_deck_layout() does.
std::unique_ptr<DeckLayout> make_nested_layout(const DeckLayoutInput& input);

}  // namespace wellknit
