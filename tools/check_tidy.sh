#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The wellknit authors
# SPDX-License-Identifier: GPL-3.0-or-later
# check_tidy.sh BUILD_FOLDER: clang-tidy over every source that the folder's compile_commands.json compiles.
set -euo pipefail
cd "$(dirname "$0")/.."
build=$1
git ls-files 'model/*.cpp' 'readers/*.cpp' 'algorithm/*.cpp' 'writers/*.cpp' 'cli/*.cpp' |
  xargs -P "$(nproc)" -n 1 clang-tidy -p "$build" --quiet
