// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// Faults in a deck: each is a ParseError with its file, line and keyword.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <string>

#include "readers/file_content.h"
#include "readers/read_case.h"
#include "tests/readers/reader_helpers.h"

namespace wellknit {
namespace {

/// The geometry takes lines 1 to 11; what follows starts on line 12.
const std::string grid = unit_boxes(1, 1, 1);
constexpr std::int64_t next_line = 12;

void expect_error(const std::string& text, std::int64_t line, const std::string& keyword, const std::string& expected) {
  const auto error = error_in(text);
  ASSERT_TRUE(error) << text;
  EXPECT_EQ(error->where().file, "case.GRDECL");
  EXPECT_EQ(error->where().line, line) << error->what();
  EXPECT_EQ(error->where().keyword, keyword) << error->what();
  EXPECT_NE(std::string(error->what()).find(expected), std::string::npos) << error->what();
}

TEST(CaseErrors, GeometryEndsOnLineEleven) { EXPECT_EQ(std::count(grid.begin(), grid.end(), '\n'), next_line - 1); }

TEST(CaseErrors, EveryTruncationIsAnErrorOrAWholeGrid) {
  const std::string text(load_file(std::string(WELLKNIT_TESTDATA) + "/grdecl/box.GRDECL").text);
  const std::size_t geometry_ends = text.find("PORO") - 2;
  for (std::size_t size = 0; size < text.size(); ++size) {
    MemoryFiles files({{"cut", text.substr(0, size)}});
    try {
      validate(parse_case(files, "cut").grid);
      EXPECT_GE(size, geometry_ends) << text.substr(0, size);
    } catch (const ParseError& error) {
      EXPECT_EQ(error.where().file, "cut");
    }
  }
}

TEST(CaseErrors, EmptyFile) { expect_error("", 0, "SPECGRID", "the dimensions of a grid"); }

TEST(CaseErrors, MissingFile) {
  MemoryFiles files({});
  const auto error = error_of([&] { return parse_case(files, "no.DATA"); });
  ASSERT_TRUE(error);
  EXPECT_STREQ(error->what(), "no.DATA: expected a file, found none of this name; check the path");
}

TEST(CaseErrors, TextInANumber) {
  expect_error(grid + "PORO\n\n 0.2x /\n", next_line + 2, "PORO", "expected a number, found '0.2x'");
  expect_error(grid + "SATNUM\n 1.5 /\n", next_line + 1, "SATNUM", "expected an integer, found '1.5'");
  expect_error(grid + "PORO\n 'a' /\n", next_line + 1, "PORO", "found the text 'a'");
  expect_error(grid + "PORO\nNTG\n 1 /\n", next_line + 1, "PORO", "expected a number, found 'NTG'");
}

TEST(CaseErrors, WrongCounts) {
  expect_error(grid + "PORO\n 0.2 0.3 /\n", next_line + 1, "PORO", "expected 1 values, found more");
  expect_error(grid + "PORO\n /\n", next_line + 1, "PORO", "expected 1 values, found 0 before the '/'");
  expect_error(grid + "PORO\n 1000000000*0.2 /\n", next_line + 1, "PORO", "found more");
  expect_error(grid + "PORO\n 99999999999999999999999*0.2 /\n", next_line + 1, "PORO", "a repeat count of 1 or more");
  expect_error(grid + "PORO\n 0*0.2 /\n", next_line + 1, "PORO", "a repeat count of 1 or more");
}

TEST(CaseErrors, CutZcorn) {
  const std::string cut = grid.substr(0, grid.find("4*1"));
  expect_error(cut + "/\n", 10, "ZCORN", "expected 8 values, found 4");
  expect_error(cut, 10, "ZCORN", "found the end of the file");
}

TEST(CaseErrors, MissingGeometry) {
  expect_error("SPECGRID\n 1 1 1 /\n", 0, "COORD", "COORD and ZCORN, or DX, DY, DZ and TOPS");
  expect_error("DIMENS\n 1 1 1 /\nCOORD\n 24*0 /\n", 0, "ZCORN", "ZCORN beside COORD");
  expect_error("DIMENS\n 1 1 1 /\nZCORN\n 8*0 /\n", 0, "COORD", "COORD beside ZCORN");
  expect_error("DIMENS\n 1 1 1 /\nDX\n 1 /\nDY\n 1 /\nTOPS\n 1 /\n", 0, "COORD", "found no DZ");
}

TEST(CaseErrors, ArraysBeforeTheDimensions) {
  expect_error("PORO\n 0.2 /\n", 1, "PORO", "SPECGRID or DIMENS before it");
}

TEST(CaseErrors, ImpossibleDimensions) {
  expect_error("SPECGRID\n 0 1 1 /\n", 2, "SPECGRID", "found '0'");
  expect_error("SPECGRID\n 1 1 /\n", 2, "SPECGRID", "no item 3");
  expect_error("SPECGRID\n 100000 100000 100000 /\n", 2, "SPECGRID", "found '100000'");
  expect_error("SPECGRID\n 99999999999999999999 1 1 /\n", 2, "SPECGRID", "an integer as item 1");
  expect_error(grid + "DIMENS\n 2 1 1 /\n", next_line + 1, "DIMENS", "the dimensions given before, 1 1 1");
}

TEST(CaseErrors, ArraysOutOfProportionToTheFile) {
  // 8 x 10^9 values from a line of text: more than any memory, refused before anything is allocated.
  expect_error("SPECGRID\n 1000 1000 1000 /\nZCORN\n 8000000000*1 /\n", 3, "ZCORN", "for files of this size");
  expect_error("SPECGRID\n 1000 1000 1000 /\nEQUALS\n PORO 0.2 /\n/\n", 4, "EQUALS", "for files of this size");
}

TEST(CaseErrors, OperationsWithoutEnd) {
  std::string text = "SPECGRID\n 100 100 100 /\nEQUALS\n";
  for (int n = 0; n < 100'000; ++n) text += "PORO 1 /\n";
  MemoryFiles files({{"case", text + "/\n"}});
  DeckLimits limits;
  limits.free_steps = 100'000'000;
  const auto error = error_of([&] { return parse_case(files, "case", {}, limits); });
  ASSERT_TRUE(error);
  EXPECT_EQ(error->where().line, 3 + 101) << "100 records of 10^6 cells are allowed";
}

TEST(CaseErrors, UnknownOptions) {
  expect_error(grid + "PINCH\n 0.1 MAYBE /\n", next_line + 1, "PINCH", "GAP or NOGAP as item 2");
  expect_error(grid + "GRIDUNIT\n YARDS /\n", next_line + 1, "GRIDUNIT", "METRES, FEET or CM");
  expect_error("SPECGRID\n 1 1 1 1 Q /\n", 2, "SPECGRID", "T or F as item 5");
}

TEST(CaseErrors, GridsThatAreNotRead) {
  expect_error("SPECGRID\n 1 1 1 1 T /\n", 2, "SPECGRID", "radial grids are not read");
  expect_error("SPECGRID\n 1 1 1 2 F /\n", 2, "SPECGRID", "one reservoir");
  expect_error(grid + "CARFIN\n 'L' 1 1 1 1 1 1 2 2 2 /\n", next_line, "CARFIN", "a local grid refinement");
  expect_error("RUNSPEC\nDUALPORO\n", 2, "DUALPORO", "a dual medium");
  expect_error("RUNSPEC\nRADIAL\n", 2, "RADIAL", "a radial grid");
  expect_error(grid + "IMPORT\n 'g.bin' /\n", next_line, "IMPORT", "a grid from a binary file");
}

TEST(CaseErrors, Includes) {
  const auto loop =
      error_in(grid + "INCLUDE\n 'a' /\n", {{"a", "NOECHO\nINCLUDE\n 'b' /\n"}, {"b", "INCLUDE 'a' /\n"}});
  ASSERT_TRUE(loop);
  EXPECT_EQ(loop->where().file, "b");
  EXPECT_EQ(loop->where().line, 1);
  EXPECT_EQ(loop->where().keyword, "INCLUDE");
  EXPECT_NE(std::string(loop->what()).find("'a' including itself"), std::string::npos);
  expect_error(grid + "INCLUDE\n 'none.inc' /\n", next_line + 1, "INCLUDE", "none named 'none.inc'");
  expect_error(grid + "INCLUDE\n /\n", next_line + 1, "INCLUDE", "the name of a file");
  expect_error(grid + "INCLUDE\n '$GONE/x' /\n", next_line + 1, "INCLUDE", "a name given by PATHS");
}

TEST(CaseErrors, DeepIncludes) {
  std::map<std::string, std::string> files;
  for (int n = 0; n < 100; ++n) files["f" + std::to_string(n)] = "INCLUDE\n f" + std::to_string(n + 1) + " /\n";
  const auto error = error_in("INCLUDE\n f0 /\n", files);
  ASSERT_TRUE(error);
  EXPECT_NE(std::string(error->what()).find("at most 32 files inside each other"), std::string::npos);
}

TEST(CaseErrors, IncludesThatMultiply) {
  // Each file includes the next one three times: 3^20 files, stopped by their count.
  std::map<std::string, std::string> files;
  for (int n = 0; n < 20; ++n) {
    std::string& text = files["f" + std::to_string(n)];
    for (int m = 0; m < 3; ++m) text += "INCLUDE\n f" + std::to_string(n + 1) + " /\n";
  }
  files["f20"] = "";
  const auto error = error_in("INCLUDE\n f0 /\n", files);
  ASSERT_TRUE(error);
  EXPECT_NE(std::string(error->what()).find("INCLUDEs"), std::string::npos);
}

TEST(CaseErrors, FormOfTheDeck) {
  expect_error(grid + "PORO\n 0.2 /\n 0.3 /\n", next_line + 2, "PORO", "expected a keyword, found '0.3'");
  expect_error("MD,X,Y,TVD\n", 1, "", "expected a keyword, found 'MD,X,Y,TVD'");
  expect_error(grid + "MAPAXES\n 'x /\n", next_line + 1, "MAPAXES", "a closing quote");
  expect_error(grid + "SKIP\nPORO\n", next_line, "SKIP", "ENDSKIP");
  expect_error(std::string("SPECGRID\n\0", 10), 0, "", "binary data");
}

TEST(CaseErrors, ListsWithoutTheirEnd) {
  expect_error(grid + "EQUALS\n PORO 0.2 /\nNTG\n 1 /\n", next_line + 2, "EQUALS",
               "a '/' that ends the records of EQUALS, found the keyword 'NTG'");
  expect_error(grid + "FAULTS\n 'F' 1 1 1 1 1 1 X /\nPORO\n 1 /\n", next_line + 2, "FAULTS",
               "found the keyword 'PORO'");
}

TEST(CaseErrors, BoxesAndOperations) {
  expect_error(grid + "BOX\n 1 2 1 1 1 1 /\n", next_line + 1, "BOX", "a box within 1 and 1 along I, found 1 to 2");
  expect_error(grid + "EQUALS\n PORO 0.2 1 1 0 1 /\n/\n", next_line + 1, "EQUALS", "along J, found 0 to 1");
  expect_error(grid + "EQUALS\n PORO /\n/\n", next_line + 1, "EQUALS", "a second item");
  expect_error(grid + "EQUALS\n SATNUM 1.5 /\n/\n", next_line + 1, "EQUALS", "an integer for SATNUM");
  expect_error(grid + "MULTIPLY\n PERMX 2 /\n/\n", next_line + 1, "MULTIPLY", "the array PERMX before it");
  expect_error(grid + "COPY\n PERMX PERMY /\n/\n", next_line + 1, "COPY", "the array PERMX before it");
  expect_error(grid + "COPY\n SATNUM SWAT /\n/\n", next_line + 1, "COPY", "two arrays of one kind");
  expect_error(grid + "EQUALS\n PORO 1 1 1 1 1 1 1 1 /\n/\n", next_line + 1, "EQUALS", "at most 8 items");
}

TEST(CaseErrors, ValuesThatCannotBe) {
  expect_error(grid + "PORO\n -0.1 /\n", next_line, "PORO", "-0.1 for cell 1 1 1");
  expect_error(grid + "PORO\n 0.1 /\nADD\n PORO -1 /\n/\n", next_line + 3, "ADD", "for cell 1 1 1");
  expect_error(grid + "ACTNUM\n 2 /\n", next_line, "ACTNUM", "0 or 1 for every cell");
  expect_error(grid + "PORO\n 1* /\n", next_line, "PORO", "none for cell 1 1 1");
  expect_error(grid + "EQUALS\n PERMX 1E300 /\n/\nMULTIPLY\n PERMX 1E300 /\n/\n", next_line + 4, "MULTIPLY",
               "a value of 0 or more");
  expect_error("SPECGRID\n 1 1 1 /\nCOORD\n 24* /\n", 3, "COORD", "this keyword has no defaults");
}

TEST(CaseErrors, BlockCentredGridWithoutPillars) {
  expect_error("DIMENS\n 1 1 2 /\nDX\n 10 20 /\nDY\n 2*1 /\nDZ\n 2*1 /\nTOPS\n 0 /\n", 0, "DX",
               "write the grid as COORD and ZCORN");
}

TEST(CaseErrors, ErrorInAnIncludedFileNamesIt) {
  const auto error = error_in(grid + "INCLUDE\n p.inc /\n", {{"p.inc", "PORO\n\n abc /\n"}});
  ASSERT_TRUE(error);
  EXPECT_STREQ(error->what(), "p.inc:3: PORO: expected a number, found 'abc'");
}

}  // namespace
}  // namespace wellknit
