// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "readers/file_content.h"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <filesystem>

#include "model/errors.h"
#include "tests/readers/reader_helpers.h"
#include "tests/support/ordinary_user.h"
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

TEST(FileContent, AFileThatItsUserMayNotReadIsAnError) {
  const ScratchFolder folder;
  folder.write("secret.inc", "text");
  std::filesystem::permissions(folder.path(), std::filesystem::perms::all);
  std::filesystem::permissions(folder.file("secret.inc"), std::filesystem::perms::none);
  EXPECT_EQ(
      refusal_to_ordinary_user([&] { (void)load_file(folder.file("secret.inc")); }),
      folder.file("secret.inc") + ": expected a readable file, found one that cannot be opened; check its permissions");
}

TEST(FileContent, AFileThatMemoryCannotHoldIsAnError) {
#ifdef WELLKNIT_FEW_ROUNDS
  GTEST_SKIP() << "sanitizers take more address space than any limit leaves";
#endif
  const ScratchFolder folder;
  folder.write("large.inc", "text");
  std::filesystem::permissions(folder.path(), std::filesystem::perms::all);
  std::filesystem::resize_file(folder.file("large.inc"), std::uintmax_t{1} << 36U);  // without any block on the disk
  EXPECT_EQ(refusal_to_ordinary_user([&] {
              const rlimit half{rlim_t{1} << 35U, rlim_t{1} << 35U};
              if (::setrlimit(RLIMIT_AS, &half) != 0) throw std::runtime_error("no limit can be set");
              (void)load_file(folder.file("large.inc"));
            }),
            folder.file("large.inc") +
                ": expected a readable file, found one that cannot be mapped into memory; copy the file and try again");
}

}  // namespace
}  // namespace wellknit
