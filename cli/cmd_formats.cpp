// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// wellknit formats: the tables of readers and writers (docs/commands/formats.md).

#include <fmt/format.h>

#include <algorithm>
#include <iostream>
#include <memory>
#include <span>
#include <string>
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
  std::string document;
};

std::string joined(std::span<const std::string_view> words) {
  std::string text;
  for (const std::string_view word : words) text += (text.empty() ? "" : " ") + std::string(word);
  return text;
}

/// Readers and writers have the same columns.
template <class Formats>
std::vector<Row> rows(const Formats& formats) {
  std::vector<Row> out;
  for (const auto& format : formats) {
    out.push_back({std::string(format.name), joined(format.extensions), std::string(format.description),
                   std::string(format.document)});
  }
  return out;
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

std::string markdown_rows(const char* way, const std::vector<Row>& rows) {
  std::string text;
  for (const Row& row : rows) {
    text += fmt::format("| {} | [`{}`](docs/formats/{}) | `{}` | {} |\n", way, row.name, row.document, row.extensions,
                        row.description);
  }
  return text;
}

}  // namespace

Run add_formats(CLI::App& app) {
  const auto markdown = std::make_shared<bool>(false);
  app.add_flag("--markdown", *markdown, "As the table in README.md");
  return [markdown] {
    const std::vector<Row> in = rows(reader_formats());
    const std::vector<Row> out = rows(writer_formats());
    if (*markdown) {
      std::cout << "| | format | extensions | what |\n| --- | --- | --- | --- |\n"
                << markdown_rows("in", in) << markdown_rows("out", out);
    } else {
      std::cout << plain_table("readers (recognised by content, then by extension)", in) << '\n'
                << plain_table("writers (--write FORMAT=PATH)", out);
    }
    return 0;
  };
}

}  // namespace wellknit
