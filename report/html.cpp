// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "report/html.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <regex>

namespace wellknit {

std::string escaped(std::string_view text) {
  std::string out;
  out.reserve(text.size());
  for (const char c : text) {
    switch (c) {
      case '&': out += "&amp;"; break;
      case '<': out += "&lt;"; break;
      case '>': out += "&gt;"; break;
      case '"': out += "&quot;"; break;
      case '\'': out += "&#39;"; break;
      default: out += c;
    }
  }
  return out;
}

std::string with_options(std::string_view text) {
  static const std::regex option("--[a-z-]+");
  return std::regex_replace(escaped(text), option, "<code>$&</code>");
}

std::string inside_script(std::string_view json) {
  std::string out;
  out.reserve(json.size());
  for (const char c : json) {
    if (c == '<')
      out += "\\u003c";
    else
      out += c;
  }
  return out;
}

std::string grouped(std::int64_t count) {
  std::string digits = fmt::format("{}", count);
  for (std::size_t end = digits.size(); end > 3 && digits[end - 4] != '-'; end -= 3) digits.insert(end - 3, ",");
  return digits;
}

std::string shown(double value) {
  if (!std::isfinite(value)) return "–";
  if (value == std::floor(value) && std::abs(value) < 1e15) return grouped(static_cast<std::int64_t>(value));
  return fmt::format("{:.4g}", value);
}

std::string row(const std::vector<std::string>& cells, std::string_view element) {
  std::string out = "<tr>";
  for (const std::string& cell : cells) out += fmt::format("<{0}>{1}</{0}>", element, cell);
  return out + "</tr>\n";
}

std::string table(std::string_view caption, const std::vector<std::string>& heads, const std::string& rows) {
  std::string out =
      "<div class=\"wide\" tabindex=\"0\"><table><caption>" + std::string(caption) + "</caption>\n<thead><tr>";
  for (const std::string& head : heads) out += "<th scope=\"col\">" + head + "</th>";
  return out + "</tr></thead>\n<tbody>\n" + rows + "</tbody></table></div>\n";
}

std::string Figures::span(const std::string& name, std::string_view unit) const {
  const auto found = std::ranges::find(figures_, name, &Figure::name);
  if (found == figures_.end()) return "–";
  return fmt::format("<span data-figure=\"{}\" data-value=\"{}\">{}{}</span>", name, found->value, shown(found->value),
                     unit);
}

}  // namespace wellknit
