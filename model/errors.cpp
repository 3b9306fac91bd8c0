// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "model/errors.h"

#include <fmt/format.h>

namespace wellknit {

namespace {

std::string one_line(const ParseError::Where& where, const ParseError::What& what) {
  std::string text = where.file;
  if (where.line > 0) text += fmt::format(":{}", where.line);
  text += ": ";
  if (!where.keyword.empty()) text += where.keyword + ": ";
  text += fmt::format("expected {}, found {}", what.expected, what.found);
  if (!what.advice.empty()) text += "; " + what.advice;
  return text;
}

}  // namespace

ParseError::ParseError(Where where, What what)
    : std::runtime_error(one_line(where, what)), where_(std::move(where)), what_(std::move(what)) {}

}  // namespace wellknit
