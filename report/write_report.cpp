// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "report/write_report.h"

#include <fmt/format.h>

#include <array>

#include "report/assets.h"
#include "report/html.h"
#include "report/sections.h"

namespace wellknit {

namespace {

constexpr std::array scripts{"arrays.js", "matrices.js", "surface.js", "drawing.js", "viewer.js", "page.js"};

/// The policy forbids every connection: the page cannot ask a network for anything.
std::string head(const ReportInput& input) {
  return fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; style-src 'unsafe-inline'; "
      "script-src "
      "'unsafe-inline'; img-src data:\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<link rel=\"icon\" href=\"data:,\">\n"
      "<title>{0} – mesh quality</title>\n<style>\n{1}</style>\n</head>\n<body>\n"
      "<a class=\"skip\" href=\"#verdict\">To the verdict</a>\n<header>\n<h1>{0}</h1>\n<p>Quality of a mesh for "
      "finite volumes, {2}</p>\n<button type=\"button\" id=\"theme\">light or dark</button>\n</header>\n",
      escaped(input.mesh_path), report_asset("report.css"), escaped(input.program));
}

constexpr const char* contents =
    "<nav aria-label=\"Contents\"><a href=\"#verdict\">Verdict</a> <a href=\"#view\">Picture</a> <a "
    "href=\"#conditions\">Conditions</a> <a href=\"#openfoam\">checkMesh</a> <a href=\"#worst\">Worst cells</a> <a "
    "href=\"#wells\">Wells</a> <a href=\"#conservation\">Conservation</a> <a href=\"#run\">Run</a></nav>\n";

}  // namespace

std::string report_html(const ReportInput& input) {
  std::string out = head(input) + contents + "<main>\n";
  for (const auto section : {verdict_section, view_section, conditions_section, openfoam_section, worst_section,
                             wells_section, conservation_section, run_section})
    out += section(input);
  out += "</main>\n<script type=\"application/json\" id=\"check\">\n" +
         inside_script(to_json(input.assessment, input.mesh_path, input.program)) + "</script>\n";
  for (const char* script : scripts) out += "<script>\n" + std::string(report_asset(script)) + "</script>\n";
  return out + "</body>\n</html>\n";
}

}  // namespace wellknit
