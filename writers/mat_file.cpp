// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// Version 5 is a list of elements: a tag of 8 bytes (type, bytes that follow), then the data, padded to 8 bytes. A
/// variable is an element of type "matrix" whose data are elements: flags, dimensions, name, then the values, or the
/// matrices of its fields.

#include "writers/mat_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <span>

#include "model/errors.h"

namespace wellknit {

static_assert(std::endian::native == std::endian::little, "the arrays are written as they lie in memory");

namespace {

/// Of one variable, in bytes: the signed 32 bits of MATLAB's own reader.
constexpr std::uint64_t largest_variable = 2'147'483'647;

enum class Type : std::uint32_t { int8 = 1, uint16 = 4, int32 = 5, uint32 = 6, float64 = 9, matrix = 14 };

constexpr std::uint64_t tag_bytes = 8;
constexpr std::uint64_t longest_field = 32;  // with a zero at the end

std::uint64_t padded(std::uint64_t bytes) { return (bytes + 7) / 8 * 8; }

}  // namespace

/// Elements into a stream.
class MatSink {
 public:
  explicit MatSink(std::ostream& out) : out_(out) {}

  void tag(Type type, std::uint64_t bytes) {
    const std::array<std::uint32_t, 2> tag{static_cast<std::uint32_t>(type), static_cast<std::uint32_t>(bytes)};
    raw(tag.data(), sizeof tag);
  }
  template <class T>
  void element(Type type, std::span<const T> values) {
    tag(type, values.size_bytes());
    raw(values.data(), values.size_bytes());
    constexpr std::array<char, 8> zeros{};
    raw(zeros.data(), padded(values.size_bytes()) - values.size_bytes());
  }
  void raw(const void* data, std::uint64_t bytes) {
    out_.write(static_cast<const char*>(data), static_cast<std::streamsize>(bytes));
  }

 private:
  std::ostream& out_;
};

MatVariable MatVariable::numbers(std::size_t rows, std::size_t columns, MakeNumbers make) {
  MatVariable out;
  out.rows_ = rows;
  out.columns_ = columns;
  out.make_numbers_ = std::move(make);
  return out;
}

MatVariable MatVariable::numbers(std::vector<double> values) {
  const std::size_t rows = values.size();
  return numbers(rows, rows == 0 ? 0 : 1, [values = std::move(values)] { return values; });
}

MatVariable MatVariable::indices(std::size_t rows, std::size_t columns, MakeIndices make) {
  MatVariable out;
  out.rows_ = rows;
  out.columns_ = columns;
  out.make_indices_ = std::move(make);
  return out;
}

MatVariable MatVariable::text(const std::string& text) {
  MatVariable out;
  out.kind_ = Kind::character;
  out.rows_ = text.empty() ? 0 : 1;
  out.columns_ = text.size();
  out.text_ = text;
  return out;
}

MatVariable MatVariable::cell_row(std::vector<MatVariable> elements) {
  MatVariable out;
  out.kind_ = Kind::cell;
  out.rows_ = 1;
  out.columns_ = elements.size();
  out.children_ = std::move(elements);
  return out;
}

MatVariable MatVariable::structs(std::size_t count, std::vector<std::string> fields) {
  MatVariable out;
  out.kind_ = Kind::structure;
  out.rows_ = count;
  out.columns_ = 1;
  out.children_.resize(count * fields.size());
  out.fields_ = std::move(fields);
  return out;
}

void MatVariable::set(std::string_view field, MatVariable value, std::size_t element) {
  const auto place = std::find(fields_.begin(), fields_.end(), field) - fields_.begin();
  children_.at(element * fields_.size() + static_cast<std::size_t>(place)) = std::move(value);
}

std::uint64_t MatVariable::data_bytes() const {
  const std::uint64_t count = std::uint64_t{rows_} * columns_;
  if (kind_ == Kind::character) return count * sizeof(std::uint16_t);
  return count * (make_indices_ ? sizeof(std::int32_t) : sizeof(double));
}

/// Of what follows the matrix's own tag.
std::uint64_t MatVariable::size(std::string_view name) const {
  constexpr std::uint64_t flags = 16;
  constexpr std::uint64_t dimensions = 16;
  std::uint64_t bytes = flags + dimensions + tag_bytes + padded(name.size());
  if (kind_ == Kind::number || kind_ == Kind::character) return bytes + tag_bytes + padded(data_bytes());
  if (kind_ == Kind::structure) bytes += 2 * tag_bytes + longest_field * fields_.size();
  for (const MatVariable& child : children_) bytes += tag_bytes + child.size("");
  return bytes;
}

void MatVariable::write(MatSink& out, std::string_view name) const {
  out.tag(Type::matrix, size(name));
  const std::array<std::uint32_t, 2> flags{static_cast<std::uint32_t>(kind_), 0};
  out.element(Type::uint32, std::span<const std::uint32_t>(flags));
  const std::array<std::int32_t, 2> shape{static_cast<std::int32_t>(rows_), static_cast<std::int32_t>(columns_)};
  out.element(Type::int32, std::span<const std::int32_t>(shape));
  out.element(Type::int8, std::span<const char>(name));
  if (kind_ == Kind::number || kind_ == Kind::character) {
    write_data(out);
    return;
  }
  if (kind_ == Kind::structure) {
    // The length of a field's name is a small element: type and size share four bytes, and the value follows.
    const std::array<std::uint32_t, 2> length{(4U << 16U) | static_cast<std::uint32_t>(Type::int32),
                                              static_cast<std::uint32_t>(longest_field)};
    out.raw(length.data(), sizeof length);
    std::string names;
    for (const std::string& field : fields_) names += field + std::string(longest_field - field.size(), '\0');
    out.element(Type::int8, std::span<const char>(names));
  }
  for (const MatVariable& child : children_) child.write(out, "");
}

void MatVariable::write_data(MatSink& out) const {
  if (kind_ == Kind::character) {
    std::vector<std::uint16_t> characters;
    for (const char c : text_) characters.push_back(static_cast<unsigned char>(c));
    out.element(Type::uint16, std::span<const std::uint16_t>(characters));
  } else if (make_indices_) {
    out.element(Type::int32, std::span<const std::int32_t>(make_indices_()));
  } else if (make_numbers_) {
    out.element(Type::float64, std::span<const double>(make_numbers_()));
  } else {
    out.tag(Type::float64, 0);  // an empty one
  }
}

MatFile::MatFile(const std::string& file, std::string shown_path)
    : shown_path_(std::move(shown_path)), out_(file, std::ios::binary | std::ios::trunc) {
  if (!out_) fail("it cannot be opened");
  constexpr std::size_t head = 124;
  std::string text = "MATLAB 5.0 MAT-file, created by wellknit";  // no time: the same mesh gives the same bytes
  text.resize(head - 8, ' ');
  text.append(8, '\0');
  text += std::string("\x00\x01IM", 4);  // version 1.0, little-endian
  out_.write(text.data(), static_cast<std::streamsize>(text.size()));
}

void MatFile::write(std::string_view name, const MatVariable& variable) {
  if (variable.size(name) > largest_variable)
    fail(fmt::format(
        "a variable of MATLAB's version 5 holds at most 2 GiB and {} would hold more; choose the format hdf5", name));
  MatSink sink(out_);
  variable.write(sink, name);
}

void MatFile::close() {
  out_.close();
  if (out_.fail()) fail("not everything could be written; is the disk full?");
}

void MatFile::fail(const std::string& why) const {
  throw WriteError(fmt::format("{}: cannot be written: {}", shown_path_, why));
}

}  // namespace wellknit
