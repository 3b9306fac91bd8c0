// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "readers/read_case.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>

#include "readers/deck_keywords.h"
#include "readers/deck_wells.h"
#include "readers/formats.h"
#include "readers/grid_section.h"
#include "readers/parse_case.h"
#include "readers/read_egrid.h"
#include "readers/read_grid_file.h"
#include "readers/read_init.h"
#include "readers/text.h"
#include "readers/unapplied.h"

namespace wellknit {

namespace {

/// Of a line's rest, up to its '/': 600*0.2, 1.0D+3 …
bool holds_numbers_only(std::string_view text) {
  const std::string_view record = text.substr(0, text.find('/'));
  return std::all_of(record.begin(), record.end(), [](char c) {
    return is_digit(c) || is_blank(c) || std::string_view(".+-*eEdD").find(c) != std::string_view::npos;
  });
}

class CaseReader {
 public:
  CaseReader(FileStore& files, const DeckLimits& limits)
      : files_(files), stream_(files, limits), grid_(stream_), wells_(stream_, grid_.arrays()) {}

  /// The format, where it has a reader of its own; nothing for a deck or GRDECL text.
  const ReaderFormat* read(const std::string& path);
  /// The properties that a simulator wrote beside its grid, unless they are among these files anyway.
  void read_init_beside(const std::string& path, const std::vector<std::string>& grid_includes);
  Case finish();
  /// The next file is read as a bare one, whatever section the last one ended in.
  void start_grid_include() {
    section_ = DeckSection::bare;
    grid_.arrays().begin_section(section_);
  }

 private:
  const ReaderFormat* read_grid_part(const std::string& path);
  void skip_to_next_keyword();
  [[nodiscard]] bool begins_known_keyword(const DeckStream::Line& line) const;
  [[nodiscard]] bool begins_keyword_after_unknown(const DeckStream::Line& line) const;
  void refuse_ambiguous(const DeckStream::Line& line) const;
  void handle(const DeckKeyword& keyword);
  bool pass_over(const DeckKeyword& keyword, DeckAction action);
  void skip_array();
  void handle_form(const DeckKeyword& keyword, const DeckKeywordRule& rule);
  void handle_grid(const DeckKeyword& keyword, const DeckKeywordRule& rule);
  void begin_section(const std::string& name);
  void include();
  void skip_block();
  void read_paths();
  void skip_unknown(const DeckKeyword& keyword);
  void set_units(const std::string& name);

  FileStore& files_;
  DeckStream stream_;
  GridSection grid_;
  DeckWells wells_;
  DeckSection section_ = DeckSection::bare;
  std::map<std::string, std::string> paths_;
  bool skips_unknown_ = false;
};

/// A file whose format has its own reader; nothing for any other.
const ReaderFormat* CaseReader::read_grid_part(const std::string& path) {
  const auto content = files_.load(path);
  const ReaderFormat* format = content ? recognise_binary(content->text) : nullptr;
  if (format == nullptr || format->read_grid == nullptr) return nullptr;
  stream_.add_file(*content, path);
  GridPart part = format->read_grid(content->text, content->path);
  for (const std::string& note : part.notes) stream_.notes.push_back(fmt::format("{}: {}", path, note));
  grid_.take(std::move(part), content->path);
  return format;
}

void CaseReader::read_init_beside(const std::string& path, const std::vector<std::string>& grid_includes) {
  const auto is_init = [this](const std::string& name) {
    const auto other = files_.load(name);
    return other && looks_like_init(other->text);
  };
  if (std::any_of(grid_includes.begin(), grid_includes.end(), is_init)) return;
  const std::string stem = std::filesystem::path(path).replace_extension().string();
  for (const char* extension : {".INIT", ".FINIT"}) {
    if (!is_init(stem + extension)) continue;
    stream_.notes.push_back(fmt::format("{}{}: properties are read from this file beside the grid", stem, extension));
    (void)read_grid_part(stem + extension);
    return;
  }
}

const ReaderFormat* CaseReader::read(const std::string& path) {
  if (const ReaderFormat* format = read_grid_part(path)) return format;
  stream_.open(path);
  while (true) {
    skip_to_next_keyword();
    const auto keyword = stream_.next_keyword();
    if (!keyword) return nullptr;
    handle(*keyword);
  }
}

/// Passes over what belongs to keywords that are not read. Ordinary sections are searched line by line for the few
/// keywords that matter; in the grid's sections only what follows an unknown keyword is passed over.
void CaseReader::skip_to_next_keyword() {
  if (!reports_unknown(section_)) {
    while (stream_.is_open() &&
           !stream_.skip_lines_until([this](const auto& line) { return begins_known_keyword(line); }))
      continue;
  } else if (skips_unknown_) {
    (void)stream_.skip_lines_until([this](const auto& line) { return begins_keyword_after_unknown(line); });
  }
  skips_unknown_ = false;
}

/// In the midst of other keywords' data: a word is a keyword when we know it and the line looks like one.
bool CaseReader::begins_known_keyword(const DeckStream::Line& line) const {
  const DeckKeywordRule* rule = find_deck_keyword(line.first, section_);
  if (rule == nullptr) return false;
  if (line.rest.empty() || rule->action == DeckAction::include) return true;
  // "GRID ====" begins a section; "PORO 600*0.2 /" is data on the keyword's line; "SWAT SGAS /" is a list of names.
  if (rule->action == DeckAction::begin_section) return line.column == 0 && !is_letter(line.rest.front());
  return line.column == 0 && is_digit(line.rest.front());
}

bool CaseReader::begins_keyword_after_unknown(const DeckStream::Line& line) const {
  static constexpr std::size_t shortest_unknown = 3;
  const bool may_begin = line.after_record || line.after_keyword;
  if (find_deck_keyword(line.first, section_) == nullptr)
    return line.rest.empty() && line.column == 0 && may_begin && line.first.size() >= shortest_unknown;
  // Records of an unknown keyword may open with the name of an array: "PERMX 100 1 M /".
  if (!line.rest.empty() && is_digit(line.rest.front())) {
    if (line.column == 0 && may_begin && holds_numbers_only(line.rest)) refuse_ambiguous(line);
    return false;
  }
  if (!begins_known_keyword(line)) return false;
  if (!may_begin) refuse_ambiguous(line);
  return true;
}

/// A keyword in the midst of a record that we do not know may be that record's data: reading it would be a guess, and
/// so would be passing over it.
void CaseReader::refuse_ambiguous(const DeckStream::Line& line) const {
  const DeckAction action = find_deck_keyword(line.first, section_)->action;
  if (action == DeckAction::begin_section || action == DeckAction::include || action == DeckAction::end ||
      action == DeckAction::end_include)
    return;
  const std::string& unknown = stream_.keyword().name;
  stream_.fail(line.line, {fmt::format("a '/' that ends the data of {}", unknown),
                           fmt::format("the keyword {}", quoted_for_message(line.first)),
                           fmt::format("{} is not known: end its data with '/', or take it out of the deck", unknown)});
}

void CaseReader::handle(const DeckKeyword& keyword) {
  const DeckKeywordRule* rule = find_deck_keyword(keyword.name, section_);
  if (rule == nullptr) return skip_unknown(keyword);
  switch (rule->action) {
    case DeckAction::refuse:
      stream_.fail(keyword.line,
                   {"a single corner-point grid in text", std::string(rule->detail),
                    rule->advice.empty() ? "export the global grid without it" : std::string(rule->advice)});
    case DeckAction::changed_in_time:
      stream_.note_once(keyword.name + " in time", keyword.line,
                        fmt::format("{} in SCHEDULE changes the grid with time; it is not applied", keyword.name));
      return;
    case DeckAction::well_path: return wells_.read_path(keyword.name);
    case DeckAction::welspecs: return wells_.read_welspecs();
    case DeckAction::compdat: return wells_.read_compdat();
    case DeckAction::injectors: return wells_.read_injectors();
    default: break;
  }
  if (!pass_over(keyword, rule->action)) handle_form(keyword, *rule);
}

/// Keywords that have no effect, by the form of their data. False for any other.
bool CaseReader::pass_over(const DeckKeyword& keyword, DeckAction action) {
  switch (action) {
    case DeckAction::not_applied:
    case DeckAction::not_applied_flag:
    case DeckAction::not_applied_record:
    case DeckAction::not_applied_list:
    case DeckAction::not_applied_array: note_not_applied(stream_, keyword.name, keyword.line); break;
    default: break;
  }
  switch (action) {
    case DeckAction::flag:
    case DeckAction::not_applied_flag: return true;
    case DeckAction::skip:
    case DeckAction::not_applied: skips_unknown_ = true; return true;
    case DeckAction::skip_record:
    case DeckAction::not_applied_record: stream_.skip_record(); return true;
    case DeckAction::not_applied_array: skip_array(); return true;
    case DeckAction::skip_list:
    case DeckAction::not_applied_list:
      while (!stream_.next_record(1000).empty()) continue;
      return true;
    default: return false;
  }
}

/// Numbers up to '/': a word among them means that the '/' is missing.
void CaseReader::skip_array() {
  while (const auto token = stream_.next_value()) {
    if (!token->value.empty() && !parse_real(token->value))
      stream_.fail(stream_.line(), {"a number", quoted_for_message(token->value), ""});
  }
}

/// Keywords that steer the reading itself.
void CaseReader::handle_form(const DeckKeyword& keyword, const DeckKeywordRule& rule) {
  switch (rule.action) {
    case DeckAction::begin_section: return begin_section(keyword.name);
    case DeckAction::include: return include();
    case DeckAction::end: return stream_.close();
    case DeckAction::end_include: return stream_.close_one();
    case DeckAction::skip_block: return skip_block();
    case DeckAction::title: return stream_.skip_text_line();
    case DeckAction::paths: return read_paths();
    default: return handle_grid(keyword, rule);
  }
}

void CaseReader::handle_grid(const DeckKeyword& keyword, const DeckKeywordRule& rule) {
  switch (rule.action) {
    case DeckAction::units: return set_units(keyword.name);
    case DeckAction::dimensions: return grid_.read_dimensions();
    case DeckAction::specgrid: return grid_.read_specgrid();
    case DeckAction::coord: return grid_.read_coord();
    case DeckAction::zcorn: return grid_.read_zcorn();
    case DeckAction::spacing: return grid_.read_spacing();
    case DeckAction::cell_array:
      if (ends_in_edits(keyword.name)) note_not_applied(stream_, keyword.name, keyword.line);
      return grid_.arrays().read_array(*find_cell_array(keyword.name));
    case DeckAction::computed_array:
      note_not_applied(stream_, keyword.name, keyword.line);
      return grid_.arrays().read_computed_array();
    case DeckAction::connections: return grid_.connections().read();
    case DeckAction::box: return grid_.arrays().read_box();
    case DeckAction::end_box: return grid_.arrays().end_box();
    case DeckAction::operation: return grid_.arrays().read_operation();
    case DeckAction::mapaxes: return grid_.read_mapaxes();
    case DeckAction::grid_unit: return grid_.read_grid_unit();
    case DeckAction::map_units: return grid_.read_map_units();
    case DeckAction::grid_orientation: return grid_.read_grid_orientation();
    case DeckAction::grid_options: return grid_.read_grid_options();
    default: return;
  }
}

void CaseReader::set_units(const std::string& name) {
  if (name == "FIELD")
    grid_.set_units(UnitSystem::field);
  else if (name == "LAB")
    grid_.set_units(UnitSystem::lab);
  else
    grid_.set_units(UnitSystem::metric);
}

void CaseReader::begin_section(const std::string& name) {
  section_ = section_of(name);
  grid_.arrays().begin_section(section_);
  // "GRID ======": what follows on the line is decoration.
  stream_.skip_rest_of_line();
}

void CaseReader::include() {
  const DeckToken token = stream_.next_path();
  if (token.kind != DeckToken::Kind::word && token.kind != DeckToken::Kind::quoted)
    stream_.fail(token.line, {"the name of a file", "none", "write it in quotes and end the record with '/'"});
  std::string name(trimmed(token.text));
  if (!name.empty() && name.front() == '$') {
    const auto end = name.find_first_of("/\\");
    const auto found = paths_.find(name.substr(1, end == std::string::npos ? end : end - 1));
    if (found == paths_.end())
      stream_.fail(token.line, {"a name given by PATHS", quoted_for_message(name), "add it to PATHS in RUNSPEC"});
    name = found->second + (end == std::string::npos ? "" : name.substr(end));
  }
  if (name.empty()) stream_.fail(token.line, {"the name of a file", "an empty one", ""});
  stream_.include(name, token.line);
}

void CaseReader::read_paths() {
  while (true) {
    const DeckRecord record = stream_.next_record(2);
    if (record.empty()) return;
    if (!record.has(0) || !record.has(1)) stream_.fail(record.line, {"a name and a path", "less", ""});
    paths_[std::string(record.items[0].text)] = std::string(record.items[1].text);
  }
}

void CaseReader::skip_block() {
  const DeckKeyword opened = stream_.keyword();
  const bool ended = stream_.skip_lines_until([](const auto& line) { return line.first == "ENDSKIP"; });
  if (!ended)
    throw ParseError({opened.file, opened.line, opened.name},
                     {"ENDSKIP after it", "the end of the file", "add ENDSKIP"});
}

void CaseReader::skip_unknown(const DeckKeyword& keyword) {
  stream_.note_once(keyword.name, keyword.line, fmt::format("{} is not understood and is skipped", keyword.name));
  skips_unknown_ = true;
}

Case CaseReader::finish() {
  Case out;
  out.grid = grid_.finish();
  out.deck_wells = wells_.finish(out.grid);
  out.sources = stream_.take_sources();
  out.notes = std::move(stream_.notes);
  return out;
}

}  // namespace

Case parse_case(FileStore& files, const std::string& path, const std::vector<std::string>& grid_includes,
                const DeckLimits& limits) {
  CaseReader reader(files, limits);
  const ReaderFormat* format = reader.read(path);
  if (format != nullptr && (format->read_grid == parse_egrid || format->read_grid == parse_grid_file))
    reader.read_init_beside(path, grid_includes);
  for (const std::string& include : grid_includes) {
    reader.start_grid_include();
    (void)reader.read(include);
  }
  return reader.finish();
}

Case read_case(const std::string& path, const std::vector<std::string>& grid_includes) {
  DiskFiles files;
  return parse_case(files, path, grid_includes);
}

}  // namespace wellknit
