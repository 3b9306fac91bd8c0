// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "readers/number_array.h"

#include <oneapi/tbb/parallel_pipeline.h>
#include <oneapi/tbb/task_arena.h>
#include <sys/mman.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <charconv>
#include <limits>
#include <memory>
#include <span>

#include "readers/text.h"

#ifdef __SSE2__
#include <emmintrin.h>
#endif

namespace wellknit {

namespace {

/// Text of one piece of work, and the most values it may expand to: both stay in the second-level cache.
constexpr std::size_t piece_bytes = std::size_t{1} << 18;
constexpr std::size_t most_piece_values = std::size_t{1} << 20;

/// Powers of ten; a double holds each of them exactly.
constexpr auto exact_powers = [] {
  std::array<double, 16> powers{};
  double power = 1.0;
  for (double& entry : powers) {
    entry = power;
    power *= 10.0;
  }
  return powers;
}();
constexpr bool ends_number(char c) { return is_blank(c) || is_line_end(c) || c == '/'; }

/// A number within 16 characters, and its end; the end is null where the characters are no such number. The 16
/// characters at `at` and the 16 before the number's end must be in the text.
struct ShortNumber {
  const char* end = nullptr;
  std::uint64_t mantissa = 0;
  std::size_t fraction_digits = 0;
  bool has_point = false;
};

#ifdef __SSE2__
/// 16 bytes of ones between zeros: loaded from 16 + n they are ones from byte 0 up to byte 15 - n, from 16 - n zeros
/// below byte n.
alignas(64) constexpr auto ones_between_zeros = [] {
  std::array<std::int8_t, 48> bytes{};
  for (std::size_t n = 16; n < 32; ++n) bytes[n] = -1;
  return bytes;
}();

inline __m128i load(const void* at) { return _mm_loadu_si128(static_cast<const __m128i*>(at)); }

/// Ones in the last n bytes, 0 <= n <= 16.
inline __m128i last_bytes(std::size_t n) { return load(ones_between_zeros.data() + n); }

/// 16 digits, most significant first, as values 0 to 9.
inline std::uint64_t join_digits(__m128i digits) {
  const __m128i tens = _mm_mullo_epi16(_mm_and_si128(digits, _mm_set1_epi16(0xFF)), _mm_set1_epi16(10));
  const __m128i pairs = _mm_add_epi16(tens, _mm_srli_epi16(digits, 8));
  const __m128i quads = _mm_madd_epi16(pairs, _mm_set1_epi32(100 | (1 << 16)));
  const __m128i packed = _mm_packs_epi32(quads, quads);
  const __m128i halves = _mm_madd_epi16(packed, _mm_set1_epi32(10000 | (1 << 16)));
  const auto both = static_cast<std::uint64_t>(_mm_cvtsi128_si64(halves));
  return (both & 0xFFFFFFFF) * 100000000 + (both >> 32);
}

inline ShortNumber read_short(const char* at) {
  const __m128i digits = _mm_sub_epi8(load(at), _mm_set1_epi8('0'));
  const __m128i is_digit = _mm_cmpeq_epi8(_mm_min_epu8(digits, _mm_set1_epi8(9)), digits);
  const unsigned others = ~static_cast<unsigned>(_mm_movemask_epi8(is_digit));
  const auto first = static_cast<std::size_t>(std::countr_zero(others));
  ShortNumber out;
  std::size_t length = first;
  if (first >= 16) return out;
  out.has_point = at[first] == '.';
  if (out.has_point) {
    length = static_cast<std::size_t>(std::countr_zero(others & (others - 1)));
    out.fraction_digits = length - first - 1;
  }
  const std::size_t digit_count = length - (out.has_point ? 1 : 0);
  if (length >= 16 || digit_count == 0) return out;
  // The number moved to the end of the register, and the digits before the point moved one further over the point.
  const __m128i moved = _mm_sub_epi8(load(at + length - 16), _mm_set1_epi8('0'));
  const __m128i fraction = last_bytes(out.has_point ? out.fraction_digits : 16);
  const __m128i joined =
      _mm_or_si128(_mm_and_si128(fraction, moved), _mm_andnot_si128(fraction, _mm_slli_si128(moved, 1)));
  out.mantissa = join_digits(_mm_and_si128(joined, last_bytes(digit_count)));
  out.end = at + length;
  return out;
}
#else
inline ShortNumber read_short(const char*) { return {}; }
#endif

/// One piece of an array. It ends with a line, or with the file.
template <class T>
class PieceReader {
 public:
  PieceReader(std::string_view text, T unset) : text_(text), at_(text.data()), end_(at_ + text.size()), unset_(unset) {}

  struct Result {
    std::size_t values = 0;
    std::size_t length = 0;  ///< of the text read
    bool has_ended = false;  ///< a '/' was met; it is part of the length
  };

  /// Writes the values to `room`. Nothing when there are more or something is not plain.
  std::optional<Result> read(std::span<T> room) {
    T* out = room.data();
    limit_ = out + room.size();
    const auto result = [&](bool has_ended) {
      return Result{static_cast<std::size_t>(out - room.data()), static_cast<std::size_t>(at_ - text_.data()),
                    has_ended};
    };
    while (true) {
      while (at_ < end_ && (is_blank(*at_) || is_line_end(*at_))) ++at_;
      if (at_ == end_) return result(false);
      if (*at_ == '/') {
        ++at_;
        return result(true);
      }
      if (*at_ == '-' && at_ + 1 < end_ && at_[1] == '-') {
        skip_comment();
      } else if (out = read_entry(out); out == nullptr) {
        return std::nullopt;
      }
    }
  }

 private:
  void skip_comment() {
    while (at_ < end_ && !is_line_end(*at_)) ++at_;
  }

  /// Where the next value goes; null when something is not plain.
  T* read_entry(T* out) {
    const bool is_negative = *at_ == '-';
    const char* const digits = at_ + (is_negative ? 1 : 0);
    static constexpr std::ptrdiff_t width = 16;
    if (end_ - digits >= width && at_ - text_.data() >= width) [[likely]] {
      const ShortNumber number = read_short(digits);
      if (number.end != nullptr && ends_number(*number.end) && out != limit_ && store(number, is_negative, *out)) {
        at_ = number.end;
        return out + 1;
      }
    }
    return read_token(out);
  }

  /// Mantissa and power of ten are exact, so one division rounds once.
  static bool store(const ShortNumber& number, bool is_negative, double& value) {
    const double magnitude = static_cast<double>(number.mantissa) / exact_powers[number.fraction_digits];
    value = is_negative ? -magnitude : magnitude;
    return true;
  }
  static bool store(const ShortNumber& number, bool is_negative, std::int32_t& value) {
    const auto magnitude = static_cast<std::int64_t>(number.mantissa);
    if (number.has_point || magnitude > std::numeric_limits<std::int32_t>::max()) return false;
    value = static_cast<std::int32_t>(is_negative ? -magnitude : magnitude);
    return true;
  }

  /// Any number, n*value or n*.
  T* read_token(T* out) {
    const char* end = at_;
    while (end < end_ && !ends_number(*end)) ++end;
    if (end == end_) return nullptr;
    const std::string_view token(at_, static_cast<std::size_t>(end - at_));
    const std::size_t star = token.find('*');
    std::int64_t count = 1;
    T value = unset_;
    if (star != std::string_view::npos) {
      const auto [stop, error] = std::from_chars(token.data(), token.data() + star, count);
      if (error != std::errc() || stop != token.data() + star || count < 1) return nullptr;
    }
    const std::string_view number = token.substr(star == std::string_view::npos ? 0 : star + 1);
    if ((star == std::string_view::npos || !number.empty()) && !parse_number(number, value)) return nullptr;
    if (count > limit_ - out) return nullptr;
    at_ = end;
    return std::fill_n(out, count, value);
  }

  static bool parse_number(std::string_view token, double& value) {
    const auto parsed = parse_real(token);
    if (parsed) value = *parsed;
    return parsed.has_value();
  }
  static bool parse_number(std::string_view token, std::int32_t& value) {
    const auto parsed = parse_integer(token);
    if (!parsed || std::abs(*parsed) > std::numeric_limits<std::int32_t>::max()) return false;
    value = static_cast<std::int32_t>(*parsed);
    return true;
  }

  std::string_view text_;
  const char* at_;
  const char* end_;
  T unset_;
  T* limit_ = nullptr;
};

/// Cuts a text into pieces that end with a line.
class PieceCutter {
 public:
  explicit PieceCutter(std::string_view text) : rest_(text) {}
  std::string_view next() {
    std::size_t size = rest_.size();
    if (size > piece_bytes) {
      const std::size_t line_end = rest_.find('\n', piece_bytes - 1);
      if (line_end != std::string_view::npos) size = line_end + 1;
    }
    const std::string_view piece = rest_.substr(0, size);
    rest_.remove_prefix(size);
    return piece;
  }
  [[nodiscard]] bool at_end() const { return rest_.empty(); }

 private:
  std::string_view rest_;
};

/// Fresh memory in pages of 2 MB rather than 4 kB: far fewer faults while it is first written.
template <class T>
void ask_for_large_pages(std::vector<T>& reserved) {
  static constexpr std::uintptr_t page = std::uintptr_t{1} << 21;
  const auto begin = (reinterpret_cast<std::uintptr_t>(reserved.data()) + page - 1) / page * page;
  const auto end = reinterpret_cast<std::uintptr_t>(reserved.data() + reserved.capacity()) / page * page;
  if (end > begin) ::madvise(reinterpret_cast<void*>(begin), end - begin, MADV_HUGEPAGE);
}

template <class T>
struct Piece {
  std::string_view text;
  std::unique_ptr<T[]> values;
  std::optional<typename PieceReader<T>::Result> result;
  std::int64_t line_ends = 0;
};

/// Joins pieces in their order, up to the one in which the array ends.
template <class T>
class PieceJoiner {
 public:
  PieceJoiner(NumberArray<T>& out, std::size_t most) : out_(out), most_(most) {}

  void append(const Piece<T>& piece) {
    if (is_done_) return;
    const bool fits = piece.result && out_.values.size() + piece.result->values <= most_;
    if (fits) {
      out_.values.insert(out_.values.end(), piece.values.get(), piece.values.get() + piece.result->values);
      out_.length += piece.result->length;
      out_.line_ends += piece.line_ends;
      has_ended_ = piece.result->has_ended;
    }
    is_done_ = !fits || has_ended_;
  }
  /// What follows is of no interest. May be asked while another thread appends.
  [[nodiscard]] bool is_done() const { return is_done_; }
  [[nodiscard]] bool has_ended() const { return has_ended_; }

 private:
  NumberArray<T>& out_;
  std::size_t most_;
  std::atomic<bool> is_done_ = false;
  bool has_ended_ = false;
};

template <class T>
void read_piece(Piece<T>& piece, std::size_t room, T unset) {
  piece.result = PieceReader<T>(piece.text, unset).read({piece.values.get(), room});
  if (piece.result) piece.line_ends = count_line_ends(piece.text.substr(0, piece.result->length));
}

/// In pieces, read by all threads and joined in their order.
template <class T>
std::optional<NumberArray<T>> read_pieces(std::string_view text, std::size_t most, T unset) {
  NumberArray<T> out;
  // A value takes two bytes unless it is repeated, so a text that is too short does not make us reserve all.
  out.values.reserve(std::min(most, text.size() / 2 + 1));
  ask_for_large_pages(out.values);
  PieceCutter cutter(text);
  PieceJoiner<T> joiner(out, most);
  const std::size_t room = std::min(most, most_piece_values);
  std::vector<Piece<T>> pieces(static_cast<std::size_t>(2 * oneapi::tbb::this_task_arena::max_concurrency()));
  for (Piece<T>& piece : pieces) piece.values = std::make_unique_for_overwrite<T[]>(room);
  std::size_t next = 0;
  const auto cut = [&](oneapi::tbb::flow_control& control) -> Piece<T>* {
    if (cutter.at_end() || joiner.is_done()) {
      control.stop();
      return nullptr;
    }
    Piece<T>& piece = pieces[next++ % pieces.size()];
    piece.text = cutter.next();
    return &piece;
  };
  const auto read = [unset, room](Piece<T>* piece) {
    read_piece(*piece, room, unset);
    return piece;
  };
  const auto append = [&](Piece<T>* piece) { joiner.append(*piece); };
  using Mode = oneapi::tbb::filter_mode;
  oneapi::tbb::parallel_pipeline(pieces.size(),
                                 oneapi::tbb::make_filter<void, Piece<T>*>(Mode::serial_in_order, cut) &
                                     oneapi::tbb::make_filter<Piece<T>*, Piece<T>*>(Mode::parallel, read) &
                                     oneapi::tbb::make_filter<Piece<T>*, void>(Mode::serial_in_order, append));
  if (!joiner.has_ended()) return std::nullopt;
  return out;
}

}  // namespace

std::int64_t count_line_ends(std::string_view text) {
  if (text.empty()) return 0;
  // Blocks that a byte can count, and no branch within: sixteen characters are compared at once.
  static constexpr std::size_t block = 240;
  const std::size_t last = text.size() - 1;
  std::int64_t count = is_line_end(text[last]) ? 1 : 0;
  for (std::size_t begin = 0; begin < last; begin += block) {
    const char* const at = text.data() + begin;
    const std::size_t size = std::min(block, last - begin);
    std::uint8_t ends = 0;
    for (std::size_t n = 0; n < size; ++n) {
      const unsigned line_feed = at[n] == '\n' ? 1 : 0;
      const unsigned lone_return = (at[n] == '\r' ? 1U : 0U) & (at[n + 1] != '\n' ? 1U : 0U);
      ends = static_cast<std::uint8_t>(ends + (line_feed | lone_return));
    }
    count += ends;
  }
  return count;
}

template <class T>
std::optional<NumberArray<T>> parse_number_array(std::string_view text, std::int64_t most, T unset) {
  if (most < 0) return std::nullopt;
  const auto limit = static_cast<std::size_t>(most);
  PieceCutter cutter(text);
  Piece<T> first;
  first.text = cutter.next();
  if (first.text.substr(0, piece_bytes).find('/') == std::string_view::npos) return read_pieces(text, limit, unset);
  // A short array, as most are: no threads, and no more memory than it may fill.
  const std::size_t room = std::min(limit, most_piece_values);
  first.values = std::make_unique_for_overwrite<T[]>(room);
  read_piece(first, room, unset);
  if (!first.result) return std::nullopt;
  if (!first.result->has_ended) return read_pieces(text, limit, unset);  // the '/' stood in a comment
  return NumberArray<T>{
      {first.values.get(), first.values.get() + first.result->values}, first.result->length, first.line_ends};
}

template std::optional<NumberArray<double>> parse_number_array(std::string_view, std::int64_t, double);
template std::optional<NumberArray<std::int32_t>> parse_number_array(std::string_view, std::int64_t, std::int32_t);

}  // namespace wellknit
