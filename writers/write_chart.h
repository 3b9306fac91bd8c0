// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// Curves over time as SVG.
#pragma once

#include <string>
#include <vector>

namespace wellknit {

struct ChartCurve {
  std::string name;
  std::vector<double> x;
  std::vector<double> y;  ///< as many as x
};

struct Chart {
  std::string title;
  std::string x_title;
  std::string y_title;
  std::vector<ChartCurve> curves;  ///< at most four
};

/// A whole SVG document.
std::string chart_svg(const Chart& chart);

}  // namespace wellknit
