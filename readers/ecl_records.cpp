// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "readers/ecl_records.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <type_traits>

#include "readers/byte_order.h"
#include "readers/text.h"

namespace wellknit {

namespace {

constexpr std::size_t marker_size = 4;   // the length before and after every block
constexpr std::size_t header_size = 16;  // name, count, type
constexpr std::size_t name_size = 8;
constexpr std::string_view big_endian_start("\0\0\0\x10", 4);
constexpr std::string_view little_endian_start("\x10\0\0\0", 4);

bool is_space(char c) { return is_blank(c) || is_line_end(c); }

/// "C012": strings of 12 characters.
std::optional<std::size_t> width_of_long_text(std::string_view type) {
  if (type.size() != 4 || type[0] != 'C') return std::nullopt;
  const auto width = parse_integer(type.substr(1));
  if (!width || *width < 1 || *width > 999) return std::nullopt;
  return static_cast<std::size_t>(*width);
}

/// True for a value that fits into T without loss of its meaning.
template <class T>
bool fits(double value) {
  if constexpr (std::is_same_v<T, double>)
    return std::isfinite(value);
  else
    return value == std::trunc(value) && std::abs(value) <= std::numeric_limits<std::int32_t>::max();
}

/// A name for lookups and messages, without what no name holds.
std::string plain_name(std::string_view bytes) {
  std::string out(trimmed(bytes));
  std::replace_if(
      out.begin(), out.end(), [](char c) { return c < ' ' || c > '~'; }, '?');
  return out;
}

std::string_view kind_of(double) { return "finite numbers"; }
std::string_view kind_of(std::int32_t) { return "integers"; }

}  // namespace

bool begins_with_ecl_header(std::string_view bytes, std::initializer_list<std::string_view> names) {
  std::string_view name;
  if (bytes.substr(0, marker_size) == big_endian_start || bytes.substr(0, marker_size) == little_endian_start) {
    if (bytes.size() < marker_size + name_size) return false;
    name = bytes.substr(marker_size, name_size);
    // A length of 16 may begin any file: only a keyword's name makes it ours.
    if (!is_letter(name[0]) || !std::all_of(name.begin(), name.end(), [](char c) { return c >= ' ' && c <= '~'; }))
      return false;
  } else {
    // 'NAME' count 'TYPE'
    const std::string_view start = trimmed(bytes.substr(0, 64));
    const auto end = start.find('\'', 1);
    if (start.empty() || start[0] != '\'' || end == std::string_view::npos || end > name_size + 1) return false;
    name = start.substr(1, end - 1);
    const std::string_view rest = trimmed(start.substr(end + 1));
    const auto digits = rest.find_first_not_of("0123456789");
    if (digits == 0 || digits == std::string_view::npos || trimmed(rest.substr(digits)).substr(0, 1) != "'")
      return false;
  }
  return names.size() == 0 || std::find(names.begin(), names.end(), trimmed(name)) != names.end();
}

EclRecords::EclRecords(std::string_view bytes, const std::string& path) : bytes_(bytes), path_(path) {
  is_little_endian_ = bytes.substr(0, marker_size) == little_endian_start;
  is_formatted_ = !is_little_endian_ && bytes.substr(0, marker_size) != big_endian_start;
}

std::int64_t EclRecords::line_of(std::size_t offset) const {
  const std::string_view before = bytes_.substr(0, offset);
  return 1 + static_cast<std::int64_t>(std::count(before.begin(), before.end(), '\n'));
}

void EclRecords::fail_at(std::size_t offset, const std::string& keyword, ParseError::What what) const {
  if (is_formatted_) throw ParseError({path_, line_of(offset), keyword}, std::move(what));
  what.found += fmt::format(" at byte {}", offset);
  throw ParseError({path_, 0, keyword}, std::move(what));
}

void EclRecords::fail(const EclArray& array, ParseError::What what) const {
  fail_at(array.offset, array.name, std::move(what));
}

ParseError::Where EclRecords::where(const EclArray& array) const {
  return {path_, is_formatted_ ? line_of(array.offset) : 0, array.name};
}

std::int32_t EclRecords::int_at(std::size_t offset) const {
  return load_number<std::int32_t>(bytes_.data() + offset,
                                   is_little_endian_ != (std::endian::native == std::endian::little));
}

std::optional<EclArray> EclRecords::next() { return is_formatted_ ? next_formatted() : next_binary(); }

void EclRecords::set_type(EclArray& array, const std::string& type) const {
  const auto set = [&](EclType kind, std::size_t width) {
    array.type = kind;
    array.width = width;
  };
  if (type == "INTE") return set(EclType::integer, 4);
  if (type == "REAL") return set(EclType::real, 4);
  if (type == "DOUB") return set(EclType::double_real, 8);
  if (type == "LOGI") return set(EclType::logical, 4);
  if (type == "CHAR" || type == "MESS") return set(EclType::text, 8);
  if (const auto width = width_of_long_text(type)) return set(EclType::text, *width);
  fail(array, {"one of the types INTE, REAL, DOUB, LOGI, CHAR, C0nn or MESS", quoted_for_message(type),
               "the file is damaged, or of another kind"});
}

EclRecords::Header EclRecords::read_header() {
  const std::size_t left = bytes_.size() - at_;
  if (left < header_size + 2 * marker_size)
    fail_at(at_, "",
            {"the header of an array (24 bytes)", fmt::format("{} bytes before the end of the file", left),
             "the file is cut: copy it again, in binary mode"});
  const std::int32_t before = int_at(at_);
  const std::int32_t after = int_at(at_ + marker_size + header_size);
  if (before != static_cast<std::int32_t>(header_size) || after != before)
    fail_at(at_, "",
            {"the header of an array, 16 bytes long", fmt::format("one of {} and {} bytes", before, after),
             "the file is damaged: copy it again, in binary mode"});
  Header out;
  out.name = plain_name(bytes_.substr(at_ + marker_size, name_size));
  out.count = int_at(at_ + marker_size + name_size);
  out.type = std::string(bytes_.substr(at_ + marker_size + name_size + 4, 4));
  at_ += header_size + 2 * marker_size;
  return out;
}

std::optional<EclArray> EclRecords::next_binary() {
  if (at_ == bytes_.size()) return std::nullopt;
  EclArray array;
  array.offset = at_;
  Header header = read_header();
  array.name = header.name;
  std::int64_t more = 0;
  if (header.type == "X231") {
    // The count's part beyond 31 bits stands, negative, in a header of its own before the ordinary one.
    more = -header.count * (std::int64_t{1} << 31);
    header = read_header();
    if (more < 0 || header.name != array.name)
      fail(array, {"X231 and the same name again", quoted_for_message(header.name), "the file is damaged"});
  }
  set_type(array, header.type);
  array.count = header.count + more;
  const auto left = static_cast<std::int64_t>(bytes_.size() - at_);
  if (header.count < 0 || array.count > left / static_cast<std::int64_t>(array.width))
    fail(array, {fmt::format("{} values of {} bytes", array.count, array.width), fmt::format("{} bytes left", left),
                 "the file is cut or damaged: copy it again, in binary mode"});
  skip_blocks(array);
  return array;
}

/// The blocks up to the array's count: each between two equal lengths.
void EclRecords::skip_blocks(EclArray& array) {
  const std::size_t start = at_;
  std::size_t missing = static_cast<std::size_t>(array.count) * array.width;
  // Some programs write an empty block for an array without values.
  if (missing == 0 && bytes_.size() - at_ >= 2 * marker_size && int_at(at_) == 0 && int_at(at_ + marker_size) == 0)
    at_ += 2 * marker_size;
  while (missing > 0) {
    const std::size_t left = bytes_.size() - at_;
    const std::int64_t size = left < 2 * marker_size ? -1 : int_at(at_);
    if (left < 2 * marker_size || (size > 0 && static_cast<std::size_t>(size) > left - 2 * marker_size))
      fail_at(at_, array.name,
              {fmt::format("{} values", array.count),
               fmt::format("the end of the file {} values before", missing / array.width),
               "the file is cut: copy it again, in binary mode"});
    const auto length = static_cast<std::size_t>(std::max<std::int64_t>(size, 0));
    if (size <= 0 || length > missing || length % array.width != 0 ||
        int_at(at_ + marker_size + length) != static_cast<std::int32_t>(size))
      fail_at(at_, array.name,
              {fmt::format("a block of at most {} bytes between two equal lengths", missing),
               fmt::format("the length {}", size), "the file is damaged: copy it again, in binary mode"});
    at_ += length + 2 * marker_size;
    missing -= length;
  }
  array.data = bytes_.substr(start, at_ - start);
}

EclRecords::Header EclRecords::read_formatted_header() {
  static constexpr std::string_view form = "the header of an array: 'NAME' count 'TYPE'";
  const std::size_t start = at_;
  const auto fail_here = [&] {
    const auto end = bytes_.find_first_of("\r\n", start);
    fail_at(start, "",
            {std::string(form), quoted_for_message(bytes_.substr(start, end - start)),
             "the file is damaged, or of another kind"});
  };
  const auto quoted = [&](std::size_t longest) {
    const auto open = bytes_.find_first_not_of(" \t\r\n", at_);
    if (open == std::string_view::npos || bytes_[open] != '\'') fail_here();
    const auto close = bytes_.substr(0, std::min(bytes_.size(), open + longest + 2)).find('\'', open + 1);
    if (close == std::string_view::npos) fail_here();
    at_ = close + 1;
    return plain_name(bytes_.substr(open + 1, close - open - 1));
  };
  Header out;
  out.name = quoted(name_size);
  const auto first = bytes_.find_first_not_of(" \t", at_);
  const auto last = bytes_.find_first_of(" \t\r\n'", first);
  if (first == std::string_view::npos || last == std::string_view::npos) fail_here();
  const auto count = parse_integer(bytes_.substr(first, last - first));
  if (!count) fail_here();
  out.count = *count;
  at_ = last;
  out.type = quoted(4);
  return out;
}

std::optional<EclArray> EclRecords::next_formatted() {
  while (at_ < bytes_.size() && is_space(bytes_[at_])) ++at_;
  if (at_ == bytes_.size()) return std::nullopt;
  EclArray array;
  array.offset = at_;
  const Header header = read_formatted_header();
  array.name = header.name;
  array.count = header.count;
  set_type(array, header.type);
  // A value takes a character and a blank at least.
  const auto left = static_cast<std::int64_t>(bytes_.size() - at_);
  if (array.count < 0 || array.count > left / 2)
    fail(array, {fmt::format("{} values", array.count), fmt::format("{} characters left", left),
                 "the file is cut or damaged: copy it again"});
  if (array.type == EclType::text) {
    skip_strings(array);
  } else {
    const std::size_t end = std::min(bytes_.find('\'', at_), bytes_.size());
    array.data = bytes_.substr(at_, end - at_);
    at_ = end;
  }
  return array;
}

void EclRecords::skip_strings(EclArray& array) {
  const std::size_t start = at_;
  for (std::int64_t n = 0; n < array.count; ++n) {
    const auto open = bytes_.find_first_not_of(" \t\r\n", at_);
    // Texts are padded to their width and may hold quotes themselves.
    auto close = open == std::string_view::npos ? open : open + array.width + 1;
    if (close < bytes_.size() && bytes_[close] != '\'') close = bytes_.find('\'', open + 1);
    if (close >= bytes_.size() || bytes_[open] != '\'')
      fail_at(std::min(at_, bytes_.size()), array.name,
              {fmt::format("{} texts in quotes", array.count), fmt::format("{}", n), "the file is cut or damaged"});
    at_ = close + 1;
  }
  array.data = bytes_.substr(start, at_ - start);
}

void EclRecords::require_count(const EclArray& array, std::int64_t count) const {
  if (array.count != count)
    fail(array, {fmt::format("{} values", count), fmt::format("{}", array.count),
                 "the file is damaged, or its dimensions are those of another grid"});
}

void EclRecords::require_at_least(const EclArray& array, std::int64_t count) const {
  if (array.count < count)
    fail(array, {fmt::format("{} values or more", count), fmt::format("{}", array.count), "the file is damaged"});
}

template <class Raw, class T>
void EclRecords::append_raw(const EclArray& array, std::vector<T>& out) const {
  const bool swapped = is_little_endian_ != (std::endian::native == std::endian::little);
  out.resize(static_cast<std::size_t>(array.count));
  T* to = out.data();
  const char* at = array.data.data();
  for (std::int64_t left = array.count; left > 0;) {
    const auto count = static_cast<std::size_t>(load_number<std::int32_t>(at, swapped)) / sizeof(Raw);
    at += marker_size;
    load_numbers<Raw>(at, count, swapped, to);
    at += count * sizeof(Raw) + marker_size;
    to += count;
    left -= static_cast<std::int64_t>(count);
  }
}

template <class T>
void EclRecords::append_parsed(const EclArray& array, std::vector<T>& out) const {
  out.reserve(static_cast<std::size_t>(array.count));
  const std::string_view text = array.data;
  std::size_t at = 0;
  while (true) {
    while (at < text.size() && is_space(text[at])) ++at;
    if (at == text.size()) break;
    std::size_t end = at;
    while (end < text.size() && !is_space(text[end])) ++end;
    const auto offset = static_cast<std::size_t>(text.data() - bytes_.data()) + at;
    if (static_cast<std::int64_t>(out.size()) == array.count)
      fail_at(offset, array.name, {fmt::format("{} values", array.count), "more", "the file is damaged"});
    const auto value = parse_real(text.substr(at, end - at));
    if (!value || !fits<T>(*value))
      fail_at(offset, array.name,
              {std::string(kind_of(T{})), quoted_for_message(text.substr(at, end - at)), "the file is damaged"});
    out.push_back(static_cast<T>(*value));
    at = end;
  }
  if (static_cast<std::int64_t>(out.size()) < array.count)
    fail(array, {fmt::format("{} values", array.count), fmt::format("{}", out.size()), "the file is cut or damaged"});
}

template <class T>
std::vector<T> EclRecords::numbers(const EclArray& array) const {
  std::vector<T> out;
  if (array.type != EclType::integer && array.type != EclType::real && array.type != EclType::double_real)
    fail(array, {"numbers (INTE, REAL or DOUB)", "another type", "the file is damaged, or of another kind"});
  if (is_formatted_) {
    append_parsed(array, out);
    return out;
  }
  if (array.type == EclType::integer) {
    append_raw<std::int32_t>(array, out);
    return out;
  }
  if constexpr (std::is_same_v<T, double>) {
    if (array.type == EclType::real)
      append_raw<float>(array, out);
    else
      append_raw<double>(array, out);
    if (!std::all_of(out.begin(), out.end(), fits<double>))
      fail(array, {"finite numbers", "one that is not finite", "the file is damaged, or its writer failed"});
    return out;
  } else {
    const std::vector<double> values = numbers<double>(array);
    if (!std::all_of(values.begin(), values.end(), fits<std::int32_t>))
      fail(array, {"integers", "a number with a fraction", ""});
    return {values.begin(), values.end()};
  }
}

std::vector<double> EclRecords::reals(const EclArray& array) const { return numbers<double>(array); }
std::vector<std::int32_t> EclRecords::integers(const EclArray& array) const { return numbers<std::int32_t>(array); }

std::vector<std::string> EclRecords::strings(const EclArray& array) const {
  if (array.type != EclType::text) fail(array, {"texts (CHAR)", "numbers", "the file is damaged, or of another kind"});
  std::vector<std::string> out;
  std::size_t at = 0;
  std::size_t block_end = 0;
  for (std::int64_t n = 0; n < array.count; ++n) {
    if (is_formatted_) {
      const auto open = array.data.find('\'', at);
      auto close = open + array.width + 1;
      if (close >= array.data.size() || array.data[close] != '\'') close = array.data.find('\'', open + 1);
      out.emplace_back(trimmed(array.data.substr(open + 1, close - open - 1)));
      at = close + 1;
      continue;
    }
    if (at == block_end) {
      if (n > 0) at += marker_size;
      const auto offset = static_cast<std::size_t>(array.data.data() - bytes_.data()) + at;
      at += marker_size;
      block_end = at + static_cast<std::size_t>(int_at(offset));
    }
    out.emplace_back(trimmed(array.data.substr(at, array.width)));
    at += array.width;
  }
  return out;
}

}  // namespace wellknit
