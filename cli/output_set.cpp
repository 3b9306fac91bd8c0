// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "cli/output_set.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <set>

#include "cli/usage_error.h"
#include "conversion/convert_deck.h"
#include "writers/output_file.h"
#include "writers/text_file.h"
#include "writers/unfinished_outputs.h"

namespace wellknit {

namespace {

std::filesystem::path plain(const std::string& path) {
  std::error_code ignored;  // a path that cannot be resolved is compared as it stands
  const auto resolved = std::filesystem::weakly_canonical(std::filesystem::absolute(path), ignored);
  return resolved.empty() ? std::filesystem::path(path) : resolved;
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

std::vector<std::string> side_files_of(const OutputRequest& output) {
  const WriterFormat& format = format_named(output.format);
  return format.side_files == nullptr ? std::vector<std::string>{} : format.side_files(output.path, output.options);
}

/// The keys of a deck are those of the template deck.
void require_default_layout(const OutputRequest& output) {
  const FlowDeckOptions& deck = output.options.deck;
  const FlowDeckOptions defaults;
  if (deck.layout == defaults.layout && deck.order == defaults.order && deck.fluids == defaults.fluids) return;
  throw UsageError(fmt::format(
      "{}: a converted whole deck has layout=row, order=mesh and its own fluids; leave the keys out, or convert the "
      "mesh file",
      output.path));
}

void write_text(const std::string& text, const std::string& file, const std::string& shown_path) {
  TextFile out(file, shown_path);
  out.text(text);
  out.close();
}

/// A message with the paths that the user gave in the place of those that the outputs have while they are written.
std::string with_the_users_names(std::string message, const PendingOutputs& pending) {
  for (std::size_t i = 0; i < pending.files.size(); ++i) {
    const std::string& temporary = pending.files[i]->temporary_path();
    for (std::size_t at = message.find(temporary); at != std::string::npos;
         at = message.find(temporary, at + pending.paths[i].size()))
      message.replace(at, temporary.size(), pending.paths[i]);
  }
  return message;
}

}  // namespace

bool OutputSet::has_folder(const OutputRequest& output) const {
  return own_.has_deck_folders && format_named(output.format).name == "deck";
}

OutputSet::OutputSet(std::vector<OutputRequest> outputs, const std::vector<std::string>& inputs, bool overwrite,
                     OwnOutputs own)
    : outputs_(std::move(outputs)), overwrite_(overwrite), own_(std::move(own)) {
  std::set<std::filesystem::path> taken;
  const auto take = [&](const std::string& output) {
    const std::filesystem::path path = plain(output);
    if (!taken.insert(path).second) throw UsageError(fmt::format("{}: two outputs have this path", output));
    const auto same = [&](const std::string& input) { return plain(input) == path; };
    if (std::ranges::any_of(inputs, same)) throw UsageError(fmt::format("{}: is an input of this run", output));
  };
  for (const OutputRequest& output : outputs_) {
    format_named(output.format);
    take(output.path);
    if (has_folder(output)) {
      take(deck_folder_of(output.path));
      require_default_layout(output);
    }
    for (const std::string& path : side_files_of(output)) take(path);
  }
  if (own_.page) {
    take(own_.page->path);
    check_output_path(own_.page->path, overwrite ? Overwrite::allow : Overwrite::refuse);
  }
  for (const OutputRequest& output : outputs_) {
    check_output_path(output.path, overwrite ? Overwrite::allow : Overwrite::refuse,
                      format_named(output.format).contents);
    if (has_folder(output))
      check_output_path(deck_folder_of(output.path), overwrite ? Overwrite::allow : Overwrite::refuse,
                        deck_folder_contents);
    for (const std::string& path : side_files_of(output))
      check_output_path(path, overwrite ? Overwrite::allow : Overwrite::refuse);
  }
}

void OutputSet::write_beside(const Mesh& mesh, const Provenance& provenance, const OutputSources& sources,
                             PendingOutputs& pending) const {
  auto& [files, paths, written] = pending;
  for (const OutputRequest& output : outputs_) {
    const WriterFormat& format = format_named(output.format);
    const Overwrite overwrite = overwrite_ ? Overwrite::allow : Overwrite::refuse;
    if (has_folder(output)) {
      const std::string folder = deck_folder_of(output.path);
      files.push_back(std::make_unique<OutputFile>(folder, overwrite, deck_folder_contents));
      files.push_back(std::make_unique<OutputFile>(output.path, overwrite));
      paths.insert(paths.end(), {folder, output.path});
      const auto notes = sources.deck(files.back()->temporary_path(), files[files.size() - 2]->temporary_path(),
                                      std::filesystem::path(folder).filename().string());
      written.push_back({output.format, output.path, files.back()->size() + files[files.size() - 2]->size(), notes});
      continue;
    }
    WriteRequest request{mesh, provenance, "", Overwrite::allow, output.options, sources.grid};
    const std::size_t first = files.size();
    for (const std::string& path : side_files_of(output)) {
      files.push_back(std::make_unique<OutputFile>(path, overwrite));
      paths.push_back(path);
      request.side_paths.push_back(files.back()->temporary_path());
    }
    files.push_back(std::make_unique<OutputFile>(output.path, overwrite, format.contents));
    paths.push_back(output.path);
    request.path = files.back()->temporary_path();
    auto notes = format.write(request);
    std::int64_t bytes = 0;
    for (std::size_t f = first; f < files.size(); ++f) bytes += files[f]->size();
    for (const std::string& path : side_files_of(output))
      notes.push_back(fmt::format("{} beside it", std::filesystem::path(path).filename().string()));
    written.push_back({output.format, output.path, bytes, notes});
  }
  if (own_.page) {
    const std::string& path = own_.page->path;
    files.push_back(std::make_unique<OutputFile>(path, overwrite_ ? Overwrite::allow : Overwrite::refuse));
    paths.push_back(path);
    write_text(sources.page_text(), files.back()->temporary_path(), path);
    written.push_back({own_.page->format, path, files.back()->size(), {}});
  }
}

std::vector<WrittenFile> OutputSet::write(const Mesh& mesh, const Provenance& provenance,
                                          const OutputSources& sources) const {
  PendingOutputs pending;
  try {
    write_beside(mesh, provenance, sources, pending);
  } catch (const WriteError& error) {
    throw WriteError(with_the_users_names(error.what(), pending));
  }
  // Every byte is on the disk: what is left is to give the names.
  const auto hold = hold_unfinished_outputs();
  AllOrNone named;
  for (std::size_t i = 0; i < pending.files.size(); ++i) {
    pending.files[i]->commit();
    named.add(pending.paths[i]);
  }
  named.keep();
  return std::move(pending.written);
}

}  // namespace wellknit
