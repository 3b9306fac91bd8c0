// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "readers/read_value_table.h"

#include <gtest/gtest.h>

#include "model/errors.h"

namespace wellknit {
namespace {

ValueTable parse(const std::string& text) { return parse_value_table(text, "table.csv"); }

TEST(ReadValueTable, TakesAHeaderAndRowsOfAnySeparator) {
  for (const char* text : {"cell,p_bar\n3,1.5\n0,-2e3\n", "\xEF\xBB\xBF# comment\nCell;p_bar\r\n3;1.5\r\n\r\n0;-2e3",
                           "cell p_bar\n3 1.5\n0 -2D3\n", "cell\tp_bar\r3\t1.5\r-- note\r0\t-2e3\r"}) {
    const ValueTable table = parse(text);
    EXPECT_EQ(table.index_title, "cell") << text;
    EXPECT_EQ(table.value_title, "p_bar") << text;
    EXPECT_EQ(table.index, (std::vector<std::int64_t>{3, 0})) << text;
    EXPECT_EQ(table.value, (std::vector<double>{1.5, -2000.0})) << text;
  }
}

TEST(ReadValueTable, TakesNumbersAlone) {
  const ValueTable table = parse("1.5\n2\n\n3\n");
  EXPECT_EQ(table.index_title, "");
  EXPECT_EQ(table.index, (std::vector<std::int64_t>{0, 1, 2}));
  EXPECT_EQ(table.value, (std::vector<double>{1.5, 2.0, 3.0}));
}

TEST(ReadValueTable, NamesTheLineOfAFault) {
  struct Fault {
    const char* text;
    std::int64_t line;
  };
  for (const auto& [text, line] :
       {Fault{"cell,p\n1,2\n-1,3\n", 3}, Fault{"cell,p\n1\n", 2}, Fault{"cell,p\n1,2,3\n", 2},
        Fault{"cell,p\n1.5,2\n", 2}, Fault{"cell,p\n1,inf\n", 2}, Fault{"cell,p\n1,nan\n", 2},
        Fault{"edge,p\n1,2\n", 1}, Fault{"1\ntwo\n", 2}, Fault{"1\n2,3\n", 2},
        Fault{"cell,p\n99999999999999999999,3\n", 2}}) {
    try {
      (void)parse(text);
      FAIL() << text;
    } catch (const ParseError& error) {
      EXPECT_EQ(error.where().line, line) << text;
    }
  }
  for (const char* empty : {"", "\n\n", "cell,p\n", "# nothing\n"})
    EXPECT_THROW((void)parse(empty), ParseError) << empty;
}

TEST(ReadValueTable, SurvivesEveryTruncation) {
  const std::string text = "cell,pressure_bar\n12,3.5e2\r\n7 , -1\n# end\n";
  for (std::size_t length = 0; length <= text.size(); ++length) {
    try {
      const ValueTable table = parse(text.substr(0, length));
      EXPECT_EQ(table.index.size(), table.value.size());
    } catch (const ParseError&) {
      continue;  // one line that says why is as good
    }
  }
}

}  // namespace
}  // namespace wellknit
