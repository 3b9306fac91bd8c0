// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// Pieces of HTML: text made safe, numbers as a reader wants them, tables.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

#include "model/quality.h"

namespace wellknit {

/// Text of a file or a user, safe inside an element and inside a quoted attribute.
std::string escaped(std::string_view text);

/// escaped(), with options such as --radius as code.
std::string with_options(std::string_view text);

/// JSON or base64 inside a script element: no "<" may stand in it.
std::string inside_script(std::string_view json);

/// 12345678 as 12,345,678.
std::string grouped(std::int64_t count);
/// Four significant digits; counts in full.
std::string shown(double value);

/// A row of a table: cells are HTML already.
std::string row(const std::vector<std::string>& cells, std::string_view element = "td");
/// A table with a caption for screen readers; scrolls by itself where it is too wide.
std::string table(std::string_view caption, const std::vector<std::string>& heads, const std::string& rows);

/// The figures of `wellknit check --json`, by name, each with its exact value beside the shown one.
class Figures {
 public:
  explicit Figures(const QualityReport& report) : figures_(figures(report)) {}
  /// A span that carries the exact value; a dash where the mesh has no such figure.
  [[nodiscard]] std::string span(const std::string& name, std::string_view unit = "") const;

 private:
  std::vector<Figure> figures_;
};

}  // namespace wellknit
