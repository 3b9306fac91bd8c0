// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "cli/interruption.h"

#include <pthread.h>
#include <unistd.h>

#include <csignal>
#include <cstring>
#include <string>
#include <thread>

#include "cli/terminal.h"
#include "writers/unfinished_outputs.h"

namespace wellknit {

namespace {

/// The shell learns from the signal, not from an exit code, that a loop of its own should end too.
[[noreturn]] void die_of(int number) {
  std::signal(number, SIG_DFL);
  sigset_t one;
  sigemptyset(&one);
  sigaddset(&one, number);
  pthread_sigmask(SIG_UNBLOCK, &one, nullptr);
  ::kill(::getpid(), number);
  ::_exit(128 + number);
}

}  // namespace

void handle_interruptions() {
  sigset_t signals;
  sigemptyset(&signals);
  for (const int number : {SIGINT, SIGTERM, SIGHUP}) {
    struct sigaction former {};
    // A program started by nohup or in the background of a script ignores some of them, and goes on doing so.
    if (sigaction(number, nullptr, &former) == 0 && former.sa_handler != SIG_IGN) sigaddset(&signals, number);
  }
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);
  std::thread([signals] {
    int number = 0;
    if (sigwait(&signals, &number) != 0) return;
    remove_unfinished_outputs();
    const std::string line = std::string(is_terminal(Stream::error) ? "\r\033[K" : "") + "wellknit: stopped by " +
                             (number == SIGINT    ? "Ctrl-C"
                              : number == SIGTERM ? "SIGTERM"
                                                  : "SIGHUP") +
                             "; nothing was written\n";
    // Not through stderr's buffer, which another thread may hold.
    const bool is_said = ::write(STDERR_FILENO, line.data(), line.size()) >= 0;
    if (number == SIGINT && is_said) die_of(number);
    ::_exit(1);
  }).detach();
}

}  // namespace wellknit
