// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// Broken binary, formatted and ROFF files: each with the line that the user gets.
#include <gtest/gtest.h>

#include <functional>

#include "tests/readers/ecl_files.h"
#include "tests/readers/reader_helpers.h"

namespace wellknit {
namespace {

std::string sample(const std::string& name) {
  return std::string(load_file(std::string(WELLKNIT_TESTDATA) + "/" + name).text);
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const auto at = text.find(from);
  if (at == std::string::npos) throw std::logic_error("the sample has no " + from);
  return text.replace(at, from.size(), to);
}

std::vector<std::int32_t> with(std::vector<std::int32_t> values, std::size_t item, std::int32_t value) {
  values.at(item) = value;
  return values;
}

/// An INIT head for the two boxes of ecl_files.h.
std::vector<std::int32_t> init_head() {
  std::vector<std::int32_t> head(100, 0);
  head[2] = 1;
  head[8] = 2;
  head[9] = head[10] = 1;
  head[11] = 2;
  return head;
}

struct Broken {
  std::string what;
  std::string content;
  std::string line;  ///< of error, after the file's name
};

class BrokenGrids : public ::testing::TestWithParam<Broken> {};

TEST_P(BrokenGrids, EndInOneLine) {
  const auto error = error_in(GetParam().content);
  ASSERT_TRUE(error) << GetParam().what;
  EXPECT_EQ(std::string(error->what()), "case.GRDECL" + GetParam().line) << GetParam().what;
}

std::vector<Broken> broken_records() {
  const std::string whole = ecl::two_boxes();
  const std::string heads = ecl::two_heads();
  const auto file_head = [](std::size_t item, std::int32_t value) {
    return ecl::inte("FILEHEAD", with(ecl::file_head(), item, value)) + ecl::inte("GRIDHEAD", ecl::grid_head(2, 1, 1));
  };
  const auto grid_head = [](std::size_t item, std::int32_t value) {
    return ecl::inte("FILEHEAD", ecl::file_head()) + ecl::inte("GRIDHEAD", with(ecl::grid_head(2, 1, 1), item, value));
  };
  // FILEHEAD and GRIDHEAD take 24 + 8 + 400 bytes each: COORD begins at 864, its block at 888.
  return {
      {"cut in a header", whole.substr(0, 870),
       ": expected the header of an array (24 bytes), found 6 bytes before the end of the file at byte 864; the file "
       "is "
       "cut: copy it again, in binary mode"},
      {"cut in a block", whole.substr(0, 1000),
       ": COORD: expected 36 values of 4 bytes, found 112 bytes left at byte 864; the file is cut or damaged: copy it "
       "again, in binary mode"},
      {"cut between blocks", (heads + ecl::array("COORD", "REAL", ecl::two_coord(), 1)).substr(0, 888 + 20 * 12),
       ": COORD: expected 36 values, found the end of the file 16 values before at byte 1128; the file is cut: copy it "
       "again, in binary mode"},
      {"cut between arrays", heads + ecl::real("COORD", ecl::two_coord()),
       ": ZCORN: expected ZCORN in a grid file, found the end of the file after 'COORD'; the file is cut: copy it "
       "again, "
       "in binary mode"},
      {"bytes after the end", whole + "xx",
       ": expected the header of an array (24 bytes), found 2 bytes before the end of the file at byte 1136; the file "
       "is "
       "cut: copy it again, in binary mode"},
      {"line ends changed by a transfer as text",
       replaced(whole, std::string("\0\0\0\x10GRIDHEAD", 12), "\r\n\0\x10GRIDHEAD"),
       ": expected the header of an array, 16 bytes long, found one of 218759168 and 65536 bytes at byte 432; the "
       "file is damaged: copy it again, in binary mode"},
      {"a block of another length",
       replaced(whole, ecl::big_endian<std::int32_t>(144), ecl::big_endian<std::int32_t>(143)),
       ": COORD: expected a block of at most 144 bytes between two equal lengths, found the length 143 at byte 888; "
       "the "
       "file is damaged: copy it again, in binary mode"},
      {"a count beyond the file", heads + ecl::header("COORD", 1'000'000'000, "REAL"),
       ": COORD: expected 1000000000 values of 4 bytes, found 0 bytes left at byte 864; the file is cut or damaged: "
       "copy "
       "it again, in binary mode"},
      {"a negative count", heads + ecl::header("COORD", -5, "REAL"),
       ": COORD: expected -5 values of 4 bytes, found 0 bytes left at byte 864; the file is cut or damaged: copy it "
       "again, in binary mode"},
      {"an unknown type", heads + ecl::header("COORD", 1, "REEL"),
       ": COORD: expected one of the types INTE, REAL, DOUB, LOGI, CHAR, C0nn or MESS, found 'REEL' at byte 864; the "
       "file "
       "is damaged, or of another kind"},
      {"texts in place of numbers", heads + ecl::text("COORD", std::vector<std::string>(36, "A")),
       ": COORD: expected numbers (INTE, REAL or DOUB), found another type at byte 864; the file is damaged, or of "
       "another kind"},
      {"COORD of another grid", heads + ecl::real("COORD", std::vector<float>(24)),
       ": COORD: expected 36 values, found 24 at byte 864; the file is damaged, or its dimensions are those of another "
       "grid"},
      {"a value that is no number",
       heads + ecl::real("COORD", ecl::two_coord()) +
           ecl::array<std::int32_t>("ZCORN", "REAL", with(std::vector<std::int32_t>(16, 0), 3, 0x7FC00000)),
       ": ZCORN: expected finite numbers, found one that is not finite at byte 1040; the file is damaged, or its "
       "writer "
       "failed"},
      {"dimensions of nothing",
       ecl::inte("FILEHEAD", ecl::file_head()) + ecl::inte("GRIDHEAD", ecl::grid_head(0, 1, 1)),
       ": GRIDHEAD: expected three numbers of cells of 1 or more, 2000000000 cells in all at most, found 0 1 1 at byte "
       "432; the file is damaged"},
      {"dimensions that overflow",
       ecl::inte("FILEHEAD", ecl::file_head()) + ecl::inte("GRIDHEAD", ecl::grid_head(2147483647, 2147483647, 2)),
       ": GRIDHEAD: expected three numbers of cells of 1 or more, 2000000000 cells in all at most, found 2147483647 "
       "2147483647 2 at byte 432; the file is damaged"},
      {"an unstructured grid", file_head(4, 1),
       ": FILEHEAD: expected a corner-point grid (0 as item 5), found 1 at byte 0; unstructured and hybrid grids are "
       "not "
       "read; export a corner-point grid"},
      {"a dual medium", file_head(5, 1),
       ": FILEHEAD: expected one medium (0 as item 6), found a dual medium (matrix and fractures) at byte 0; not read; "
       "export the matrix or the fractures as a grid of its own"},
      {"a dual medium by ACTNUM", whole + ecl::inte("ACTNUM", {1, 3}),
       ": ACTNUM: expected 0 or 1 for every cell, found 3: a dual medium (matrix and fractures) at byte 1136; not "
       "read; "
       "export the matrix or the fractures as a grid of its own"},
      {"ACTNUM of another value", whole + ecl::inte("ACTNUM", {1, 7}),
       ": ACTNUM: expected 0 or 1 for every cell, found 7 for cell 2 1 1"},
      {"a grid that is not of corner points", grid_head(0, 2),
       ": GRIDHEAD: expected a corner-point grid (1 as item 1), found 2 at byte 432; composite and unstructured grids "
       "are "
       "not read; export a corner-point grid"},
      {"a radial grid", grid_head(26, 1),
       ": GRIDHEAD: expected Cartesian coordinates (0 as item 27), found cylindrical ones at byte 432; radial grids "
       "are "
       "not read"},
      {"two reservoirs", grid_head(24, 2),
       ": GRIDHEAD: expected one reservoir (item 25), found 2 at byte 432; split the reservoirs"},
      {"a local refinement", whole + ecl::inte("ENDGRID", {}) + ecl::text("LGR", {"WELL"}),
       ": LGR: expected a single grid without local refinements (LGR), found 'LGR' at byte 1160; run or export the "
       "case "
       "without its LGRs; wellknit makes the mesh around wells itself"},
      {"an unknown unit", heads + ecl::text("GRIDUNIT", {"YARDS"}),
       ": GRIDUNIT: expected METRES, FEET or CM, found 'YARDS' at byte 864"},
      {"ZCORN before GRIDHEAD", ecl::inte("FILEHEAD", ecl::file_head()) + ecl::real("ZCORN", ecl::two_zcorn()),
       ": ZCORN: expected GRIDHEAD before it, found none at byte 432; the file is damaged"},
      {"a restart file", ecl::inte("SEQNUM", {1}),
       ": expected a deck or a GRDECL file (text), found a file in the format Eclipse restart; it holds no grid; give "
       "the "
       "EGRID file of the same run"},
      {"a restart file of one step", ecl::inte("INTEHEAD", init_head()) + ecl::header("STARTSOL", 0, "MESS"),
       ": STARTSOL: expected an INIT file (static properties), found a restart or summary file at byte 432; give "
       "CASE.INIT"},
      {"INIT without its grid", ecl::inte("INTEHEAD", init_head()) + ecl::real("PORO", {0.2F, 0.2F}),
       ": COORD: expected COORD and ZCORN, or DX, DY, DZ and TOPS, found no geometry; include the file that holds the "
       "geometry"},
      {"INIT with arrays of another length", ecl::inte("INTEHEAD", init_head()) + ecl::real("PORO", {0.2F}),
       ": PORO: expected 2 values (active cells) or 2 (all cells), found 1 at byte 432; the file is damaged"},
      {"GRIDUNIT without a text", heads + ecl::text("GRIDUNIT", {}),
       ": GRIDUNIT: expected METRES, FEET or CM, found no text at byte 864"},
      {"GRIDUNIT of numbers", heads + ecl::inte("GRIDUNIT", {1}),
       ": GRIDUNIT: expected texts (CHAR), found numbers at byte 864; the file is damaged, or of another kind"},
      {"ACTNUM with a fraction", whole + ecl::real("ACTNUM", {1.0F, 0.5F}),
       ": ACTNUM: expected integers, found a number with a fraction at byte 1136"},
      {"X231 of another array", heads + ecl::header("COORD", -1, "X231") + ecl::header("ZCORN", 1, "REAL"),
       ": COORD: expected X231 and the same name again, found 'ZCORN' at byte 864; the file is damaged"},
      {"a second INTEHEAD", ecl::inte("INTEHEAD", init_head()) + ecl::inte("INTEHEAD", init_head()),
       ": INTEHEAD: expected one INTEHEAD, found a second one at byte 432; is this a restart file? give CASE.INIT"},
      {"INIT in PVT-M", ecl::inte("INTEHEAD", with(init_head(), 2, 4)),
       ": INTEHEAD: expected METRIC, FIELD or LAB (1, 2 or 3 as item 3), found 4 at byte 0; the unit system PVT-M is "
       "not "
       "read"},
  };
}

std::vector<Broken> broken_grid_files() {
  std::vector<float> corners;
  for (const float z : {0.0F, 1.0F})
    for (const float y : {0.0F, 1.0F})
      for (const float x : {0.0F, 1.0F}) corners.insert(corners.end(), {x, y, z});
  std::vector<float> beside = corners;
  for (std::size_t n = 0; n < beside.size(); n += 3) beside[n] += 1.5F;
  const std::string dimens = ecl::inte("DIMENS", {2, 1, 1});
  const std::string first = ecl::inte("COORDS", {1, 1, 1, 1, 1}) + ecl::real("CORNERS", corners);
  return {
      {"cells that do not share pillars",
       dimens + first + ecl::inte("COORDS", {2, 1, 1, 2, 1}) + ecl::real("CORNERS", beside),
       ": CORNERS: expected corners on straight pillars, found a corner of cell 2 1 1 0.5 beside pillar 2 1 at byte "
       "276; "
       "this is no corner-point grid; export it as EGRID or GRDECL"},
      {"a cell outside", dimens + ecl::inte("COORDS", {3, 1, 1, 1, 1}) + ecl::real("CORNERS", corners),
       ": COORDS: expected a cell within 2 1 1, found 3 1 1 at byte 44; the file is damaged"},
      {"COORDS without CORNERS", dimens + first + ecl::inte("COORDS", {2, 1, 1, 2, 1}),
       ": CORNERS: expected CORNERS after COORDS, found the end of the file; the file is cut: copy it again, in binary "
       "mode"},
      {"CORNERS without COORDS", dimens + ecl::real("CORNERS", corners),
       ": CORNERS: expected COORDS before it, found none at byte 44; the file is damaged"},
      {"dimensions out of proportion", ecl::inte("DIMENS", {1000, 1000, 100}) + first,
       ": DIMENS: expected dimensions for a file of 1 cells, found 1000 1000 100; write all cells (GRIDFILE 2), or an "
       "EGRID file"},
      {"a radial grid file", dimens + ecl::text("RADIAL", {"TRUE"}),
       ": RADIAL: expected Cartesian coordinates (RADIAL FALSE), found a radial grid at byte 44; radial grids are not "
       "read"},
      {"a coarsened cell", dimens + ecl::inte("COORDS", {1, 1, 1, 1, 1, 0, 4}),
       ": COORDS: expected a grid without coarsened cells (0 as item 7), found 4 at byte 44; export the grid before "
       "its "
       "coarsening"},
  };
}

std::vector<Broken> broken_formatted() {
  const std::string text = sample("ecl/fault.FEGRID");
  return {
      {"text in a number", replaced(text, "4.60008000E+05", "4.600z8000E+05"),
       ":45: COORD: expected finite numbers, found '4.600z8000E+05'; the file is damaged"},
      {"a value too many", replaced(text, " 'COORDSYS'", " 1.0\n 'COORDSYS'"),
       ":63: COORD: expected 72 values, found more; the file is damaged"},
      {"a value too few", replaced(text, "  4.60008000E+05", ""),
       ":44: COORD: expected 72 values, found 71; the file is cut or damaged"},
      {"a header that is none", replaced(text, "'GRIDHEAD'         100", "'GRIDHEAD'         1oo"),
       ":26: expected the header of an array: 'NAME' count 'TYPE', found ''GRIDHEAD'         1oo 'INTE''; the file is "
       "damaged, or of another kind"},
      {"a count beyond the file", replaced(text, "'COORD   '          72", "'COORD   '  1000000072"),
       ":44: COORD: expected 1000000072 values, found 4384 characters left; the file is cut or damaged: copy it again"},
      {"texts that end before", " 'DIMENS  ' 3 'INTE'\n 1 1 1\n 'MAPUNITS' 2 'CHAR'\n 'METRES  '\n",
       ":4: MAPUNITS: expected 2 texts in quotes, found 1; the file is cut or damaged"},
  };
}

std::vector<Broken> broken_roff() {
  const std::string text = sample("roff/grid.roffasc");
  const std::string binary = sample("roff/grid.roff");
  const std::string rock = sample("roff/rock.roffasc");
  return {
      {"another byteswaptest",
       replaced(binary, std::string("byteswaptest\0\1\0\0\0", 17), std::string("byteswaptest\0\2\0\0\0", 17)),
       ": filedata.byteswaptest: expected the integer 1, in either byte order, found another value at byte 76; the "
       "file "
       "is damaged"},
      {"two byte orders",
       replaced(binary, std::string("int\0byteswaptest\0\1\0\0\0", 21),
                std::string("int\0byteswaptest\0\1\0\0\0int\0byteswaptest\0\0\0\0\1", 42)),
       ": filedata.byteswaptest: expected one byte order, found another one than before at byte 97; the file is cut or "
       "damaged: copy it again, in binary mode"},
      {"a byte order that is not said", replaced(binary, std::string("int\0byteswaptest\0\1\0\0\0", 21), std::string()),
       ": dimensions.nX: expected filedata.byteswaptest before any number, found none at byte 202; the file's byte "
       "order is unknown"},
      {"ROFF cut in its data", binary.substr(0, 700),
       ": cornerLines.data: expected 72 values, found 211 bytes left at byte 474; the file is cut or damaged: copy it "
       "again, in binary mode"},
      {"ROFF without its end", replaced(text, "tag eof\nendtag\n", ""),
       ":82: expected a tag, or the tag eof, found the end of the file; the file is cut or damaged: copy it again, in "
       "binary mode"},
      {"a split that is none", replaced(text, "array byte splitEnz 48\n1", "array byte splitEnz 48\n3"),
       ":48: zvalues.splitEnz: expected 1, 2, 4 or 8 depths for every node, found 3; the file is damaged"},
      {"splits that do not fit", replaced(text, "array byte splitEnz 48\n1", "array byte splitEnz 48\n2"),
       ":57: zvalues.data: expected 106 values, found 105; the file is damaged, or its dimensions are those of another "
       "grid"},
      {"layers that do not fit", replaced(text, "1 2\nendtag", "1 3\nendtag"),
       ":29: subgrids.nLayers: expected 3 layers in all subgrids, as nZ, found 4; the file is damaged"},
      {"ROFF without dimensions", replaced(text, "int nZ 3\n", ""),
       ": dimensions: expected nX, nY and nZ of 1 or more, 2000000000 cells in all at most, found 3 2 0; the file is "
       "damaged, or holds no grid"},
      {"an unknown type", replaced(text, "int nZ 3", "long nZ 3"),
       ":16: dimensions: expected a type (bool, byte, char, int, float, double), array or endtag, found 'long'; the "
       "file "
       "is cut or damaged: copy it again, in binary mode"},
      {"a surface", replaced(text, "\"grid\"", "\"surface\""),
       ":6: filedata.filetype: expected a grid or a parameter, found 'surface'; surfaces and wells are not read from "
       "ROFF"},
      {"a parameter without a name", replaced(rock, "char name \"PORO\"\n", ""),
       ":19: parameter.data: expected the parameter's name before its data, found none; the file is damaged"},
      {"a parameter of another grid", replaced(rock, "int nX 3", "int nX 4"),
       ":20: parameter.data: expected 24 values, found 18; the file is damaged, or its dimensions are those of another "
       "grid"},
      {"a region with a fraction",
       replaced(replaced(rock, "array byte data 18", "array float data 18"), "1 1 1 2 2 2", "1 1 1 2.5 2 2"),
       ":42: parameter.data: expected integers, found '2.5'; the file is damaged"},
      {"a scale beyond all numbers", replaced(text, "float zscale -1.0", "float zscale 1e308"),
       ":33: cornerLines.data: expected coordinates that are finite when moved and scaled, found one that overflows; "
       "the "
       "file is damaged"},
      {"texts for depths", replaced(text, "array float data 105", "array char data 105"),
       ":57: zvalues.data: expected numbers, found texts (char); the file is damaged, or of another kind"},
      {"a number for the file's kind", replaced(text, "char filetype \"grid\"", "int filetype 1"),
       ":6: filedata.filetype: expected a text (char), found numbers; the file is damaged, or of another kind"},
      {"a scale of nothing", replaced(text, "float zscale -1.0", "float zscale 0"),
       ":26: scale.zscale: expected a scale that is not 0, found 0; the file is damaged"},
  };
}

INSTANTIATE_TEST_SUITE_P(Records, BrokenGrids, ::testing::ValuesIn(broken_records()));
INSTANTIATE_TEST_SUITE_P(GridFiles, BrokenGrids, ::testing::ValuesIn(broken_grid_files()));
INSTANTIATE_TEST_SUITE_P(Formatted, BrokenGrids, ::testing::ValuesIn(broken_formatted()));
INSTANTIATE_TEST_SUITE_P(Roff, BrokenGrids, ::testing::ValuesIn(broken_roff()));

TEST(BinaryGrids, FilesOfDifferentGridsAreRefused) {
  MemoryFiles files({{"a", ecl::two_boxes()}, {"b", sample("roff/rock.roff")}});
  const auto error = error_of([&] { return parse_case(files, "a", {"b"}); });
  ASSERT_TRUE(error);
  EXPECT_STREQ(
      error->what(),
      "b: DIMENS: expected the dimensions given before, 2 1 1, found 3 2 3; the files belong to different grids");
}

TEST(BinaryGrids, InitThatDoesNotFitActnumIsRefused) {
  auto head = init_head();
  head[11] = 1;
  MemoryFiles files({{"a", ecl::two_boxes()}, {"b", ecl::inte("INTEHEAD", head) + ecl::real("PORO", {0.2F})}});
  const auto error = error_of([&] { return parse_case(files, "a", {"b"}); });
  ASSERT_TRUE(error);
  EXPECT_STREQ(error->what(),
               "b: PORO: expected 2 values, one a cell, found 1; give it with the EGRID file of the same run");
}

TEST(BinaryGrids, AreNoFilesToInclude) {
  const auto error = error_in("INCLUDE\n 'a.EGRID' /\n", {{"a.EGRID", ecl::two_boxes()}});
  ASSERT_TRUE(error);
  EXPECT_STREQ(
      error->what(),
      "a.EGRID: INCLUDE: expected a deck or a GRDECL file (text), found a file in the format EGRID; INCLUDE takes "
      "text; give this file by itself, as CASE or with --grid-include");
}

}  // namespace
}  // namespace wellknit
