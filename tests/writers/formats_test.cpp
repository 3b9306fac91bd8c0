// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "writers/formats.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <set>
#include <sstream>

#include "tests/support/grids.h"
#include "tests/support/meshes.h"
#include "tests/support/scratch_folder.h"

namespace wellknit {
namespace {

TEST(WriterFormats, HaveUniqueNamesAndExtensions) {
  std::set<std::string_view> names;
  std::set<std::string_view> extensions;
  for (const WriterFormat& format : writer_formats()) {
    EXPECT_TRUE(names.insert(format.name).second) << format.name;
    EXPECT_FALSE(format.description.empty());
    EXPECT_FALSE(format.extensions.empty());
    for (const std::string_view extension : format.extensions)
      EXPECT_TRUE(extensions.insert(extension).second) << extension;
    EXPECT_TRUE(
        std::filesystem::exists(std::string(WELLKNIT_SOURCE_DIR "/docs/formats/") + std::string(format.document)))
        << format.document;
  }
  EXPECT_EQ(names, (std::set<std::string_view>{"adgprs", "csv", "darts", "darts_h5", "deck", "dgf", "fehm", "hdf5",
                                               "mrst", "openfoam", "opm_grid", "pflotran", "pflotran_h5", "tough",
                                               "vtkhdf", "vtp", "vtu"}));
}

TEST(WriterFormats, AreFoundByNameInAnyCase) {
  ASSERT_NE(find_writer("VTU"), nullptr);
  EXPECT_EQ(find_writer("VTU")->name, "vtu");
  EXPECT_EQ(find_writer("stl"), nullptr);
}

TEST(WriterFormats, AreFoundByExtensionInAnyCase) {
  ASSERT_NE(writer_of_path("some.folder/OUT.DATA"), nullptr);
  EXPECT_EQ(writer_of_path("some.folder/OUT.DATA")->name, "deck");
  EXPECT_EQ(writer_of_path("out.h5")->name, "hdf5");
  EXPECT_EQ(writer_of_path("h5"), nullptr);
  EXPECT_EQ(writer_of_path("data.h5/out"), nullptr);
}

TEST(WriterFormats, HaveKeysThatTakeWhatTheySay) {
  std::size_t keys = 0;
  for (const WriterFormat& format : writer_formats())
    for (const WriterKey& key : writer_keys(format.name)) {
      ++keys;
      WriterOptions options;
      EXPECT_FALSE(key.set(options, "")) << format.name << " " << key.name;
      std::istringstream values((std::string(key.values)));
      for (std::string value; std::getline(values, value, '|');)
        EXPECT_TRUE(key.set(options, value)) << format.name << " " << key.name << " " << value;
    }
  EXPECT_GE(keys, 9U);
  EXPECT_TRUE(writer_keys("stl").empty());
}

std::uintmax_t bytes_of(const std::filesystem::path& path) {
  if (!std::filesystem::is_directory(path)) return std::filesystem::file_size(path);
  std::uintmax_t bytes = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(path))
    if (entry.is_regular_file()) bytes += entry.file_size();
  return bytes;
}

TEST(WriterFormats, WriteEachAFileOrAFolder) {
  const ScratchFolder folder;
  const Mesh mesh = meshes::ring_in_boxes();
  const CornerPointGrid source = grids::box(mesh.source_dimensions);
  for (const WriterFormat& format : writer_formats()) {
    const std::string path = folder.file("out" + std::string(format.extensions.front()));
    format.write({mesh, meshes::provenance(), path, Overwrite::refuse, {}, &source});
    EXPECT_EQ(std::filesystem::is_directory(path), !format.contents.empty()) << format.name;
    EXPECT_GT(bytes_of(path), 1000U) << format.name;
  }
  EXPECT_EQ(folder.count(), writer_formats().size());  // nothing temporary is left
}

}  // namespace
}  // namespace wellknit
