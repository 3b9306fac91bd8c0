// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// wellknit formats: the tables of readers and writers (docs/commands/formats.md).

#include <fmt/format.h>

#include <algorithm>
#include <iostream>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "cli/commands.h"
#include "readers/formats.h"
#include "writers/formats.h"

namespace wellknit {

namespace {

struct Row {
  std::string name;
  std::string extensions;
  std::string description;
  std::string document;  ///< page under docs/formats; empty: none of its own
};

template <class Words>
std::string joined(const Words& words) {
  std::string text;
  for (const std::string_view word : words) text += (text.empty() ? "" : " ") + std::string(word);
  return text;
}

/// Formats that are read, or those that are only recognised.
std::vector<Row> reader_rows(bool is_read) {
  std::vector<Row> rows;
  for (const ReaderFormat& format : reader_formats()) {
    if (format.is_read != is_read) continue;
    rows.push_back({std::string(format.name), joined(format.extensions), std::string(format.description), ""});
  }
  return rows;
}

std::vector<Row> writer_rows() {
  std::vector<Row> rows;
  for (const WriterFormat& format : writer_formats()) {
    rows.push_back({std::string(format.name), joined(format.extensions), std::string(format.description),
                    std::string(format.document)});
  }
  return rows;
}

std::string plain_table(const char* title, const std::vector<Row>& rows) {
  std::size_t name_width = 0;
  std::size_t extension_width = 0;
  for (const Row& row : rows) {
    name_width = std::max(name_width, row.name.size());
    extension_width = std::max(extension_width, row.extensions.size());
  }
  std::string text = fmt::format("{}\n", title);
  for (const Row& row : rows) {
    text += fmt::format("  {:{}}  {:{}}  {}\n", row.name, name_width, row.extensions, extension_width, row.description);
  }
  return text;
}

std::string key_table() {
  std::string text =
      "keys (--write FORMAT=PATH,key=value; convert --to FORMAT,key=value; the first value is the default)\n";
  for (const WriterFormat& format : writer_formats())
    for (const WriterKey& key : writer_keys(format.name))
      text += fmt::format("  {:<11}  {}={}  {}\n", format.name, key.name, key.values, key.description);
  return text;
}

std::string markdown_rows(const char* way, const std::vector<Row>& rows) {
  std::string text;
  for (const Row& row : rows) {
    const std::string name =
        row.document.empty() ? row.name : fmt::format("[{}](docs/formats/{})", row.name, row.document);
    text += fmt::format("| {} | {} | `{}` | {} |\n", way, name, row.extensions, row.description);
  }
  return text;
}

std::string markdown() {
  return "| | format | extensions | what |\n| --- | --- | --- | --- |\n" + markdown_rows("in", reader_rows(true)) +
         markdown_rows("out", writer_rows());
}

std::string plain() {
  std::string text = plain_table("readers (recognised by content, then by extension)", reader_rows(true)) + "\n" +
                     plain_table("writers (--write FORMAT=PATH)", writer_rows()) + "\n" + key_table();
  const std::vector<Row> later = reader_rows(false);
  return later.empty() ? text : text + "\n" + plain_table("recognised, but not read by this version", later);
}

}  // namespace

Run add_formats(CLI::App& app) {
  const auto as_markdown = std::make_shared<bool>(false);
  app.add_flag("--markdown", *as_markdown, "As the table in README.md");
  return [as_markdown] {
    std::cout << (*as_markdown ? markdown() : plain());
    return 0;
  };
}

}  // namespace wellknit
