// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// Linked into tests that count lines: threads that count into the same places are five times slower than one, and lose
/// counts.

#include <tbb/global_control.h>

namespace wellknit {

namespace {

const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);

}  // namespace

}  // namespace wellknit
