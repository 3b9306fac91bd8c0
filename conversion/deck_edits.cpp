// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "conversion/deck_edits.h"

#include <algorithm>

#include "readers/text.h"

namespace wellknit {

std::size_t next_line(std::string_view text, std::size_t at) {
  while (at < text.size() && !is_line_end(text[at])) ++at;
  if (at + 1 < text.size() && text[at] == '\r' && text[at + 1] == '\n') ++at;
  return std::min(at + 1, text.size());
}

void DeckEdits::replace(std::size_t file, std::size_t begin, std::size_t end, std::string text) {
  edits_[file].push_back({begin, end, std::move(text)});
}

void DeckEdits::replace_record(const DeckTextKeyword& keyword, const DeckTextRecord& record,
                               const std::vector<std::string>& records, const std::string& why_none) {
  if (records.empty()) return replace(keyword.file, record.begin, record.slash + 1, "-- " + why_none + " ");
  std::string text;
  for (const std::string& one : records) text += (text.empty() ? "" : " /\n ") + one;
  replace(keyword.file, record.begin, record.slash, text + " ");
}

void DeckEdits::insert_below(const DeckTextKeyword& keyword, const std::string& lines) {
  const std::string_view text = deck_.files[keyword.file].content.text;
  const std::size_t at = next_line(text, keyword.end);
  const bool has_line_end = at > 0 && is_line_end(text[at - 1]);
  insert(keyword.file, at, (has_line_end ? "" : "\n") + lines);
}

std::string DeckEdits::text_of(std::size_t file) const {
  std::vector<const Edit*> sorted;
  for (const Edit& edit : edits_[file]) sorted.push_back(&edit);
  std::stable_sort(sorted.begin(), sorted.end(), [](const Edit* a, const Edit* b) { return a->begin < b->begin; });
  const std::string_view text = deck_.files[file].content.text;
  std::string out;
  std::size_t at = 0;
  for (const Edit* edit : sorted) {
    out.append(text.substr(at, edit->begin - at));
    out += edit->text;
    at = edit->end;
  }
  out.append(text.substr(at));
  return out;
}

}  // namespace wellknit
