// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// The arrays with one value a cell while a deck is read: boxes, defaults, and the operations on them.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <string>
#include <vector>

#include "model/connection_edits.h"
#include "model/corner_point_grid.h"
#include "model/errors.h"
#include "readers/deck_keywords.h"
#include "readers/deck_stream.h"

namespace wellknit {

/// A value that no keyword has given. Neither can be read from a file.
inline constexpr double unset_real = std::numeric_limits<double>::quiet_NaN();
inline constexpr std::int32_t unset_integer = std::numeric_limits<std::int32_t>::min();
inline bool is_given(double value) { return !std::isnan(value); }
inline bool is_given(std::int32_t value) { return value != unset_integer; }

struct CellArray {
  CellProperty values;         ///< nx ny nz, some unset
  ParseError::Where last_set;  ///< the keyword that wrote to it last
};

class CellArrays {
 public:
  explicit CellArrays(DeckStream& stream) : stream_(stream) {}

  void set_dimensions(const std::array<std::int64_t, 3>& dimensions);
  [[nodiscard]] bool has_dimensions() const { return dimensions_[0] > 0; }
  [[nodiscard]] const std::array<std::int64_t, 3>& dimensions() const { return dimensions_; }
  [[nodiscard]] std::int64_t cell_count() const { return dimensions_[0] * dimensions_[1] * dimensions_[2]; }
  /// Throws ParseError at the current keyword when the dimensions are not known yet.
  void require_dimensions() const;

  /// Scratch arrays and boxes end with a section.
  void begin_section(DeckSection section);
  [[nodiscard]] DeckSection section() const { return section_; }
  /// GRIDOPTS: how many MULTNUM regions there may be. It decides which regions EQUALREG and its kin mean by default.
  void set_multiplier_regions(std::int64_t count) { multiplier_regions_ = count; }

  void read_box();
  void end_box();
  /// The array of the current keyword.
  void read_array(const CellArrayRule& rule);
  /// TRANX, TRANY, TRANZ, PORV or DEPTH: the current keyword. Kept as an edit.
  void read_computed_array();
  /// The records of EQUALS, COPY, ADD, MULTIPLY, MINVALUE, MAXVALUE, OPERATE, EQUALREG, ADDREG, MULTIREG, COPYREG or
  /// OPERATER: the current keyword.
  void read_operation();
  /// The cells from item `first_item` of a record on (I1 I2 J1 J2 K1 K2); items left out are those of `box`.
  CellBox read_box_items(const DeckRecord& record, std::size_t first_item, CellBox box) const;

  /// Values in full length from a keyword that boxes do not concern. Throws ParseError at a wrong count.
  std::vector<double> read_reals(std::int64_t count);

  /// By name; a multiplier that stands in EDIT by edit_name().
  std::map<std::string, CellArray> arrays;
  std::vector<ArrayEdit> edits;  ///< of computed arrays, in the deck's order and units

  /// Under which name `arrays` holds the multiplier that EDIT gives beside that of GRID.
  static std::string edit_name(const std::string& name) { return "EDIT " + name; }

 private:
  struct Selection;
  struct Target;
  struct Function;
  [[nodiscard]] std::string stored_name(const std::string& name) const;
  CellArray* find_or_make(const std::string& name, std::int64_t line);
  void note_unknown(const std::string& name, std::int64_t line);
  void note_partial_box(const DeckRecord& record, std::size_t first_item, const CellBox& box);
  void apply(const DeckRecord& record, const Selection& selection);
  Selection read_region(const DeckRecord& record, std::size_t item, const std::string& default_set);
  [[nodiscard]] std::string default_region_set() const;
  Target target_of(const std::string& name, std::int64_t line);
  void change(const std::string& name, const DeckRecord& record, const Selection& selection);
  void copy(const std::string& from, const DeckRecord& record, const Selection& selection);
  void operate(const DeckRecord& record, std::size_t function_item, const Selection& selection);
  void edit_computed(ComputedArray array, const DeckRecord& record, const Selection& selection);
  void require_source(const std::string& name, std::int64_t line) const;
  [[nodiscard]] ParseError::Where here() const;

  DeckStream& stream_;
  std::array<std::int64_t, 3> dimensions_{};
  CellBox box_;
  DeckSection section_ = DeckSection::bare;
  std::int64_t multiplier_regions_ = 0;
};

}  // namespace wellknit
