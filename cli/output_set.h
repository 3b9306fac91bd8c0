// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// All outputs of one run: they appear together or not at all.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "cli/build_request.h"
#include "cli/report.h"
#include "model/mesh.h"
#include "model/provenance.h"
#include "writers/formats.h"
#include "writers/output_file.h"

namespace wellknit {

/// An output that no writer makes: the report of a build.
struct PageOutput {
  std::string format;  ///< for the summary
  std::string path;
};

/// Writes a deck and the folder beside it that holds what it includes: paths of the file and of the empty folder, and
/// the folder's name as the deck calls it. Returns notes.
using DeckOutput = std::function<std::vector<std::string>(const std::string& file, const std::string& folder,
                                                          const std::string& folder_name)>;

/// What a build writes beside the outputs of the table of formats.
struct OwnOutputs {
  bool has_deck_folders = false;  ///< outputs in the format deck have a folder beside them
  std::optional<PageOutput> page;
};

/// What writers need beside the mesh.
struct OutputSources {
  const CornerPointGrid* grid = nullptr;  ///< that the mesh was made from; null: not known
  DeckOutput deck = {};                   ///< called instead of the table's writer of decks where outputs have folders
  std::function<std::string()> page_text = {};  ///< where there is a page
};

/// Outputs that stand beside their targets under other names.
struct PendingOutputs {
  std::vector<std::unique_ptr<OutputFile>> files;
  std::vector<std::string> paths;  ///< where each shall be
  std::vector<WrittenFile> written;
};

class OutputSet {
 public:
  /// Asked before the work begins. Throws UsageError for an unknown format, two outputs with one path, or an output
  /// that is an input; WriteError where a file exists (and `overwrite` is false) or cannot be made.
  OutputSet(std::vector<OutputRequest> outputs, const std::vector<std::string>& inputs, bool overwrite,
            OwnOutputs own = {});

  /// Writes each beside its target, then names them all. Throws WriteError, and leaves nothing then.
  [[nodiscard]] std::vector<WrittenFile> write(const Mesh& mesh, const Provenance& provenance,
                                               const OutputSources& sources = {}) const;

 private:
  [[nodiscard]] bool has_folder(const OutputRequest& output) const;
  void write_beside(const Mesh& mesh, const Provenance& provenance, const OutputSources& sources,
                    PendingOutputs& pending) const;

  std::vector<OutputRequest> outputs_;
  bool overwrite_;
  OwnOutputs own_;
};

}  // namespace wellknit
