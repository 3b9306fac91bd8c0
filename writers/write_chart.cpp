// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "writers/write_chart.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace wellknit {

namespace {

// Pixels.
constexpr double width = 640.0, height = 360.0, left = 80.0, right = 20.0, top = 40.0, bottom = 50.0;
constexpr std::array colours{"#1f5aa6", "#d1495b", "#3a7d44", "#6d597a"};

struct Range {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();
  void add(double value) {
    low = std::min(low, value);
    high = std::max(high, value);
  }
};

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '<')
      out += "&lt;";
    else if (c == '&')
      out += "&amp;";
    else
      out += c;
  }
  return out;
}

/// 1, 2 or 5 times a power of ten: about five of them in the range.
double tick_step(const Range& range) {
  const double raw = (range.high - range.low) / 5.0;
  const double power = std::pow(10.0, std::floor(std::log10(raw)));
  for (const double factor : {1.0, 2.0, 5.0})
    if (factor * power >= raw) return factor * power;
  return 10.0 * power;
}

void widen(Range& range) {
  if (!(range.low <= range.high)) range = {0.0, 1.0};
  if (range.high > range.low) return;
  const double margin = range.low == 0.0 ? 1.0 : 0.1 * std::abs(range.low);
  range = {range.low - margin, range.high + margin};
}

}  // namespace

std::string chart_svg(const Chart& chart) {
  Range x;
  Range y;
  for (const ChartCurve& curve : chart.curves) {
    for (const double value : curve.x) x.add(value);
    for (const double value : curve.y) y.add(value);
  }
  widen(x);
  widen(y);
  const auto at_x = [&](double v) { return left + (v - x.low) / (x.high - x.low) * (width - left - right); };
  const auto at_y = [&](double v) {
    return height - bottom - (v - y.low) / (y.high - y.low) * (height - top - bottom);
  };
  std::string out = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" viewBox=\"0 0 {0} {1}\" "
      "font-family=\"sans-serif\" font-size=\"12\">\n<rect width=\"{0}\" height=\"{1}\" fill=\"white\"/>\n"
      "<text x=\"{2}\" y=\"22\" font-size=\"15\">{3}</text>\n",
      width, height, left, escaped(chart.title));
  const double x_step = tick_step(x);
  for (double v = std::ceil(x.low / x_step) * x_step; v <= x.high + 1e-9 * x_step; v += x_step)
    out += fmt::format(
        "<line x1=\"{0:.1f}\" x2=\"{0:.1f}\" y1=\"{1}\" y2=\"{2}\" stroke=\"#ddd\"/><text x=\"{0:.1f}\" y=\"{3}\" "
        "text-anchor=\"middle\">{4:.6g}</text>\n",
        at_x(v), top, height - bottom, height - bottom + 16, std::abs(v) < 1e-9 * x_step ? 0.0 : v);
  const double y_step = tick_step(y);
  for (double v = std::ceil(y.low / y_step) * y_step; v <= y.high + 1e-9 * y_step; v += y_step)
    out += fmt::format(
        "<line y1=\"{0:.1f}\" y2=\"{0:.1f}\" x1=\"{1}\" x2=\"{2}\" stroke=\"#ddd\"/><text x=\"{3}\" y=\"{0:.1f}\" "
        "dy=\"4\" text-anchor=\"end\">{4:.6g}</text>\n",
        at_y(v), left, width - right, left - 6, std::abs(v) < 1e-9 * y_step ? 0.0 : v);
  out += fmt::format("<text x=\"{}\" y=\"{}\" text-anchor=\"middle\">{}</text>\n", 0.5 * (left + width - right),
                     height - 12, escaped(chart.x_title));
  out += fmt::format("<text transform=\"translate(16 {}) rotate(-90)\" text-anchor=\"middle\">{}</text>\n",
                     0.5 * (top + height - bottom), escaped(chart.y_title));
  for (std::size_t c = 0; c < chart.curves.size(); ++c) {
    const ChartCurve& curve = chart.curves[c];
    const char* colour = colours.at(c % colours.size());
    out += fmt::format("<polyline fill=\"none\" stroke=\"{}\" stroke-width=\"1.6\" points=\"", colour);
    for (std::size_t n = 0; n < curve.x.size(); ++n)
      out += fmt::format("{:.1f},{:.1f} ", at_x(curve.x[n]), at_y(curve.y[n]));
    out += "\"/>\n";
    out += fmt::format("<text x=\"{}\" y=\"{}\" text-anchor=\"end\" fill=\"{}\">{}</text>\n", width - right,
                       20.0 + 14.0 * static_cast<double>(c), colour, escaped(curve.name));
  }
  return out + "</svg>\n";
}

}  // namespace wellknit
