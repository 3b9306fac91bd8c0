// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "writers/write_property.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "model/errors.h"

namespace wellknit {

namespace {

constexpr std::size_t longest_keyword = 8;
constexpr std::size_t longest_line = 100;  ///< Eclipse reads 128 characters

void check_keyword(const std::string& keyword) {
  const auto is_upper = [](char c) { return c >= 'A' && c <= 'Z'; };
  const auto is_allowed = [&](char c) { return is_upper(c) || (c >= '0' && c <= '9') || c == '_'; };
  if (keyword.empty() || keyword.size() > longest_keyword || !is_upper(keyword.front()) ||
      !std::all_of(keyword.begin(), keyword.end(), is_allowed))
    throw InvalidInput(fmt::format("'{}' is no keyword: 1 to {} capital letters and digits, a letter first", keyword,
                                   longest_keyword));
}

template <class T>
void check_finite(const std::string& keyword, const std::vector<T>& values) {
  for (std::size_t n = 0; n < values.size(); ++n)
    if (!std::isfinite(static_cast<double>(values[n])))
      throw InvalidInput(fmt::format("{}: the value of cell {} is not finite", keyword, n));
}

template <class T>
void write_values(std::ofstream& out, const std::vector<T>& values) {
  std::string line;
  for (std::size_t n = 0; n < values.size();) {
    std::size_t end = n + 1;
    while (end < values.size() && values[end] == values[n]) ++end;
    const std::string word = end - n > 1 ? fmt::format(" {}*{}", end - n, values[n]) : fmt::format(" {}", values[n]);
    if (line.size() + word.size() > longest_line) {
      out << line << '\n';
      line.clear();
    }
    line += word;
    n = end;
  }
  out << line << '\n';
}

}  // namespace

void write_property(const std::string& path, const std::string& keyword, const CellProperty& values,
                    const std::string& comment, Overwrite overwrite) {
  check_keyword(keyword);
  std::visit([&](const auto& numbers) { check_finite(keyword, numbers); }, values);
  OutputStream out(path, overwrite);
  out.stream() << "-- " << comment << '\n' << keyword << '\n';
  std::visit([&](const auto& numbers) { write_values(out.stream(), numbers); }, values);
  out.stream() << "/\n";
  out.commit();
}

}  // namespace wellknit
