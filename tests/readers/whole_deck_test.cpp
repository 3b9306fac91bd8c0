// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "readers/whole_deck.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "tests/readers/reader_helpers.h"
#include "tests/support/random_seed.h"

namespace wellknit {

namespace {

const std::string deck_text = R"(-- head
RUNSPEC
TITLE
 SCHEDULE
DIMENS
 2 1 1 /
OIL

GRID ----
INCLUDE
 'grid.inc' /
PORO
 2*0.2 /

PROPS
SWL
 0.1 0.2 / ends
SWOF
 0 0 1 0
 1 1 0 0 /

SOLUTION
EQUIL
 1000 200 /

SUMMARY
STEPTYPE
NLINEARS
WOPR
 BPR
/
BPR
 2 1 1 / here
/

SCHEDULE
WELSPECS
 'P' G 2*1 1* OIL /
/
COMPDAT
 'P' 2 1 1 1 OPEN 2* .2 / text
/
TSTEP
 1 /
END
COMPDAT
)";

std::optional<WholeDeck> read(const std::string& text, std::map<std::string, std::string> others = {}) {
  others.emplace("grid.inc", "PERMX\n 2*1 /\n");
  others["case.DATA"] = text;
  MemoryFiles files(std::move(others));
  return read_whole_deck(files, "case.DATA");
}

const DeckTextKeyword& keyword(const WholeDeck& deck, const std::string& name) {
  const auto found = std::ranges::find(deck.keywords, name, &DeckTextKeyword::name);
  if (found == deck.keywords.end()) throw std::runtime_error("no " + name);
  return *found;
}

}  // namespace

TEST(WholeDeck, KnowsWhereItsKeywordsStand) {
  const auto deck = read(deck_text);
  ASSERT_TRUE(deck);
  EXPECT_EQ(deck->files.size(), 2U);
  EXPECT_EQ(deck->dimensions, (std::array<std::int64_t, 3>{2, 1, 1}));
  const DeckTextKeyword& swl = keyword(*deck, "SWL");
  EXPECT_EQ(deck_text.substr(swl.begin, swl.end - swl.begin), "SWL\n 0.1 0.2 / ends");
  EXPECT_EQ(swl.role, DeckRole::array);
  const DeckTextKeyword& bpr = keyword(*deck, "BPR");
  ASSERT_EQ(bpr.records.size(), 1U) << "the well BPR is no keyword";
  EXPECT_EQ(deck_text.substr(bpr.records[0].begin, 5), "2 1 1");
  const auto compdats = std::ranges::count(deck->keywords, "COMPDAT", &DeckTextKeyword::name);
  EXPECT_EQ(compdats, 1) << "nothing is read after END";
  EXPECT_TRUE(deck->refusals.empty());
}

TEST(WholeDeck, CountsRepeatedItems) {
  const auto deck = read(deck_text);
  ASSERT_TRUE(deck);
  const DeckTextRecord& head = keyword(*deck, "WELSPECS").records.at(0);
  EXPECT_EQ(head.size(), 6);
  EXPECT_EQ(head.text(0), "P");
  EXPECT_EQ(head.text(3), "1");
  EXPECT_EQ(head.find(4), nullptr);
  EXPECT_EQ(head.text(5), "OIL");
}

TEST(WholeDeck, PartsAreTheWholeText) {
  const auto deck = read(deck_text);
  ASSERT_TRUE(deck);
  std::string main;
  for (const DeckTextPart& part : deck->parts)
    if (part.file == 0) main += deck_text.substr(part.begin, part.end - part.begin);
  EXPECT_EQ(main, deck_text);
  const auto include = std::ranges::find_if(deck->parts, [](const auto& part) { return part.includes.has_value(); });
  ASSERT_NE(include, deck->parts.end());
  EXPECT_EQ(deck_text.substr(include->begin, include->end - include->begin), "INCLUDE\n 'grid.inc' /");
  EXPECT_EQ(include->section, DeckSection::grid);
}

TEST(WholeDeck, IsOnlyOneWithAllSections) {
  std::string text = deck_text;
  text.replace(text.find("PROPS"), 5, "-----");
  EXPECT_FALSE(read(text));
  EXPECT_FALSE(read("SPECGRID\n 1 1 1 /\n"));
  EXPECT_FALSE(read(""));
}

TEST(WholeDeck, RemembersWhatCannotBeConverted) {
  std::string text = deck_text;
  text.insert(text.find("OIL"), "DUALPORO\n");
  text.insert(text.find("SWOF"), "MYPROP\n 1 2 /\n");
  text.insert(text.find("SWOF"), "MYTABLE\n 1 2 3 /\n");
  const auto deck = read(text);
  ASSERT_TRUE(deck);
  ASSERT_EQ(deck->refusals.size(), 2U);
  EXPECT_EQ(deck->refusals[0].where().keyword, "DUALPORO");
  EXPECT_EQ(deck->refusals[1].where().keyword, "MYPROP");
  EXPECT_NE(std::string(deck->refusals[1].what()).find("one for each cell"), std::string::npos);
}

TEST(WholeDeck, DamageEndsInAParseErrorOrADeck) {
  const auto survives = [](const std::string& text) {
    try {
      (void)read(text);
    } catch (const ParseError& error) {
      EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
    }
  };
  for (std::size_t length = 0; length < deck_text.size(); ++length) survives(deck_text.substr(0, length));
  const unsigned seed = random_seed();
  SCOPED_TRACE("seed " + std::to_string(seed));
  std::mt19937 chance(seed);
  const std::string bytes("/'\"*-9\n\r Z\0", 11);
  for (int n = 0; n < 20000; ++n) {
    std::string text = deck_text;
    for (int change = 0; change < 3; ++change) text[chance() % text.size()] = bytes[chance() % bytes.size()];
    survives(text);
  }
}

TEST(WholeDeck, RefusesIncludesWithoutEnd) {
  const auto error = error_of([] { return read(deck_text, {{"grid.inc", "INCLUDE\n 'grid.inc' /\n"}}); });
  ASSERT_TRUE(error);
  EXPECT_NE(std::string(error->what()).find("including itself"), std::string::npos);
}

}  // namespace wellknit
