// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// Ctrl-C, SIGTERM and SIGHUP end the program at once and leave no half-written output.
#pragma once

namespace wellknit {

/// Before any other thread is made: they inherit the blocked signals, which a thread of its own waits for.
void handle_interruptions();

}  // namespace wellknit
