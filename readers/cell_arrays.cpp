// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "readers/cell_arrays.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <type_traits>

#include "readers/text.h"

namespace wellknit {

namespace {

template <class T>
constexpr T unset() {
  if constexpr (std::is_same_v<T, double>)
    return unset_real;
  else
    return unset_integer;
}

bool is_unset(double value) { return std::isnan(value); }
bool is_unset(std::int32_t value) { return value == unset_integer; }

std::optional<double> parse(std::string_view text, double) { return parse_real(text); }
std::optional<std::int32_t> parse(std::string_view text, std::int32_t) {
  const auto value = parse_integer(text);
  if (!value || *value <= unset_integer || *value > std::numeric_limits<std::int32_t>::max()) return std::nullopt;
  return static_cast<std::int32_t>(*value);
}

constexpr std::string_view name_of_kind(double) { return "a number"; }
constexpr std::string_view name_of_kind(std::int32_t) { return "an integer"; }

struct ValueCount {
  std::int64_t least = 0;
  std::int64_t most = 0;
};

[[noreturn]] void fail_too_many(const DeckStream& stream, ValueCount count) {
  stream.fail(stream.line(), {fmt::format("{} values", count.most), "more before the '/'",
                              "check the dimensions, the BOX and the repeat counts"});
}

/// All values up to '/'; defaults are unset.
template <class T>
std::vector<T> read_values(DeckStream& stream, ValueCount count) {
  stream.charge_values(count.most);
  std::vector<T> values = stream.plain_array<T>(count.most, unset<T>()).value_or(std::vector<T>());
  while (const auto token = stream.next_value()) {
    T value = unset<T>();
    if (!token->value.empty()) {
      const auto parsed = parse(token->value, T{});
      if (!parsed) stream.fail(stream.line(), {std::string(name_of_kind(T{})), quoted_for_message(token->value), ""});
      value = *parsed;
    }
    if (token->count > count.most - static_cast<std::int64_t>(values.size())) fail_too_many(stream, count);
    if (token->count == 1)
      values.push_back(value);
    else
      values.insert(values.end(), static_cast<std::size_t>(token->count), value);
  }
  if (static_cast<std::int64_t>(values.size()) < count.least) {
    stream.fail(stream.line(), {fmt::format("{} values", count.least), fmt::format("{} before the '/'", values.size()),
                                "check the dimensions, the BOX and the repeat counts"});
  }
  return values;
}

template <class Visit>
void for_each_cell(const CellBox& box, const std::array<std::int64_t, 3>& dimensions, Visit visit) {
  for (std::int64_t k = box.first[2]; k <= box.last[2]; ++k) {
    for (std::int64_t j = box.first[1]; j <= box.last[1]; ++j) {
      const std::int64_t row = dimensions[0] * (j + dimensions[1] * k);
      for (std::int64_t i = box.first[0]; i <= box.last[0]; ++i) visit(static_cast<std::size_t>(row + i));
    }
  }
}

template <class T>
void read_into(DeckStream& stream, CellArray& array, const CellBox& box, ValueCount count,
               const std::array<std::int64_t, 3>& dimensions) {
  std::vector<T> values = read_values<T>(stream, count);
  auto& target = std::get<std::vector<T>>(array.values);
  const auto whole = static_cast<std::size_t>(dimensions[0] * dimensions[1] * dimensions[2]);
  if (target.empty() && values.size() == whole) {
    target = std::move(values);
    return;
  }
  if (target.empty()) {
    stream.charge_values(static_cast<std::int64_t>(whole));
    target.assign(whole, unset<T>());
  }
  std::size_t at = 0;
  for_each_cell(box, dimensions, [&](std::size_t cell) {
    if (at < values.size() && !is_unset(values[at])) target[cell] = values[at];
    ++at;
  });
}

}  // namespace

void CellArrays::set_dimensions(const std::array<std::int64_t, 3>& dimensions) {
  dimensions_ = dimensions;
  end_box();
}

void CellArrays::require_dimensions() const {
  if (has_dimensions()) return;
  stream_.fail(stream_.keyword().line,
               {"SPECGRID or DIMENS before it", "none", "read the file that holds the dimensions first"});
}

ParseError::Where CellArrays::here() const {
  return {stream_.keyword().file, stream_.keyword().line, stream_.keyword().name};
}

void CellArrays::read_box() {
  require_dimensions();
  end_box();
  const DeckRecord record = stream_.next_record(6);
  box_ = read_box_items(record, 0, box_);
}

void CellArrays::end_box() {
  box_.first = {0, 0, 0};
  box_.last = {dimensions_[0] - 1, dimensions_[1] - 1, dimensions_[2] - 1};
}

CellBox CellArrays::read_box_items(const DeckRecord& record, std::size_t first_item, CellBox box) const {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto first = stream_.integer(record, first_item + 2 * axis);
    const auto last = stream_.integer(record, first_item + 2 * axis + 1);
    if (first) box.first[axis] = *first - 1;
    if (last) box.last[axis] = *last - 1;
    if (box.first[axis] < 0 || box.last[axis] < box.first[axis] || box.last[axis] >= dimensions_[axis]) {
      stream_.fail(record.line, {fmt::format("a box within 1 and {} along {}", dimensions_[axis], "IJK"[axis]),
                                 first || last ? fmt::format("{} to {}", first.value_or(box.first[axis] + 1),
                                                             last.value_or(box.last[axis] + 1))
                                               : "none",
                                 ""});
    }
  }
  return box;
}

void CellArrays::read_array(const CellArrayRule& rule) {
  require_dimensions();
  const CellBox box = box_;
  const std::int64_t count = box.cell_count();
  const std::int64_t layer = count / (box.last[2] - box.first[2] + 1);
  const bool is_real = rule.kind == CellArrayKind::real;
  CellArray fresh;  // its values may come as they are read
  if (!is_real) fresh.values = std::vector<std::int32_t>();
  CellArray& array = arrays.try_emplace(stored_name(stream_.keyword().name), std::move(fresh)).first->second;
  array.last_set = here();
  const ValueCount values{rule.only_top_layer ? layer : count, count};
  if (is_real)
    read_into<double>(stream_, array, box, values, dimensions_);
  else
    read_into<std::int32_t>(stream_, array, box, values, dimensions_);
}

std::vector<double> CellArrays::read_reals(std::int64_t count) {
  std::vector<double> values = read_values<double>(stream_, {count, count});
  if (std::any_of(values.begin(), values.end(), [](double v) { return is_unset(v); })) {
    stream_.fail(stream_.keyword().line,
                 {"a number for every value", "a default (n*)", "this keyword has no defaults: write the numbers"});
  }
  return values;
}

/// The array, made where it has a rule; nothing for a name that is no array we carry.
CellArray* CellArrays::find_or_make(const std::string& name, std::int64_t line) {
  const std::string stored = stored_name(name);
  if (const auto found = arrays.find(stored); found != arrays.end()) return &found->second;
  const CellArrayRule* rule = find_cell_array(name);
  if (rule == nullptr) {
    note_unknown(name, line);
    return nullptr;
  }
  stream_.charge_values(cell_count());
  const auto size = static_cast<std::size_t>(cell_count());
  CellArray array;
  if (rule->kind == CellArrayKind::real)
    array.values = std::vector<double>(size, unset_real);
  else
    array.values = std::vector<std::int32_t>(size, unset_integer);
  return &arrays.emplace(stored, std::move(array)).first->second;
}

std::string CellArrays::stored_name(const std::string& name) const {
  return section_ == DeckSection::edit && is_multiplier_array(name) ? edit_name(name) : name;
}

void CellArrays::begin_section(DeckSection section) {
  section_ = section;
  std::erase_if(arrays, [](const auto& entry) { return is_work_array(entry.first); });
  end_box();
}

void CellArrays::read_computed_array() {
  require_dimensions();
  ArrayEdit edit;
  edit.array = *find_computed_array(stream_.keyword().name);
  edit.cells = box_;
  const std::int64_t count = box_.cell_count();
  edit.values = read_values<double>(stream_, {count, count});
  edits.push_back(std::move(edit));
}

}  // namespace wellknit
