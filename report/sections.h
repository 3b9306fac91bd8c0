// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// The page's sections, in their order. Each gives a whole <section>, or nothing where it has nothing to say.
#pragma once

#include <string>

#include "report/write_report.h"

namespace wellknit {

std::string verdict_section(const ReportInput& input);
std::string view_section(const ReportInput& input);
std::string conditions_section(const ReportInput& input);
std::string openfoam_section(const ReportInput& input);
std::string worst_section(const ReportInput& input);
std::string wells_section(const ReportInput& input);
std::string conservation_section(const ReportInput& input);
std::string run_section(const ReportInput& input);

}  // namespace wellknit
