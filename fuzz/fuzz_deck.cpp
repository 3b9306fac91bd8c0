// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// A whole deck of any bytes is either taken apart into places inside its files or ends in ParseError. The line "%%"
/// ends the deck and begins the file part.inc, which it may include.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>

#include "model/errors.h"
#include "readers/whole_deck.h"

namespace {

void require(bool holds) {
  if (!holds) std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string given(reinterpret_cast<const char*>(data), size);
  const auto cut = given.find("\n%%\n");
  const std::string part = cut == std::string::npos ? "SWL\n0.1 0.2 /\n" : given.substr(cut + 4);
  // All sections, so that every input is looked at.
  const std::string text =
      "RUNSPEC\nDIMENS\n 2 1 1 /\nGRID\n" + given.substr(0, cut) + "\nEND\nPROPS\nSOLUTION\nSCHEDULE\n";
  wellknit::MemoryFiles files({{"case", text}, {"part.inc", part}});
  wellknit::DeckLimits limits;
  limits.include_count = 20;
  try {
    const auto deck = wellknit::read_whole_deck(files, "case", limits);
    require(deck.has_value());
    std::size_t main = 0;
    for (const wellknit::DeckTextPart& p : deck->parts) {
      require(p.begin <= p.end && p.end <= deck->files[p.file].content.text.size());
      if (p.file == 0) main += p.end - p.begin;
    }
    require(main == text.size());
    for (const wellknit::DeckTextKeyword& keyword : deck->keywords) {
      const std::size_t length = deck->files[keyword.file].content.text.size();
      require(keyword.begin <= keyword.end && keyword.end <= length);
      for (const wellknit::DeckTextRecord& record : keyword.records)
        require(keyword.begin <= record.begin && record.begin <= record.slash && record.slash < keyword.end);
    }
  } catch (const wellknit::ParseError& error) {
    require(std::string_view(error.what()).find('\n') == std::string_view::npos);
  }
  return 0;
}
