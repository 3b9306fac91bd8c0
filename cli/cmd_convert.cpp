// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// wellknit convert: a mesh file, or a grid without wells, to the format of any writer (docs/commands/convert.md).

#include <fmt/format.h>

#include <iostream>
#include <memory>
#include <optional>

#include "algorithm/build_mesh.h"
#include "cli/commands.h"
#include "cli/output_set.h"
#include "cli/usage_error.h"
#include "model/errors.h"
#include "readers/formats.h"
#include "readers/read_case.h"
#include "readers/read_mesh.h"
#include "writers/formats.h"

namespace wellknit {

namespace {

struct ConvertRequest {
  std::string in;
  std::string out;
  std::string format;
  std::string source;
  bool overwrite = false;
  bool quiet = false;
};

OutputRequest output_of(const ConvertRequest& request) {
  if (!request.format.empty()) return parse_format(request.format, request.out);
  if (const WriterFormat* format = writer_of_path(request.out)) return {std::string(format->name), request.out};
  throw UsageError(fmt::format("{}: no format has this extension; give --to FORMAT", request.out));
}

/// A mesh and, where it is known, the grid that it was made from.
struct Loaded {
  MeshFile file;
  std::optional<Case> source;
};

/// A mesh file as it is; a grid as the host alone.
Loaded load(const std::string& path, const std::string& source_path) {
  switch (recognise_file(path).kind) {
    case FormatKind::mesh: {
      Loaded out{read_mesh(path), std::nullopt};
      if (!source_path.empty()) out.source = read_case(source_path);
      return out;
    }
    case FormatKind::grid: {
      if (!source_path.empty()) throw UsageError("--source belongs to a mesh file; " + path + " is a grid itself");
      Case source = read_case(path);
      Loaded out{
          {build_mesh(source, {}, {}).mesh, {program_and_version(), "wellknit convert " + path, "", source.sources}},
          std::nullopt};
      out.source = std::move(source);
      return out;
    }
    case FormatKind::wells: break;
  }
  throw InvalidInput(fmt::format("{}: a well path has no cells to convert; give a mesh file or a grid", path));
}

int convert(const ConvertRequest& request) {
  std::vector<std::string> inputs{request.in};
  if (!request.source.empty()) inputs.push_back(request.source);
  const OutputSet outputs({output_of(request)}, inputs, request.overwrite);
  const Loaded in = load(request.in, request.source);
  const OutputSources sources{in.source ? &in.source->grid : nullptr};
  for (const WrittenFile& written : outputs.write(in.file.mesh, in.file.provenance, sources)) {
    if (!request.quiet) std::cout << to_text(written);
  }
  return 0;
}

}  // namespace

Run add_convert(CLI::App& app) {
  const auto request = std::make_shared<ConvertRequest>();
  app.add_option("IN", request->in, "A mesh file, or a deck or grid (the host alone)")->required()->type_name("FILE");
  app.add_option("OUT", request->out, "The output")->required()->type_name("FILE");
  app.add_option("--to", request->format,
                 "A format of `wellknit formats`, with its keys; by default that of OUT's extension")
      ->type_name("FORMAT[,key=value...]");
  app.add_option("--source", request->source, "The grid that the mesh file IN was made from, for outputs that keep it")
      ->type_name("CASE");
  app.add_flag("--overwrite", request->overwrite, "Replace OUT if it exists");
  app.add_flag("--quiet", request->quiet, "No output but errors");
  return [request] { return convert(*request); };
}

}  // namespace wellknit
