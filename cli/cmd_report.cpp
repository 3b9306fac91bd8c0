// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// wellknit report: the quality report of a mesh file (docs/commands/report.md).

#include <iostream>
#include <memory>

#include "cli/commands.h"
#include "cli/report.h"
#include "model/assessment.h"
#include "model/errors.h"
#include "readers/file_content.h"
#include "readers/read_mesh.h"
#include "report/write_report.h"
#include "writers/output_file.h"

namespace wellknit {

namespace {

struct ReportRequest {
  std::string mesh;
  std::string out;
  std::string limits;
  std::string summary;
  bool overwrite = false;
  bool quiet = false;
};

int report(const ReportRequest& request) {
  const Overwrite overwrite = request.overwrite ? Overwrite::allow : Overwrite::refuse;
  check_output_path(request.out, overwrite);
  const std::vector<Limit> limits = request.limits.empty() ? std::vector<Limit>{} : read_limits(request.limits);
  std::optional<BuildFacts> build;
  if (!request.summary.empty())
    build = parse_build_facts(std::string(load_file(request.summary).text), request.summary);
  const MeshFile file = read_mesh(request.mesh);
  const Assessment assessment = assess(file.mesh, limits);
  OutputStream out(request.out, overwrite);
  const std::string page =
      report_html({file.mesh, file.provenance, assessment, request.mesh, program_and_version(), std::move(build)});
  out.stream() << page;
  out.commit();
  if (!request.quiet)
    std::cout << headline(assessment) << '\n'
              << to_text(WrittenFile{"report", request.out, static_cast<std::int64_t>(page.size()), {}});
  return 0;
}

}  // namespace

Run add_report(CLI::App& app) {
  const auto request = std::make_shared<ReportRequest>();
  app.add_option("MESH", request->mesh, "A mesh file (HDF5)")->required()->type_name("FILE");
  app.add_option("-o,--output", request->out, "The report, one HTML file")->required()->type_name("REPORT.html");
  app.add_option("--limits", request->limits, "A TOML file of `figure = limit` lines, as for check")->type_name("FILE");
  app.add_option("--summary", request->summary, "What `wellknit build --json` printed: times, notes, wells not meshed")
      ->type_name("FILE");
  app.add_flag("--overwrite", request->overwrite, "Replace a report that exists");
  app.add_flag("--quiet", request->quiet, "No output but errors");
  return [request] { return report(*request); };
}

}  // namespace wellknit
