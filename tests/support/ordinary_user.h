// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// What an ordinary user gets, whoever runs the tests: to root every file is readable and every folder writable.
#pragma once

#include <sys/types.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <exception>
#include <stdexcept>
#include <string>

namespace wellknit {

/// Calls `act` in a child process, which gives up root's rights first, and returns what the exception says that it
/// throws; empty where it throws none. `act` must not start threads.
template <class Act>
std::string refusal_to_ordinary_user(const Act& act) {
  std::array<int, 2> ends{};  // of a pipe: to be read from, and to be written to
  if (::pipe(ends.data()) != 0) throw std::runtime_error("no pipe can be made");
  const pid_t child = ::fork();
  if (child < 0) throw std::runtime_error("no process can be made");
  if (child == 0) {
    constexpr uid_t nobody = 65534;
    std::string text;
    if (::geteuid() == 0 && ::setuid(nobody) != 0) text = "root's rights cannot be given up";
    try {
      if (text.empty()) act();
    } catch (const std::exception& error) {
      text = error.what();
    }
    const bool is_written = ::write(ends[1], text.data(), text.size()) == static_cast<ssize_t>(text.size());
    ::_exit(is_written ? 0 : 1);
  }
  ::close(ends[1]);
  std::string text;
  std::array<char, 256> bytes{};
  for (;;) {
    const ssize_t count = ::read(ends[0], bytes.data(), bytes.size());
    if (count <= 0) break;
    text.append(bytes.data(), static_cast<std::size_t>(count));
  }
  ::close(ends[0]);
  int status = 0;
  if (::waitpid(child, &status, 0) != child || !WIFEXITED(status) || WEXITSTATUS(status) != 0)
    throw std::runtime_error("the child process failed");
  return text;
}

}  // namespace wellknit
