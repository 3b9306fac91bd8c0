// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "cli/progress.h"

#include <fmt/format.h>

#include <chrono>
#include <cstdio>

#include "cli/terminal.h"

namespace wellknit {

namespace {

constexpr double first_shown_after = 1.0;  ///< s
constexpr auto interval = std::chrono::milliseconds(200);

double now() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

void put(const std::string& text) {
  std::fputs(text.c_str(), stderr);
  std::fflush(stderr);
}

/// [=> ] with one place for each step.
std::string bar(std::size_t begun, std::size_t steps) {
  constexpr std::size_t width = 24;
  const std::size_t done = width * (begun - 1) / steps;
  return "[" + std::string(done, '=') + ">" + std::string(width - 1 - std::min(done, width - 1), ' ') + "]";
}

}  // namespace

Progress::Progress(ProgressStyle style, std::vector<std::string> steps)
    : style_(style), steps_(std::move(steps)), begin_(now()) {
  if (style_ == ProgressStyle::automatic && !is_terminal(Stream::error)) style_ = ProgressStyle::off;
  if (style_ == ProgressStyle::automatic) thread_ = std::thread([this] { run(); });
}

Progress::~Progress() {
  {
    const std::scoped_lock lock(mutex_);
    ended_ = true;
    clear_line();
  }
  wake_.notify_all();
  if (thread_.joinable()) thread_.join();
}

void Progress::next() {
  const std::scoped_lock lock(mutex_);
  const double time = now();
  if (style_ == ProgressStyle::plain && begun_ > 0)
    put(fmt::format("wellknit: {} {:.2f} s ({} of {})\n", steps_[begun_ - 1], time - step_begin_, begun_,
                    steps_.size()));
  step_begin_ = time;
  if (begun_ == steps_.size()) {
    ended_ = true;
    clear_line();
  } else {
    ++begun_;
  }
}

void Progress::clear_line() {
  if (shown_) put("\r\033[K");
  shown_ = false;
}

void Progress::run() {
  std::unique_lock lock(mutex_);
  while (!wake_.wait_for(lock, interval, [this] { return ended_; })) {
    const double time = now();
    if (begun_ == 0 || time - begin_ < first_shown_after) continue;
    put(fmt::format("\r\033[K{} {} of {}: {}, {:.0f} s", bar(begun_, steps_.size()), begun_, steps_.size(),
                    steps_[begun_ - 1], time - begin_));
    shown_ = true;
  }
}

}  // namespace wellknit
