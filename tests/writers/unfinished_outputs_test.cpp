// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "writers/unfinished_outputs.h"

#include <gtest/gtest.h>

#include <array>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "tests/support/scratch_folder.h"
#include "writers/output_file.h"

namespace wellknit {
namespace {

/// Removing keeps the lock for ever, so it happens in a process of its own, as in the program.
TEST(UnfinishedOutputsDeathTest, AreRemovedAndCompleteOnesAreNot) {
  const ScratchFolder scratch;
  const auto write_and_stop = [&] {
    OutputFile complete(scratch.file("complete"), Overwrite::refuse);
    complete.commit();
    static constexpr std::array<std::string_view, 1> contents{"a"};
    const OutputFile file(scratch.file("file"), Overwrite::refuse);
    const OutputFile folder(scratch.file("folder"), Overwrite::refuse, contents);
    std::ofstream(folder.temporary_path() + "/a") << "half";
    remove_unfinished_outputs();
    std::_Exit(3);
  };
  EXPECT_EXIT(write_and_stop(), testing::ExitedWithCode(3), "");
  std::vector<std::string> left;
  for (const auto& entry : std::filesystem::directory_iterator(scratch.path()))
    left.push_back(entry.path().filename().string());
  EXPECT_EQ(left, std::vector<std::string>{"complete"});
}

}  // namespace
}  // namespace wellknit
