// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// wellknit convert: a mesh file, or a grid without wells, to the format of any writer (docs/commands/convert.md).

#include <fmt/format.h>

#include <iostream>
#include <memory>

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
  bool overwrite = false;
  bool quiet = false;
};

OutputRequest output_of(const ConvertRequest& request) {
  if (!request.format.empty()) return {request.format, request.out};
  if (const WriterFormat* format = writer_of_path(request.out)) return {std::string(format->name), request.out};
  throw UsageError(fmt::format("{}: no format has this extension; give --to FORMAT", request.out));
}

/// A mesh file as it is; a grid as the host alone.
MeshFile load(const std::string& path) {
  switch (recognise_file(path).kind) {
    case FormatKind::mesh: return read_mesh(path);
    case FormatKind::grid: {
      const Case source = read_case(path);
      return {build_mesh(source, {}, {}).mesh, {program_and_version(), "wellknit convert " + path, "", source.sources}};
    }
    case FormatKind::wells: break;
  }
  throw InvalidInput(fmt::format("{}: a well path has no cells to convert; give a mesh file or a grid", path));
}

int convert(const ConvertRequest& request) {
  const OutputSet outputs({output_of(request)}, {request.in}, request.overwrite);
  const MeshFile file = load(request.in);
  for (const WrittenFile& written : outputs.write(file.mesh, file.provenance)) {
    if (!request.quiet) std::cout << to_text(written);
  }
  return 0;
}

}  // namespace

Run add_convert(CLI::App& app) {
  const auto request = std::make_shared<ConvertRequest>();
  app.add_option("IN", request->in, "A mesh file, or a deck or grid (the host alone)")->required()->type_name("FILE");
  app.add_option("OUT", request->out, "The output")->required()->type_name("FILE");
  app.add_option("--to", request->format, "A format of `wellknit formats`; by default that of OUT's extension")
      ->type_name("FORMAT");
  app.add_flag("--overwrite", request->overwrite, "Replace OUT if it exists");
  app.add_flag("--quiet", request->quiet, "No output but errors");
  return [request] { return convert(*request); };
}

}  // namespace wellknit
