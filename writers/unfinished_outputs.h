// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// The temporaries of outputs that are being written, so that a program that is told to stop can remove them. The
/// library itself handles no signal.
#pragma once

#include <mutex>
#include <string>

namespace wellknit {

/// While it lives nobody removes unfinished outputs: for a few renames that belong together. May be taken again by the
/// same thread.
[[nodiscard]] std::unique_lock<std::recursive_mutex> hold_unfinished_outputs();

void add_unfinished_output(const std::string& temporary);
void forget_unfinished_output(const std::string& temporary);

/// Removes them all, files and folders, and keeps the lock for ever: to be called by a thread that ends the program.
void remove_unfinished_outputs() noexcept;

}  // namespace wellknit
