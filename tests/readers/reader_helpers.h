// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// Cases from memory, and the error that a call ends in.
#pragma once

#include <gtest/gtest.h>

#include <map>
#include <optional>
#include <string>
#include <utility>

#include "model/errors.h"
#include "readers/parse_case.h"

namespace wellknit {

/// The case in this text; others are files that it may include.
inline Case case_of(const std::string& text, std::map<std::string, std::string> others = {}) {
  others["case.GRDECL"] = text;
  MemoryFiles files(std::move(others));
  return parse_case(files, "case.GRDECL");
}

/// The ParseError that a call throws; nothing, and a failed test, when it throws none.
template <class Call>
std::optional<ParseError> error_of(Call call) {
  try {
    (void)call();
  } catch (const ParseError& error) {
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << "one line: " << error.what();
    return error;
  }
  ADD_FAILURE() << "no ParseError";
  return std::nullopt;
}

inline std::optional<ParseError> error_in(const std::string& text, std::map<std::string, std::string> others = {}) {
  return error_of([&] { return case_of(text, std::move(others)); });
}

/// One box [0,1] x [0,1] x [0,1] times its dimensions; no keyword after the geometry.
inline std::string unit_boxes(int nx, int ny, int nz) {
  const auto number = [](auto value) { return std::to_string(value) + " "; };
  std::string text = "SPECGRID\n" + number(nx) + number(ny) + number(nz) + "1 F /\nCOORD\n";
  for (int j = 0; j <= ny; ++j)
    for (int i = 0; i <= nx; ++i) text += number(i) + number(j) + "0 " + number(i) + number(j) + number(nz) + "\n";
  text += "/\nZCORN\n";
  for (int k = 0; k < nz; ++k) {
    text += std::to_string(4 * nx * ny) + "*" + number(k);
    text += std::to_string(4 * nx * ny) + "*" + number(k + 1) + "\n";
  }
  return text + "/\n";
}

}  // namespace wellknit
