// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// What a user may choose about the outputs: every writer's options in one, and the keys of
/// `--write FORMAT=PATH,key=value` that set them.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "writers/write_fehm.h"
#include "writers/write_flow_deck.h"
#include "writers/write_geos.h"
#include "writers/write_mrst.h"
#include "writers/write_opm_grid.h"
#include "writers/write_pflotran.h"
#include "writers/write_tough.h"

namespace wellknit {

/// Whom a VTU is for.
enum class VtuReader { paraview, geos };

/// Each writer looks at its own.
struct WriterOptions {
  VtuReader vtu_reader = VtuReader::paraview;
  GeosOptions geos;
  FlowDeckOptions deck;
  OpmGridOptions opm_grid;
  MrstOptions mrst;
  PflotranOptions pflotran;
  ToughOptions tough;
  FehmOptions fehm;
};

/// A choice of one format.
struct WriterKey {
  std::string_view name;
  std::string_view values;       ///< what it may be, for help and messages; the first word is the default
  std::string_view description;  ///< one line
  /// Takes a value. False: it is none of `values`.
  bool (*set)(WriterOptions& options, std::string_view value);
};

/// Of a format of the table of writers, by its name; empty where nothing is to choose.
std::span<const WriterKey> writer_keys(std::string_view format);

}  // namespace wellknit
