// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "cli/output_set.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <set>

#include "cli/usage_error.h"
#include "writers/output_file.h"

namespace wellknit {

namespace {

std::filesystem::path plain(const std::string& path) {
  std::error_code ignored;  // a path that cannot be resolved is compared as it stands
  const auto resolved = std::filesystem::weakly_canonical(std::filesystem::absolute(path), ignored);
  return resolved.empty() ? std::filesystem::path(path) : resolved;
}

const WriterFormat& format_named(const std::string& name) {
  if (const WriterFormat* format = find_writer(name)) return *format;
  std::string names;
  for (const WriterFormat& format : writer_formats()) names += (names.empty() ? "" : ", ") + std::string(format.name);
  throw UsageError(fmt::format("unknown format '{}'; the formats are {}", name, names));
}

/// Removes the outputs that have got their names already, unless all of them have.
class AllOrNone {
 public:
  AllOrNone() = default;
  ~AllOrNone() {
    std::error_code ignored;  // nothing more can be done about a file that cannot be removed
    for (const std::string& path : named_) std::filesystem::remove_all(path, ignored);
  }
  AllOrNone(const AllOrNone&) = delete;
  AllOrNone& operator=(const AllOrNone&) = delete;
  void add(const std::string& path) { named_.push_back(path); }
  void keep() { named_.clear(); }

 private:
  std::vector<std::string> named_;
};

}  // namespace

OutputSet::OutputSet(std::vector<OutputRequest> outputs, const std::vector<std::string>& inputs, bool overwrite)
    : outputs_(std::move(outputs)), overwrite_(overwrite) {
  std::set<std::filesystem::path> taken;
  for (const OutputRequest& output : outputs_) {
    format_named(output.format);
    const std::filesystem::path path = plain(output.path);
    if (!taken.insert(path).second) throw UsageError(fmt::format("{}: two outputs have this path", output.path));
    const auto same = [&](const std::string& input) { return plain(input) == path; };
    if (std::ranges::any_of(inputs, same)) throw UsageError(fmt::format("{}: is an input of this run", output.path));
  }
  for (const OutputRequest& output : outputs_) {
    check_output_path(output.path, overwrite ? Overwrite::allow : Overwrite::refuse,
                      format_named(output.format).contents);
  }
}

std::vector<WrittenFile> OutputSet::write(const Mesh& mesh, const Provenance& provenance) const {
  std::vector<std::unique_ptr<OutputFile>> files;
  std::vector<WrittenFile> written;
  for (const OutputRequest& output : outputs_) {
    const WriterFormat& format = format_named(output.format);
    files.push_back(
        std::make_unique<OutputFile>(output.path, overwrite_ ? Overwrite::allow : Overwrite::refuse, format.contents));
    const auto notes = format.write(mesh, provenance, files.back()->temporary_path(), Overwrite::allow);
    written.push_back({output.format, output.path, files.back()->size(), notes});
  }
  // Every byte is on the disk: what is left is to give the names.
  AllOrNone named;
  for (std::size_t i = 0; i < files.size(); ++i) {
    files[i]->commit();
    named.add(outputs_[i].path);
  }
  named.keep();
  return written;
}

}  // namespace wellknit
