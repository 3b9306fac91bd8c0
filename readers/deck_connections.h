// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// The keywords of a deck that concern connections and pore volumes: FAULTS, MULTFLT, MULTREGT, MULTREGP, NNC, EDITNNC,
/// EDITNNCR, PINCH, PINCHOUT, MINPV, MINPORV, NEWTRAN, OLDTRAN, OLDTRANR.
#pragma once

#include <cstdint>
#include <string>
#include <unordered_map>
#include <vector>

#include "model/connection_edits.h"
#include "readers/cell_arrays.h"
#include "readers/deck_stream.h"

namespace wellknit {

class DeckConnections {
 public:
  DeckConnections(DeckStream& stream, CellArrays& arrays) : stream_(stream), arrays_(arrays) {}

  /// The records of the current keyword. Throws ParseError.
  void read();

  /// Everything, in SI; takes the multipliers and the edits out of the arrays. Throws ParseError where the deck asks
  /// for OLDTRAN or OLDTRANR: no formula of theirs is published that could be checked.
  ConnectionEdits finish(UnitSystem units);

 private:
  /// A record of MULTFLT; which faults it means is known when all are read.
  struct FaultMultiplier {
    std::string pattern;
    double multiplier = 1.0;
    bool in_edit = false;
    ParseError::Where where;
  };

  void read_faults();
  void read_fault_multipliers();
  void read_region_multipliers();
  void read_region_pore_volumes();
  void read_pairs(std::vector<CellPairValue>& pairs, double default_value);
  void read_pinch();
  void ask_for(TransmissibilityMethod method);
  void refuse_block_centred_method() const;
  void read_least_pore_volume();

  Fault& fault_named(const std::string& name, std::int64_t line);
  [[nodiscard]] HostCellId read_cell(const DeckRecord& record, std::size_t first_item) const;
  [[nodiscard]] RegionSet read_region_set(const DeckRecord& record, std::size_t item, RegionSet fallback) const;
  [[nodiscard]] std::optional<std::int32_t> read_region(const DeckRecord& record, std::size_t item) const;
  [[nodiscard]] double read_multiplier(const DeckRecord& record, std::size_t item) const;
  [[nodiscard]] std::size_t read_option(const DeckRecord& record, std::size_t item,
                                        const std::vector<std::string>& options, std::size_t fallback) const;
  void apply_fault_multipliers();
  void take_arrays();
  std::vector<double> take_array(const std::string& name, double unset_value);

  DeckStream& stream_;
  CellArrays& arrays_;
  ConnectionEdits edits_;  ///< in the deck's units
  std::unordered_map<std::string, std::size_t> fault_of_name_;
  std::vector<FaultMultiplier> fault_multipliers_;
  ParseError::Where method_where_;  ///< of the last of NEWTRAN, OLDTRAN, OLDTRANR
};

}  // namespace wellknit
