// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// What the files of MATLAB and numpy refuse; write_mrst_test.cpp and check_darts.py read what they hold.

#include <gtest/gtest.h>

#include <functional>
#include <string>

#include "model/errors.h"
#include "tests/support/scratch_folder.h"
#include "writers/mat_file.h"
#include "writers/npz_file.h"

namespace wellknit {
namespace {

std::string refusal(const std::function<void()>& act) {
  try {
    act();
  } catch (const WriteError& error) {
    return error.what();
  }
  return "no error";
}

TEST(MatFile, SaysThatItCannotBeOpened) {
  const ScratchFolder folder;
  EXPECT_EQ(refusal([&] { MatFile(folder.file("none/mesh.mat"), "mesh.mat"); }),
            "mesh.mat: cannot be written: it cannot be opened");
}

TEST(MatFile, RefusesAVariableAboveTwoGibibytesBeforeItIsMade) {
  const ScratchFolder folder;
  MatFile file(folder.file("mesh.mat"), "mesh.mat");
  // 268,435,456 doubles are 2^31 bytes, one more than the format's length can say.
  const MatVariable large = MatVariable::numbers(268'435'456, 1, []() -> std::vector<double> {
    ADD_FAILURE() << "made";
    return {};
  });
  EXPECT_EQ(refusal([&] { file.write("G", large); }),
            "mesh.mat: cannot be written: a variable of MATLAB's version 5 holds at most 2 GiB and G would hold more; "
            "choose the format hdf5");
}

TEST(NpzFile, SaysThatItCannotBeOpened) {
  const ScratchFolder folder;
  folder.write("file", "");
  EXPECT_EQ(refusal([&] { NpzFile(folder.file("file/mesh.npz"), "mesh.npz"); }),
            "mesh.npz: cannot be written: it cannot be opened");
}

}  // namespace
}  // namespace wellknit
