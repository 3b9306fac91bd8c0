// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "readers/roff_tags.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <type_traits>

#include "readers/byte_order.h"
#include "readers/text.h"

namespace wellknit {

namespace {

constexpr std::string_view binary_start("roff-bin\0", 9);
constexpr std::string_view ascii_start = "roff-asc";
constexpr std::size_t longest_word = 4096;

struct TypeName {
  std::string_view name;
  RoffType type;
  std::size_t width;  ///< bytes in a binary file
};
constexpr std::array<TypeName, 6> types{{{"bool", RoffType::boolean, 1},
                                         {"byte", RoffType::byte, 1},
                                         {"char", RoffType::text, 1},
                                         {"int", RoffType::integer, 4},
                                         {"float", RoffType::real, 4},
                                         {"double", RoffType::double_real, 8}}};

const TypeName* find_type(std::string_view name) {
  const auto* found = std::find_if(types.begin(), types.end(), [&](const TypeName& t) { return t.name == name; });
  return found == types.end() ? nullptr : found;
}

std::size_t width_of(RoffType type) {
  return std::find_if(types.begin(), types.end(), [&](const TypeName& t) { return t.type == type; })->width;
}

bool is_space(char c) { return is_blank(c) || is_line_end(c); }

template <class T>
bool fits(double value) {
  if constexpr (std::is_same_v<T, double>)
    return std::isfinite(value);
  else
    return value == std::trunc(value) && std::abs(value) <= std::numeric_limits<std::int32_t>::max();
}

std::string kind_of(double) { return "finite numbers"; }
std::string kind_of(std::int32_t) { return "integers"; }

/// A name for lookups and messages, without what no name holds.
std::string plain_name(std::string_view word) {
  static constexpr std::size_t longest = 40;
  std::string out(word.substr(0, longest));
  std::replace_if(
      out.begin(), out.end(), [](char c) { return c < ' ' || c > '~'; }, '?');
  return out;
}

constexpr const char* cut_advice = "the file is cut or damaged: copy it again, in binary mode";

}  // namespace

RoffTags::RoffTags(std::string_view bytes, const std::string& path) : bytes_(bytes), path_(path) {
  is_ascii_ = bytes.substr(0, ascii_start.size()) == ascii_start;
  if (!is_ascii_ && bytes.substr(0, binary_start.size()) != binary_start)
    fail_at(0, "", {"roff-bin or roff-asc", quoted_for_message(bytes.substr(0, 8)), "is this a ROFF file?"});
  at_ = is_ascii_ ? ascii_start.size() : binary_start.size();
}

std::int64_t RoffTags::line_of(std::size_t offset) const {
  const std::string_view before = bytes_.substr(0, offset);
  return 1 + static_cast<std::int64_t>(std::count(before.begin(), before.end(), '\n'));
}

void RoffTags::fail_at(std::size_t offset, const std::string& keyword, ParseError::What what) const {
  if (is_ascii_) throw ParseError({path_, line_of(offset), keyword}, std::move(what));
  what.found += fmt::format(" at byte {}", offset);
  throw ParseError({path_, 0, keyword}, std::move(what));
}

void RoffTags::fail(const RoffKey& key, ParseError::What what) const {
  fail_at(key.offset, key.tag + "." + key.name, std::move(what));
}

ParseError::Where RoffTags::where(const RoffKey& key) const {
  return {path_, is_ascii_ ? line_of(key.offset) : 0, key.tag + "." + key.name};
}

/// The next word of the file, comments (#…#) passed over; empty at its end.
std::string_view RoffTags::word() { return is_ascii_ ? ascii_word() : binary_word(); }

std::string_view RoffTags::binary_word() {
  while (at_ < bytes_.size()) {
    const auto end = bytes_.substr(0, std::min(bytes_.size(), at_ + longest_word)).find('\0', at_);
    if (end == std::string_view::npos) fail_at(at_, tag_, {"a word that ends with a zero byte", "none", cut_advice});
    const std::string_view found = bytes_.substr(at_, end - at_);
    at_ = end + 1;
    if (found.empty() || found[0] != '#') return found;
  }
  return {};
}

std::string_view RoffTags::ascii_word() {
  while (true) {
    while (at_ < bytes_.size() && is_space(bytes_[at_])) ++at_;
    if (at_ == bytes_.size()) return {};
    const std::size_t start = at_;
    const char first = bytes_[start];
    if (first == '#' || first == '"') {
      const auto end = bytes_.substr(0, std::min(bytes_.size(), start + longest_word)).find(first, start + 1);
      if (end == std::string_view::npos)
        fail_at(start, tag_,
                {first == '#' ? "a comment that ends with #" : "a text that ends with \"", "none", cut_advice});
      at_ = end + 1;
      if (first == '"') return bytes_.substr(start + 1, end - start - 1);
      continue;
    }
    while (at_ < bytes_.size() && !is_space(bytes_[at_])) ++at_;
    return bytes_.substr(start, at_ - start);
  }
}

std::optional<RoffKey> RoffTags::next() {
  while (true) {
    const std::size_t start = at_;
    const std::string_view found = word();
    if (tag_.empty()) {
      if (found == "tag") {
        tag_ = plain_name(word());
        ++tag_number_;
        if (tag_.empty()) fail_at(start, "", {"the name of a tag", "none", cut_advice});
        continue;
      }
      if (found == "eof") return std::nullopt;
      if (found.empty())
        fail_at(start, "",
                {"a tag, or the tag eof", at_ >= bytes_.size() ? "the end of the file" : "a zero byte", cut_advice});
      fail_at(start, "", {"a tag", quoted_for_message(found), cut_advice});
    }
    if (tag_ == "eof") return std::nullopt;
    if (found != "endtag") return read_key(found);
    tag_.clear();
  }
}

std::optional<RoffKey> RoffTags::read_key(std::string_view type_name) {
  const bool is_array = type_name == "array";
  const std::size_t start = at_;
  const std::string_view name_of_type = is_array ? word() : type_name;
  const TypeName* type = find_type(name_of_type);
  if (type == nullptr)
    fail_at(start, tag_,
            {"a type (bool, byte, char, int, float, double), array or endtag",
             name_of_type.empty() ? "the end of the file" : quoted_for_message(name_of_type), cut_advice});
  RoffKey key;
  key.tag = tag_;
  key.tag_number = tag_number_;
  key.type = type->type;
  key.offset = start;
  key.name = plain_name(word());
  if (is_array) find_count(key);
  if (is_ascii_)
    find_ascii_data(key, is_array);
  else
    find_binary_data(key);
  if (key.tag == "filedata" && key.name == "byteswaptest") take_byte_order(key);
  return key;
}

void RoffTags::find_count(RoffKey& key) {
  std::optional<std::int64_t> count;
  if (is_ascii_) {
    count = parse_integer(word());
  } else {
    if (!is_swapped_)
      fail(key, {"filedata.byteswaptest before any number", "none", "the file's byte order is unknown"});
    if (bytes_.size() - at_ >= 4) {
      count = load_number<std::int32_t>(bytes_.data() + at_, *is_swapped_);
      at_ += 4;
    }
  }
  const auto left = static_cast<std::int64_t>(bytes_.size() - at_);
  if (!count || *count < 0)
    fail(key, {"a number of values, 0 or more", count ? fmt::format("{}", *count) : "none", cut_advice});
  // A value takes its bytes; in ASCII, and as a text, a character and what ends it.
  const auto width = is_ascii_ ? 2 : static_cast<std::int64_t>(width_of(key.type));
  if (*count > (left + 1) / width)
    fail(key, {fmt::format("{} values", *count), fmt::format("{} bytes left", left), cut_advice});
  key.count = *count;
}

void RoffTags::find_binary_data(RoffKey& key) {
  const std::size_t start = at_;
  if (key.type == RoffType::text) {
    for (std::int64_t n = 0; n < key.count; ++n) {
      const auto end = bytes_.find('\0', at_);
      if (end == std::string_view::npos)
        fail(key, {"texts that end with a zero byte", "the end of the file", cut_advice});
      at_ = end + 1;
    }
  } else {
    const std::size_t size = static_cast<std::size_t>(key.count) * width_of(key.type);
    if (size > bytes_.size() - at_)
      fail(key, {fmt::format("{} values", key.count), fmt::format("{} bytes left", bytes_.size() - at_), cut_advice});
    at_ += size;
  }
  key.data = bytes_.substr(start, at_ - start);
}

/// Numbers go on up to the next word that begins with a letter.
void RoffTags::find_ascii_data(RoffKey& key, bool is_array) {
  if (!is_array) {
    key.data = word();
    return;
  }
  while (at_ < bytes_.size() && is_space(bytes_[at_])) ++at_;
  const std::size_t start = at_;
  if (key.type == RoffType::text) {
    for (std::int64_t n = 0; n < key.count; ++n)
      if (word().data() == nullptr) fail(key, {fmt::format("{} texts", key.count), fmt::format("{}", n), cut_advice});
  } else {
    bool after_space = true;
    while (at_ < bytes_.size() && !(after_space && is_letter(bytes_[at_]))) after_space = is_space(bytes_[at_++]);
  }
  key.data = bytes_.substr(start, at_ - start);
}

void RoffTags::take_byte_order(const RoffKey& key) {
  if (is_ascii_) return;
  const bool swapped_here = key.type == RoffType::integer && load_number<std::int32_t>(key.data.data(), true) == 1;
  const bool plain_here = key.type == RoffType::integer && load_number<std::int32_t>(key.data.data(), false) == 1;
  if (!swapped_here && !plain_here)
    fail(key, {"the integer 1, in either byte order", "another value", "the file is damaged"});
  // Data before it are read later: they have one order.
  if (is_swapped_ && *is_swapped_ != swapped_here) fail(key, {"one byte order", "another one than before", cut_advice});
  is_swapped_ = swapped_here;
}

template <class T>
std::vector<T> RoffTags::parsed(const RoffKey& key) const {
  std::vector<T> out;
  out.reserve(static_cast<std::size_t>(key.count));
  std::size_t at = 0;
  while (true) {
    while (at < key.data.size() && is_space(key.data[at])) ++at;
    if (at == key.data.size()) break;
    std::size_t end = at;
    while (end < key.data.size() && !is_space(key.data[end])) ++end;
    const std::string_view text = key.data.substr(at, end - at);
    const auto offset = static_cast<std::size_t>(text.data() - bytes_.data());
    const std::string name = key.tag + "." + key.name;
    if (static_cast<std::int64_t>(out.size()) == key.count)
      fail_at(offset, name, {fmt::format("{} values", key.count), "more", "the file is damaged"});
    const auto value = parse_real(text);
    if (!value || !fits<T>(*value))
      fail_at(offset, name, {kind_of(T{}), quoted_for_message(text), "the file is damaged"});
    out.push_back(static_cast<T>(*value));
    at = end;
  }
  if (static_cast<std::int64_t>(out.size()) < key.count)
    fail(key, {fmt::format("{} values", key.count), fmt::format("{}", out.size()), cut_advice});
  return out;
}

template <class T>
std::vector<T> RoffTags::numbers(const RoffKey& key) const {
  if (key.type == RoffType::text) fail(key, {"numbers", "texts (char)", "the file is damaged, or of another kind"});
  if (is_ascii_) return parsed<T>(key);
  const auto count = static_cast<std::size_t>(key.count);
  std::vector<T> out(count);
  if (key.type == RoffType::boolean || key.type == RoffType::byte) {
    std::transform(key.data.begin(), key.data.end(), out.begin(),
                   [](char c) { return static_cast<T>(static_cast<unsigned char>(c)); });
    return out;
  }
  if (!is_swapped_) fail(key, {"filedata.byteswaptest before any number", "none", "the file's byte order is unknown"});
  if (key.type == RoffType::integer) {
    load_numbers<std::int32_t>(key.data.data(), count, *is_swapped_, out.data());
    return out;
  }
  if constexpr (std::is_same_v<T, double>) {
    if (key.type == RoffType::real)
      load_numbers<float>(key.data.data(), count, *is_swapped_, out.data());
    else
      load_numbers<double>(key.data.data(), count, *is_swapped_, out.data());
    if (!std::all_of(out.begin(), out.end(), fits<double>))
      fail(key, {"finite numbers", "one that is not finite", "the file is damaged, or its writer failed"});
    return out;
  } else {
    const std::vector<double> values = numbers<double>(key);
    if (!std::all_of(values.begin(), values.end(), fits<std::int32_t>))
      fail(key, {"integers", "a number with a fraction", ""});
    return {values.begin(), values.end()};
  }
}

std::vector<double> RoffTags::reals(const RoffKey& key) const { return numbers<double>(key); }
std::vector<std::int32_t> RoffTags::integers(const RoffKey& key) const { return numbers<std::int32_t>(key); }

double RoffTags::real(const RoffKey& key) const {
  require_count(key, 1);
  return reals(key)[0];
}

std::int32_t RoffTags::integer(const RoffKey& key) const {
  require_count(key, 1);
  return integers(key)[0];
}

std::string RoffTags::text(const RoffKey& key) const {
  if (key.type != RoffType::text) fail(key, {"a text (char)", "numbers", "the file is damaged, or of another kind"});
  require_count(key, 1);
  const std::string_view data = key.data;
  return std::string(unquoted(data.substr(0, data.find('\0'))));
}

void RoffTags::require_count(const RoffKey& key, std::int64_t count) const {
  if (key.count != count)
    fail(key, {fmt::format("{} values", count), fmt::format("{}", key.count),
               "the file is damaged, or its dimensions are those of another grid"});
}

}  // namespace wellknit
