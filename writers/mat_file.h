// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// MATLAB files of version 5. Arrays are made when they are written, one after the other: a struct of the whole mesh
/// takes no more memory than its largest array (docs/decisions/0005-matlab-files.md).
#pragma once

#include <cstddef>
#include <cstdint>
#include <fstream>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace wellknit {

class MatSink;

/// A variable of a MAT file: an array, or a struct or cell array of variables.
class MatVariable {
 public:
  using MakeNumbers = std::function<std::vector<double>()>;
  using MakeIndices = std::function<std::vector<std::int32_t>()>;

  /// rows x columns numbers; what `make` gives stands column by column, as MATLAB has it.
  static MatVariable numbers(std::size_t rows, std::size_t columns, MakeNumbers make);
  static MatVariable numbers(std::vector<double> values);
  static MatVariable number(double value) { return numbers(std::vector<double>{value}); }
  /// The same as whole numbers: doubles in MATLAB, 32 bits in the file.
  static MatVariable indices(std::size_t rows, std::size_t columns, MakeIndices make);
  /// A row of bytes as characters.
  static MatVariable text(const std::string& text);
  static MatVariable cell_row(std::vector<MatVariable> elements);
  /// `count` x 1 structs with these fields, of at most 31 characters; every field of every struct must be set before
  /// it is written.
  static MatVariable structs(std::size_t count, std::vector<std::string> fields);

  void set(std::string_view field, MatVariable value, std::size_t element = 0);

 private:
  friend class MatFile;
  enum class Kind : std::uint8_t { cell = 1, structure = 2, character = 4, number = 6 };  ///< MATLAB's classes

  [[nodiscard]] std::uint64_t data_bytes() const;
  [[nodiscard]] std::uint64_t size(std::string_view name) const;
  void write(MatSink& out, std::string_view name) const;
  void write_data(MatSink& out) const;

  Kind kind_ = Kind::number;
  std::size_t rows_ = 0;
  std::size_t columns_ = 0;
  MakeNumbers make_numbers_;
  MakeIndices make_indices_;
  std::string text_;
  std::vector<std::string> fields_;
  std::vector<MatVariable> children_;  ///< struct by struct, field by field
};

/// A file under construction. Throws WriteError.
class MatFile {
 public:
  /// `file` is where it goes; `shown_path` stands in messages.
  MatFile(const std::string& file, std::string shown_path);
  void write(std::string_view name, const MatVariable& variable);
  void close();

 private:
  [[noreturn]] void fail(const std::string& why) const;

  std::string shown_path_;
  std::ofstream out_;
};

}  // namespace wellknit
