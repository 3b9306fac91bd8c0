// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "writers/output_file.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <filesystem>
#include <fstream>
#include <string_view>
#include <vector>

#include "model/errors.h"
#include "tests/support/ordinary_user.h"
#include "tests/support/scratch_folder.h"

namespace wellknit {
namespace {

std::string message_of(const std::string& path, Overwrite overwrite) {
  try {
    OutputFile file(path, overwrite);
  } catch (const WriteError& error) {
    return error.what();
  }
  return "";
}

void write_text(const std::string& path, const std::string& text, Overwrite overwrite) {
  OutputStream out(path, overwrite);
  out.stream() << text;
  out.commit();
}

TEST(OutputFile, AppearsUnderItsNameOnlyWhenCommitted) {
  const ScratchFolder folder;
  OutputStream out(folder.file("out.txt"), Overwrite::refuse);
  out.stream() << "text";
  EXPECT_FALSE(std::filesystem::exists(folder.file("out.txt")));
  out.commit();
  EXPECT_EQ(folder.read("out.txt"), "text");
  EXPECT_EQ(folder.count(), 1U);
}

TEST(OutputFile, LeavesNothingWithoutACommit) {
  const ScratchFolder folder;
  {
    OutputStream out(folder.file("out.txt"), Overwrite::refuse);
    out.stream() << "text";
    EXPECT_EQ(folder.count(), 1U);
  }
  EXPECT_EQ(folder.count(), 0U);
}

TEST(OutputFile, RefusesAnExistingFile) {
  const ScratchFolder folder;
  folder.write("out.txt", "precious");
  EXPECT_EQ(message_of(folder.file("out.txt"), Overwrite::refuse),
            folder.file("out.txt") + ": cannot be written: it exists already; pass --overwrite to replace it");
  EXPECT_EQ(folder.read("out.txt"), "precious");
}

TEST(OutputFile, ReplacesAnExistingFileWhenAsked) {
  const ScratchFolder folder;
  folder.write("out.txt", "old");
  write_text(folder.file("out.txt"), "new", Overwrite::allow);
  EXPECT_EQ(folder.read("out.txt"), "new");
}

TEST(OutputFile, KeepsTheOldFileWhenItIsNotCommitted) {
  const ScratchFolder folder;
  folder.write("out.txt", "old");
  { OutputStream out(folder.file("out.txt"), Overwrite::allow); }
  EXPECT_EQ(folder.read("out.txt"), "old");
}

TEST(OutputFile, RefusesATargetThatAppearedMeanwhile) {
  const ScratchFolder folder;
  OutputFile file(folder.file("out.txt"), Overwrite::refuse);
  folder.write("out.txt", "somebody else's");
  EXPECT_THROW(file.commit(), WriteError);
  EXPECT_EQ(folder.read("out.txt"), "somebody else's");
}

TEST(OutputFile, NamesAMissingFolder) {
  const ScratchFolder folder;
  const std::string message = message_of(folder.file("none/out.txt"), Overwrite::refuse);
  EXPECT_NE(message.find("there is no folder " + folder.file("none")), std::string::npos) << message;
}

TEST(OutputFile, RefusesAFolderADeviceAndAnEmptyName) {
  const ScratchFolder folder;
  EXPECT_NE(message_of(folder.path().string(), Overwrite::allow).find("it is a folder"), std::string::npos);
  EXPECT_NE(message_of("/dev/null", Overwrite::allow).find("not a regular file"), std::string::npos);
  EXPECT_NE(message_of("", Overwrite::allow).find("empty"), std::string::npos);
  EXPECT_TRUE(std::filesystem::is_character_file("/dev/null"));
}

TEST(OutputFile, NamesAFolderThatIsNotWritable) {
  const ScratchFolder folder;
  using std::filesystem::perms;
  std::filesystem::permissions(folder.path(),
                               perms::owner_read | perms::owner_exec | perms::others_read | perms::others_exec);
  EXPECT_EQ(refusal_to_ordinary_user([&] { OutputFile(folder.file("out.txt"), Overwrite::refuse); }),
            folder.file("out.txt") + ": cannot be written: the folder " + folder.path().string() +
                " is not writable; choose another");
}

TEST(OutputFile, SaysWhyNothingCanBeMadeBesideIt) {
  // A name may have 255 bytes: this one may stand there, but with what an unfinished file has behind it, it may not.
  const ScratchFolder folder;
  const std::string path = folder.file(std::string(250, 'a'));
  EXPECT_EQ(message_of(path, Overwrite::refuse),
            path + ": cannot be written: File name too long; choose a folder where you may write");
}

TEST(OutputFile, SaysThatTooManyUnfinishedFilesStandBesideIt) {
  const ScratchFolder folder;
  for (int n = 0; n < 1000; ++n) folder.write(fmt::format("out.txt.{}-{}.part", ::getpid(), n), "");
  EXPECT_EQ(message_of(folder.file("out.txt"), Overwrite::refuse),
            folder.file("out.txt") +
                ": cannot be written: too many unfinished files stand beside it; remove the files that end in .part");
  EXPECT_EQ(folder.count(), 1000U);
}

TEST(OutputFile, SaysThatItCannotBeOpened) {
  // With this mask its user may not even write the files that he has made.
  const ScratchFolder folder;
  std::filesystem::permissions(folder.path(), std::filesystem::perms::all);
  EXPECT_EQ(refusal_to_ordinary_user([&] {
              ::umask(0777);
              OutputStream(folder.file("out.txt"), Overwrite::refuse);
            }),
            folder.file("out.txt") + ": cannot be written: it cannot be opened");
  EXPECT_EQ(folder.count(), 0U);
}

TEST(OutputFile, FollowsASymbolicLink) {
  const ScratchFolder folder;
  folder.write("real.txt", "old");
  std::filesystem::create_symlink("real.txt", folder.file("link.txt"));
  write_text(folder.file("link.txt"), "new", Overwrite::allow);
  EXPECT_TRUE(std::filesystem::is_symlink(folder.file("link.txt")));
  EXPECT_EQ(folder.read("real.txt"), "new");
}

constexpr std::array<std::string_view, 3> known{"a", "sub/b", "made/"};

void make_folder(const ScratchFolder& folder, const std::string& name, const std::vector<std::string>& files) {
  for (const std::string& file : files) {
    std::filesystem::create_directories(folder.path() / name / std::filesystem::path(file).parent_path());
    folder.write(name + "/" + file, "old");
  }
}

void write_folder(const std::string& path, Overwrite overwrite) {
  OutputFile out(path, overwrite, known);
  std::ofstream(out.temporary_path() + "/a") << "new";
  EXPECT_EQ(out.size(), 3);
  out.commit();
}

TEST(OutputFolder, AppearsWholeUnderItsName) {
  const ScratchFolder folder;
  OutputFile out(folder.file("out"), Overwrite::refuse, known);
  std::ofstream(out.temporary_path() + "/a") << "text";
  EXPECT_FALSE(std::filesystem::exists(folder.file("out")));
  out.commit();
  EXPECT_EQ(folder.read("out/a"), "text");
  EXPECT_EQ(folder.count(), 1U);
}

TEST(OutputFolder, LeavesNothingWithoutACommit) {
  const ScratchFolder folder;
  {
    OutputFile out(folder.file("out"), Overwrite::refuse, known);
    std::ofstream(out.temporary_path() + "/a") << "text";
  }
  EXPECT_EQ(folder.count(), 0U);
}

TEST(OutputFolder, TakesTheNameOfAnEmptyFolderWithOrWithoutASlash) {
  const ScratchFolder folder;
  std::filesystem::create_directory(folder.file("out"));
  write_folder(folder.file("out") + "/", Overwrite::refuse);
  EXPECT_EQ(folder.read("out/a"), "new");
  write_folder(folder.file("fresh") + "//", Overwrite::refuse);
  EXPECT_EQ(folder.read("fresh/a"), "new");
  EXPECT_EQ(folder.count(), 2U);
}

TEST(OutputFolder, IsRefusedWhereOneExists) {
  const ScratchFolder folder;
  make_folder(folder, "out", {"a"});
  EXPECT_THROW(write_folder(folder.file("out"), Overwrite::refuse), WriteError);
  EXPECT_EQ(folder.read("out/a"), "old");
  EXPECT_EQ(folder.count(), 1U);
}

TEST(OutputFolder, ReplacesAFormerOutputWhenAsked) {
  const ScratchFolder folder;
  make_folder(folder, "out", {"a", "sub/b", "made/by/another/program"});
  write_folder(folder.file("out"), Overwrite::allow);
  EXPECT_EQ(folder.read("out/a"), "new");
  EXPECT_FALSE(std::filesystem::exists(folder.file("out/sub")));
  EXPECT_FALSE(std::filesystem::exists(folder.file("out/made")));
  EXPECT_EQ(folder.count(), 1U);
}

TEST(OutputFolder, NeverReplacesAFolderWithAnythingElseInIt) {
  const ScratchFolder folder;
  make_folder(folder, "out", {"a", "sub/results"});
  try {
    write_folder(folder.file("out"), Overwrite::allow);
    FAIL() << "replaced";
  } catch (const WriteError& error) {
    EXPECT_EQ(error.what(), folder.file("out") +
                                ": cannot be written: the folder there holds sub/results, which is no "
                                "file of this format; choose another folder");
  }
  EXPECT_EQ(folder.read("out/sub/results"), "old");
  EXPECT_EQ(folder.count(), 1U);
}

TEST(OutputFolder, NeitherReplacesAFileNorFollowsALinkInsideAFolder) {
  const ScratchFolder folder;
  folder.write("out", "precious");
  EXPECT_THROW(write_folder(folder.file("out"), Overwrite::allow), WriteError);
  EXPECT_EQ(folder.read("out"), "precious");
  make_folder(folder, "elsewhere", {"a"});
  std::filesystem::create_directory(folder.file("case"));
  std::filesystem::create_directory_symlink(folder.file("elsewhere"), folder.file("case/sub"));
  EXPECT_THROW(write_folder(folder.file("case"), Overwrite::allow), WriteError);
  EXPECT_EQ(folder.read("elsewhere/a"), "old");
}

TEST(OutputFile, ReportsAFullDisk) {
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "no /dev/full here";
  const ScratchFolder folder;
  OutputStream out(folder.file("out.txt"), Overwrite::refuse);
  // The stream's file becomes the device that is always full.
  out.stream().close();
  out.stream().open("/dev/full", std::ios::binary);
  out.stream() << std::string(100'000, 'x');
  EXPECT_THROW(out.commit(), WriteError);
  EXPECT_FALSE(std::filesystem::exists(folder.file("out.txt")));
}

}  // namespace
}  // namespace wellknit
