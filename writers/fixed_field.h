// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// Numbers in fields of a fixed width, as Fortran reads them: E10.4 takes any number with a decimal point in it.
#pragma once

#include <string_view>

#include "writers/text_file.h"

namespace wellknit {

/// The number in exactly `width` characters (8 to 24), with as many digits as fit, right-aligned; as 123.456789 or as
/// 1.23456E-7, whichever keeps more of them. 0 for what is not finite. Fortran's and C's readers take both.
void fixed_number(TextFile& out, double value, int width);

/// As Fortran's 1PE20.12 writes it.
void exponential_number(TextFile& out, double value);

/// Right-aligned in 10 columns, as Fortran's I10.
void fixed_integer(TextFile& out, std::int64_t value);

/// The text in exactly `width` characters, left-aligned; cut when it is longer.
void fixed_text(TextFile& out, std::string_view text, std::size_t width);

}  // namespace wellknit
