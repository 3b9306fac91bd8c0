// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "readers/formats.h"

#include <gtest/gtest.h>

#include <set>

#include "tests/readers/reader_helpers.h"
#include "tests/support/scratch_folder.h"

namespace wellknit {
namespace {

std::string_view name_of(const std::string& path, std::string_view text) {
  const ReaderFormat* format = recognise(path, text);
  return format == nullptr ? "none" : format->name;
}

/// The first bytes of an Eclipse output file: a record of 16 bytes with this name of 8 characters.
std::string record(const char* name) {
  return std::string("\0\0\0\x10", 4) + name + std::string("\0\0\0\x64INTE\0\0\0\x10", 12);
}

TEST(Formats, AreRecognisedByContentWhateverTheirNames) {
  EXPECT_EQ(name_of("x", "\x89HDF\r\n\x1a\n..."), "wellknit mesh");
  EXPECT_EQ(name_of("x", record("FILEHEAD")), "EGRID");
  EXPECT_EQ(name_of("x", record("INTEHEAD")), "Eclipse INIT");
  EXPECT_EQ(name_of("x", record("DIMENS  ")), "Eclipse GRID");
  EXPECT_EQ(name_of("x", record("SEQNUM  ")), "Eclipse restart");
  EXPECT_EQ(name_of("x", record("SPECGRID")), "binary GRDECL");
  EXPECT_EQ(name_of("x", " 'FILEHEAD'         100 'INTE'\n"), "EGRID");
  EXPECT_EQ(name_of("x", std::string("\x10\0\0\0FILEHEAD", 12)), "EGRID") << "little-endian";
  EXPECT_EQ(name_of("x", std::string("roff-bin\0", 9)), "ROFF");
  EXPECT_EQ(name_of("x", "PK\x03\x04"), "RESQML");
  EXPECT_EQ(name_of("x", "# WELL TRACE FROM PETREL\n"), "Petrel well trace");
  EXPECT_EQ(name_of("x", "1.0\nPlanned\nW 0 0\n0\n0 0 0\n"), "RMS well");
  EXPECT_EQ(name_of("x", "md;x;y;tvd\n"), "trajectory CSV");
  EXPECT_EQ(name_of("x", "# head 1 2 3\nMD,INCL,AZIM\n"), "trajectory CSV");
  EXPECT_EQ(name_of("x", "X Y TVD MD\nName W\n0 0 0 0\n"), "ResInsight .dev") << "a heading is no CSV";
  EXPECT_EQ(name_of("x", "{\"name\":\"A\",\"path\":[]}"), "ResInsight JSON");
  EXPECT_EQ(name_of("x", "# made by\n~Version Information\n"), "LAS deviation");
  EXPECT_EQ(name_of("x", "<?xml version=\"1.0\"?>\n<trajectorys xmlns=\"http://www.witsml.org\">"),
            "WITSML trajectory");
  EXPECT_EQ(name_of("x", "\x1B[?1034h1.0\nPlanned\nW 0 0\n0\n0 0 0\n"), "RMS well");
  EXPECT_EQ(name_of("x", "WELLNAME: 'A'\n"), "ResInsight .dev");
  EXPECT_EQ(name_of("x", "# X Y TVDMSL MDMSL\n1 2 3 4\n"), "ResInsight .dev") << "a comment is no header here";
  EXPECT_EQ(name_of("x", "-- deck\nRUNSPEC\n"), "Eclipse deck");
  EXPECT_EQ(name_of("x", "-- grid\nspecgrid\n 1 1 1 /\n"), "GRDECL");
}

TEST(Formats, ExtensionDecidesWhereTheContentDoesNot) {
  EXPECT_EQ(name_of("a/b.CSV", ""), "trajectory CSV");
  EXPECT_EQ(name_of("a.b/c", ""), "none");
  EXPECT_EQ(name_of("x.h5", "not HDF5"), "none") << "a binary format has its signature";
}

TEST(Formats, TableIsWhole) {
  std::set<std::string_view> names;
  for (const ReaderFormat& format : reader_formats()) {
    EXPECT_TRUE(names.insert(format.name).second) << format.name;
    EXPECT_FALSE(format.description.empty());
    EXPECT_FALSE(format.content.empty());
    EXPECT_NE(format.recognises, nullptr);
    const bool is_deck = format.name == "Eclipse deck" || format.name == "GRDECL";
    EXPECT_EQ(format.read_grid != nullptr, format.is_read && format.kind == FormatKind::grid && !is_deck)
        << format.name;
    EXPECT_EQ(format.read_wells != nullptr, format.is_read && format.kind == FormatKind::wells) << format.name;
    for (const std::string_view extension : format.extensions) EXPECT_EQ(extension.front(), '.');
  }
}

TEST(Formats, NoContentIsTooShort) {
  for (const ReaderFormat& format : reader_formats())
    for (const char* text : {"", "\n", "\0", "'", "1", "PK", "#"})
      EXPECT_NO_THROW((void)format.recognises(text)) << format.name;
}

TEST(Formats, WhatIsNotReadIsRefusedWithAdvice) {
  const ScratchFolder folder;
  folder.write("A.EPC", "PK\x03\x04");
  folder.write("A.UNRST", record("SEQNUM  "));
  folder.write("empty.DATA2", "");
  const auto error = error_of([&] { return recognise_file(folder.file("A.EPC")).name; });
  ASSERT_TRUE(error);
  EXPECT_NE(std::string(error->what()).find("a file in the format RESQML; not read yet; export the grid as EGRID"),
            std::string::npos);
  const auto restart = error_of([&] { return recognise_file(folder.file("A.UNRST")).name; });
  ASSERT_TRUE(restart);
  EXPECT_NE(std::string(restart->what()).find("give the EGRID file of the same run"), std::string::npos);
  EXPECT_TRUE(error_of([&] { return recognise_file(folder.file("empty.DATA2")).name; }));
  EXPECT_TRUE(error_of([&] { return recognise_file(folder.file("missing")).name; }));
  const auto as_case = error_in("PK\x03\x04");
  ASSERT_TRUE(as_case);
  EXPECT_NE(std::string(as_case->what()).find("not read yet"), std::string::npos);
}

}  // namespace
}  // namespace wellknit
