// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// The arrays with one value a cell while a deck is read: boxes, defaults, and the operations on them.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <map>
#include <string>
#include <vector>

#include "model/corner_point_grid.h"
#include "model/errors.h"
#include "readers/deck_keywords.h"
#include "readers/deck_stream.h"

namespace wellknit {

/// A value that no keyword has given. Neither can be read from a file.
inline constexpr double unset_real = std::numeric_limits<double>::quiet_NaN();
inline constexpr std::int32_t unset_integer = std::numeric_limits<std::int32_t>::min();

/// Cells from first to last along i, j, k, both inside, 0-based.
struct CellBox {
  std::array<std::int64_t, 3> first{};
  std::array<std::int64_t, 3> last{};

  [[nodiscard]] std::int64_t cell_count() const {
    return (last[0] - first[0] + 1) * (last[1] - first[1] + 1) * (last[2] - first[2] + 1);
  }
};

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

  void read_box();
  void end_box();
  /// The array of the current keyword.
  void read_array(const CellArrayRule& rule);
  /// The records of EQUALS, COPY, ADD, MULTIPLY, MINVALUE or MAXVALUE: the current keyword.
  void read_operation();

  /// Values in full length from a keyword that boxes do not concern. Throws ParseError at a wrong count.
  std::vector<double> read_reals(std::int64_t count);

  std::map<std::string, CellArray> arrays;

 private:
  CellBox read_box_items(const DeckRecord& record, std::size_t first_item, CellBox box) const;
  CellArray* find_or_make(const std::string& name, std::int64_t line);
  void note_unknown(const std::string& name, std::int64_t line);
  void operate(const std::string& name, const DeckRecord& record, const CellBox& box);
  void copy(const std::string& from, const DeckRecord& record, const CellBox& box);
  [[nodiscard]] ParseError::Where here() const;

  DeckStream& stream_;
  std::array<std::int64_t, 3> dimensions_{};
  CellBox box_;
};

}  // namespace wellknit
