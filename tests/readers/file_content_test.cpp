// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "readers/file_content.h"

#include <gtest/gtest.h>

#include "model/errors.h"
#include "tests/readers/reader_helpers.h"
#include "tests/support/scratch_folder.h"

namespace wellknit {
namespace {

TEST(FileContent, HashIsThatOfTheStandard) {
  // FIPS 180-4's example for "abc", and the well-known value of no bytes.
  EXPECT_EQ(sha256_hex("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(sha256_hex(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
}

TEST(FileContent, NamesAreFoundInAnotherCase) {
  const ScratchFolder folder;
  std::filesystem::create_directory(folder.path() / "Include");
  folder.write("Include/Grid.INC", "text");
  EXPECT_EQ(load_file(folder.file("include/GRID.inc")).text, "text");
  EXPECT_EQ(load_file(folder.file("include/GRID.inc")).path, folder.file("Include/Grid.INC"));
}

TEST(FileContent, ExactNameIsPreferred) {
  const ScratchFolder folder;
  folder.write("a.inc", "lower");
  folder.write("A.inc", "upper");
  EXPECT_EQ(load_file(folder.file("A.inc")).text, "upper");
}

TEST(FileContent, MissingFileAndFolderAreErrors) {
  const ScratchFolder folder;
  const auto missing = error_of([&] { return load_file(folder.file("no.inc")); });
  ASSERT_TRUE(missing);
  EXPECT_EQ(missing->where().file, folder.file("no.inc"));
  EXPECT_EQ(missing->where().line, 0);
  EXPECT_TRUE(error_of([&] { return load_file(folder.path().string()); }));
}

}  // namespace
}  // namespace wellknit
