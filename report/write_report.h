// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// The quality report: one HTML file that needs no other file and no network (docs/commands/report.md).
#pragma once

#include <optional>
#include <string>

#include "model/assessment.h"
#include "model/mesh.h"
#include "model/provenance.h"
#include "report/build_facts.h"

namespace wellknit {

struct ReportInput {
  const Mesh& mesh;
  const Provenance& provenance;
  const Assessment& assessment;     ///< of this mesh
  std::string mesh_path;            ///< as the user wrote it
  std::string program;              ///< "wellknit 0.1.0"
  std::optional<BuildFacts> build;  ///< what the mesh file does not hold
  /// Bytes of the picture's data before packing; cell arrays beyond it are left out, and the page says which.
  std::size_t view_budget = 400'000'000;
};

/// The whole page. The mesh's structure must be right unless the assessment says otherwise; then there is no picture.
std::string report_html(const ReportInput& input);

}  // namespace wellknit
