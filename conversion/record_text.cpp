// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "conversion/record_text.h"

#include <fmt/format.h>

#include "readers/text.h"

namespace wellknit {

namespace {

bool has_any(const ItemTexts& changed, std::int64_t from, std::int64_t to) {
  const auto first = changed.lower_bound(from);
  return first != changed.end() && first->first < to;
}

}  // namespace

std::string record_text(std::string_view file_text, const DeckTextRecord& record, const ItemTexts& changed) {
  std::string out;
  const auto add = [&](std::string_view text) {
    if (!out.empty()) out += ' ';
    out += text;
  };
  std::int64_t at = 0;
  for (const DeckTextItem& item : record.items) {
    if (!has_any(changed, at, at + item.count)) {
      add(file_text.substr(item.begin, item.end - item.begin));
      at += item.count;
      continue;
    }
    // A run of equal items is taken apart around the changed ones.
    for (const std::int64_t end = at + item.count; at < end;) {
      const auto next = changed.lower_bound(at);
      const std::int64_t until = next == changed.end() ? end : std::min(end, next->first);
      if (until > at)
        add(item.is_default ? fmt::format("{}*", until - at) : fmt::format("{}*{}", until - at, item.text));
      at = until;
      if (at == end) break;
      add(next->second);
      ++at;
    }
  }
  for (const auto& [item, text] : changed) {
    if (item < at) continue;
    if (item > at) add(fmt::format("{}*", item - at));
    add(text);
    at = item + 1;
  }
  return out;
}

void RecordItems::fail(ParseError::What what) const {
  throw ParseError({deck_.files[keyword_.file].content.path, record_.line, keyword_.name}, std::move(what));
}

std::optional<std::int64_t> RecordItems::integer(std::int64_t item) const {
  const DeckTextItem* found = record_.find(item);
  if (found == nullptr) return std::nullopt;
  const auto value = parse_integer(found->text);
  if (!value) fail({fmt::format("an integer as item {}", item + 1), quoted_for_message(found->text), ""});
  return value;
}

std::optional<double> RecordItems::real(std::int64_t item) const {
  const DeckTextItem* found = record_.find(item);
  if (found == nullptr) return std::nullopt;
  const auto value = parse_real(found->text);
  if (!value) fail({fmt::format("a number as item {}", item + 1), quoted_for_message(found->text), ""});
  return value;
}

std::optional<double> RecordItems::positive(std::int64_t item) const {
  const auto value = real(item);
  return value && *value > 0.0 ? value : std::nullopt;
}

std::string RecordItems::word(std::int64_t item, const char* fallback) const {
  const DeckTextItem* found = record_.find(item);
  return found == nullptr ? std::string(fallback) : upper_case(trimmed(found->text));
}

std::optional<std::int64_t> RecordItems::cell_index(std::int64_t item, std::size_t axis) const {
  const auto value = integer(item);
  if (!value || *value <= 0) return std::nullopt;
  if (*value > deck_.dimensions[axis])
    fail({fmt::format("{} between 1 and {} as item {}", "IJK"[axis], deck_.dimensions[axis], item + 1),
          fmt::format("{}", *value), "the cell is outside the grid"});
  return *value - 1;
}

}  // namespace wellknit
