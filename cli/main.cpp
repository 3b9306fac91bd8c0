// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// The one place that catches: one line on stderr; exit 0 (done), 1 (the data) or 2 (usage).

#include <algorithm>
#include <exception>
#include <iostream>
#include <new>
#include <string>

#include "cli/commands.h"
#include "cli/interruption.h"
#include "cli/terminal.h"
#include "cli/usage_error.h"

namespace {

constexpr int data_error = 1;
constexpr int usage_error = 2;

int complain(std::string message, int exit_code) {
  std::ranges::replace(message, '\n', ' ');
  std::cerr << wellknit::painted("wellknit:", wellknit::Ink::poor, wellknit::Stream::error) << ' ' << message << '\n';
  return exit_code;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    wellknit::handle_interruptions();
    wellknit::Program program;
    try {
      const int exit_code = program.run(argc, argv);
      // A full disk or a closed pipe behind the summary is a failure too.
      if (!std::cout.flush()) return complain("standard output cannot be written", data_error);
      return exit_code;
    } catch (const CLI::Success& request) {  // --help, --version
      return program.app().exit(request);
    }
  } catch (const CLI::ParseError& error) {
    return complain(std::string(error.what()) + " (see wellknit --help)", usage_error);
  } catch (const wellknit::UsageError& error) {
    return complain(error.what(), usage_error);
  } catch (const std::bad_alloc&) {
    return complain("there is not enough memory for this input", data_error);
  } catch (const std::exception& error) {
    return complain(error.what(), data_error);
  }
}
