// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// Faults in a deck: each is a ParseError with its file, line and keyword.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>
#include <string>
#include <vector>

#include "readers/file_content.h"
#include "readers/read_case.h"
#include "tests/readers/reader_helpers.h"
#include "tests/support/random_seed.h"

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

/// Every file under testdata/grdecl/deck and beside it that stands for itself.
const std::vector<std::string> samples{"box.GRDECL", "CONNECTIONS.DATA", "deck/BOX.DATA"};

std::map<std::string, std::string> sample_with_includes(const std::string& name) {
  const std::string folder = std::string(WELLKNIT_TESTDATA) + "/grdecl/";
  std::map<std::string, std::string> files;
  files["case"] = load_file(folder + name).text;
  if (name == "deck/BOX.DATA") {
    files["geometry.inc"] = load_file(folder + "deck/geometry.inc").text;
    files["include/rock.inc"] = load_file(folder + "deck/include/Rock.inc").text;
  }
  return files;
}

/// A grid that holds together, or a ParseError; anything else fails the test.
void read_damaged(std::map<std::string, std::string> files, const std::string& what) {
  MemoryFiles store(std::move(files));
  DeckLimits limits;
  limits.free_values = 1'000'000;
  limits.free_steps = 10'000'000;
  try {
    validate(parse_case(store, "case", {}, limits).grid);
  } catch (const ParseError& error) {
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << what;
  }
}

TEST(DamagedDecks, CutAtTwoHundredPlaces) {
  for (const std::string& name : samples) {
    const auto files = sample_with_includes(name);
    const std::size_t size = files.at("case").size();
    for (std::size_t n = 0; n < 200; ++n) {
      auto cut = files;
      cut["case"].resize(size * n / 200);
      read_damaged(std::move(cut), name);
    }
  }
}

TEST(DamagedDecks, WithAThousandBytesFlipped) {
  const auto seed = random_seed();
  SCOPED_TRACE("seed " + std::to_string(seed));
  std::mt19937 random(seed);
  for (const std::string& name : samples) {
    const auto files = sample_with_includes(name);
    for (int n = 0; n < 1000; ++n) {
      auto flipped = files;
      std::string& text = flipped["case"];
      char& byte = text[random() % text.size()];
      byte = static_cast<char>(static_cast<unsigned char>(byte) ^ (1U + random() % 255U));
      read_damaged(std::move(flipped), name);
    }
  }
}

/// One kind of fault in what follows the geometry of 2 x 1 x 1 cells, on which line of it, and what the error says.
struct Broken {
  const char* text;
  std::int64_t line;  ///< 1: the first line of the text
  const char* keyword;
  const char* message;
};

std::ostream& operator<<(std::ostream& out, const Broken& broken) { return out << broken.text; }

class BrokenDeck : public ::testing::TestWithParam<Broken> {};

TEST_P(BrokenDeck, IsAnErrorOnItsLine) {
  const std::string geometry = unit_boxes(2, 1, 1);
  const auto before = std::count(geometry.begin(), geometry.end(), '\n');
  const Broken& broken = GetParam();
  expect_error(geometry + broken.text, before + broken.line, broken.keyword, broken.message);
}

INSTANTIATE_TEST_SUITE_P(
    Kinds, BrokenDeck,
    ::testing::Values(
        Broken{"FAULTS\n F 1 1 1 1 1 1 W /\n/\n", 2, "FAULTS", "a face as item 8: X, Y, Z, X-"},
        Broken{"FAULTS\n F 1 1 1 1 1 1 X /\n F 1 1 1 1 1 1 /\n/\n", 3, "FAULTS", "found no item 8"},
        Broken{"FAULTS\n F 1 3 1 1 1 1 X /\n/\n", 2, "FAULTS", "a box within 1 and 2 along I, found 1 to 3"},
        Broken{"FAULTS\n F 1 a 1 1 1 1 X /\n/\n", 2, "FAULTS", "an integer as item 3, found 'a'"},
        Broken{"FAULTS\n F 1 1 1 1 1 1 X 9 /\n/\n", 2, "FAULTS", "at most 8 items in the record"},
        Broken{"MULTFLT\n F /\n/\n", 2, "MULTFLT", "a multiplier of 0 or more as item 2, found none"},
        Broken{"MULTFLT\n F -1 /\n/\n", 2, "MULTFLT", "found '-1'"},
        Broken{"MULTREGT\n 1 2 0.5 XX /\n/\n", 2, "MULTREGT", "X, Y, Z, XY, XZ, YZ or XYZ as item 4, found 'XX'"},
        Broken{"MULTREGT\n 1 2 0.5 XYZ SOME /\n/\n", 2, "MULTREGT", "ALL, NNC, NONNC or NOAQUNNC as item 5"},
        Broken{"MULTREGT\n 1 2 0.5 XYZ ALL Q /\n/\n", 2, "MULTREGT", "M, F or O as item 6, found 'Q'"},
        Broken{"MULTREGT\n 1 2 /\n/\n", 2, "MULTREGT", "as item 3, found none"},
        Broken{"MULTREGP\n 1* 2 /\n/\n", 2, "MULTREGP", "the number of a region as item 1"},
        Broken{"NNC\n 1 1 1 3 1 1 0.1 /\n/\n", 2, "NNC", "I of a cell within 1 and 2 as item 4, found '3'"},
        Broken{"NNC\n 1 1 1 2 0 1 0.1 /\n/\n", 2, "NNC", "J of a cell within 1 and 1 as item 5, found '0'"},
        Broken{"NNC\n 1 1 1 1 1 1 0.1 /\n/\n", 2, "NNC", "two different cells"},
        Broken{"EDITNNC\n 1 1 1 2 1 1 x /\n/\n", 2, "EDITNNC", "a number as item 7, found 'x'"},
        Broken{"EDITNNCR\n 1 1 1 2 1 1 1 /\nPORO\n 2*1 /\n", 3, "EDITNNCR", "a '/' that ends the records of EDITNNCR"},
        Broken{"PINCH\n -1 /\n", 2, "PINCH", "a thickness of 0 or more as item 1"},
        Broken{"PINCH\n 0.1 GAP 1* SOME /\n", 2, "PINCH", "TOPBOT or ALL as item 4, found 'SOME'"},
        Broken{"MINPV\n -2 /\n", 2, "MINPV", "a pore volume of 0 or more"},
        Broken{"MINPVV\n 3*1 /\n", 2, "MINPVV", "expected 2 values"},
        Broken{"MULTX\n 1 -1 /\n", 1, "MULTX", "values of 0 or more, found -1"},
        Broken{"TRANX\n 1 2 3 /\n", 2, "TRANX", "expected 2 values"},
        Broken{"MULTIPLY\n TRANX x /\n/\n", 2, "MULTIPLY", "a number as item 2, found 'x'"},
        Broken{"OPERATE\n SWL 6* SQUARE SWU 1 /\n/\n", 2, "OPERATE", "a function as item 8, found 'SQUARE'"},
        Broken{"OPERATE\n PERMX 6* MULTX PERMY 2 /\n/\n", 2, "OPERATE", "the array PERMY before it"},
        Broken{"SWL\n 0 1 /\nOPERATE\n SWU 6* LOG10 SWL /\n/\n", 4, "OPERATE",
               "a finite result of LOG10, found -inf from 0"},
        Broken{"SWL\n 2*0.5 /\nOPERATER\n SWU 1 COPY SWL /\n/\n", 4, "OPERATER", "the regions OPERNUM before it"},
        Broken{"EQUALREG\n SWL 0.1 1 /\n/\n", 2, "EQUALREG", "the regions FLUXNUM before it"},
        Broken{"EQUALREG\n SWL 0.1 1 Z /\n/\n", 2, "EQUALREG", "F, M or O as item 4, found 'Z'"},
        Broken{"FLUXNUM\n 1 2 /\nADDREG\n SWL 0.1 /\n/\n", 4, "ADDREG", "the number of a region as item 3"},
        Broken{"FLUXNUM\n 1 2 /\nCOPYREG\n FLUXNUM SWL 1 /\n/\n", 4, "COPYREG", "two arrays of one kind"},
        Broken{"GDORIENT\n INC INC INC SIDEWAYS /\n", 2, "GDORIENT", "DOWN or UP as item 4"},
        Broken{"MAPUNITS\n MILES /\n", 2, "MAPUNITS", "METRES, FEET or CM"},
        Broken{"GRIDOPTS\n YES many /\n", 2, "GRIDOPTS", "an integer as item 2"},
        Broken{"NODPPM\n", 1, "NODPPM", "a dual medium (matrix and fractures); write the matrix"},
        Broken{"CARFIN\n L 1 1 1 1 1 1 2 2 2 /\n", 1, "CARFIN", "take the refinements out"},
        Broken{"PERMXX\n 1 PORO\n 2*1 /\n", 2, "PERMXX", "a number, found 'PORO'"},
        Broken{"UNHEARD\n 1 2\nPORO\n 2*1 /\n", 3, "UNHEARD",
               "a '/' that ends the data of UNHEARD, found the keyword 'PORO'"},
        Broken{"UNHEARD\nPORO 2*1 /\n", 2, "UNHEARD", "UNHEARD is not known"},
        Broken{"THPRESFT\n F 1 /\nNTG\n 2*1 /\n", 3, "THPRESFT", "a '/' that ends the records of THPRESFT"}));

}  // namespace
}  // namespace wellknit
