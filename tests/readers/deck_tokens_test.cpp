// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "readers/deck_tokens.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace wellknit {
namespace {

using Kind = DeckToken::Kind;

std::vector<std::string> words_of(std::string_view text) {
  std::vector<std::string> out;
  DeckTokens tokens(text);
  for (DeckToken token = tokens.next(); token.kind != Kind::end; token = tokens.next()) out.emplace_back(token.text);
  return out;
}

using Words = std::vector<std::string>;

TEST(DeckTokens, SplitAtBlanksTabsAndSlashes) {
  EXPECT_EQ(words_of("PORO\n\t600*0.2/ rest of the line\n1 2 /"), (Words{"PORO", "600*0.2", "/", "1", "2", "/"}));
}

TEST(DeckTokens, PassOverComments) {
  EXPECT_EQ(words_of("-- title\nA--b\nC -- d / e\n--\nF"), (Words{"A", "C", "F"}));
  EXPECT_EQ(words_of("1.0-2"), (Words{"1.0-2"})) << "one dash is no comment";
}

TEST(DeckTokens, KeepWhatQuotesHold) {
  EXPECT_EQ(words_of("'A -- /b' \"c d\"/"), (Words{"A -- /b", "c d", "/"}));
  EXPECT_EQ(words_of("3*'A B' 2*"), (Words{"3*'A B'", "2*"}));
}

TEST(DeckTokens, MarkAQuoteWithoutItsEnd) {
  DeckTokens tokens("'abc\nD");
  EXPECT_EQ(tokens.next().kind, Kind::unterminated);
  EXPECT_EQ(tokens.next().text, "D");
}

TEST(DeckTokens, CountLinesForEveryLineEnd) {
  for (const char* text : {"A\nB\nC", "A\r\nB\r\nC", "A\rB\rC", "A\n--x\nC", "A\r--x\rC"}) {
    DeckTokens tokens(text);
    DeckToken last;
    for (DeckToken token = tokens.next(); token.kind != Kind::end; token = tokens.next()) last = token;
    EXPECT_EQ(last.text, "C") << text;
    EXPECT_EQ(last.line, 3) << text;
  }
}

TEST(DeckTokens, TakeAFileNameWithSlashesInIt) {
  DeckTokens tokens("INCLUDE\n ../a/b.inc / text\nNEXT");
  (void)tokens.next();
  EXPECT_EQ(tokens.next_path().text, "../a/b.inc");
  EXPECT_EQ(tokens.next().text, "NEXT");
  DeckTokens glued("a.inc/\nNEXT");
  EXPECT_EQ(glued.next_path().text, "a.inc");
  EXPECT_EQ(glued.next().text, "NEXT");
}

TEST(DeckTokens, PassOverAByteOrderMark) { EXPECT_EQ(words_of("\xEF\xBB\xBFPORO"), (Words{"PORO"})); }

TEST(KeywordName, IsALetterThenLettersDigitsAndSigns) {
  EXPECT_TRUE(is_keyword_name("MULTZ-"));
  EXPECT_TRUE(is_keyword_name("poro"));
  EXPECT_FALSE(is_keyword_name("1PORO"));
  EXPECT_FALSE(is_keyword_name("MD,X"));
  EXPECT_FALSE(is_keyword_name(""));
}

}  // namespace
}  // namespace wellknit
