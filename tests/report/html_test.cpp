// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "report/html.h"

#include <gtest/gtest.h>

#include "tests/support/meshes.h"

namespace wellknit {
namespace {

TEST(Html, TextCannotBecomeMarkup) {
  EXPECT_EQ(escaped("<b a=\"1\" c='2'>&"), "&lt;b a=&quot;1&quot; c=&#39;2&#39;&gt;&amp;");
  EXPECT_EQ(inside_script("{\"a\":\"</script>\"}"), "{\"a\":\"\\u003c/script>\"}");
}

TEST(Html, OptionsBecomeCode) {
  EXPECT_EQ(with_options("a smaller --radius & more"), "a smaller <code>--radius</code> &amp; more");
}

TEST(Html, NumbersAreShort) {
  EXPECT_EQ(shown(1234567.0), "1,234,567");
  EXPECT_EQ(shown(-1234.0), "-1,234");
  EXPECT_EQ(shown(0.0412345), "0.04123");
  EXPECT_EQ(shown(std::numeric_limits<double>::quiet_NaN()), "–");
}

TEST(Html, FiguresCarryTheirExactValue) {
  const QualityReport report = quality(meshes::two_boxes());
  EXPECT_EQ(Figures(report).span("faces", " m"), "<span data-figure=\"faces\" data-value=\"11\">11 m</span>");
  EXPECT_EQ(Figures(report).span("no such figure"), "–");
}

}  // namespace
}  // namespace wellknit
