// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// How far a run is, on stderr: a line that is written over on a terminal, a line for each step in a log.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

namespace wellknit {

enum class ProgressStyle : std::uint8_t {
  automatic,  ///< a live line where stderr is a terminal, else nothing
  plain,      ///< a line at the end of each step
  off
};

class Progress {
 public:
  /// The steps' names in order. Short runs show nothing on a terminal: the line appears after a second.
  Progress(ProgressStyle style, std::vector<std::string> steps);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// The step before it, if any, is done, and the next one begins; after the last one the line goes.
  void next();

 private:
  void run();
  void clear_line();

  ProgressStyle style_;
  std::vector<std::string> steps_;
  std::size_t begun_ = 0;  ///< steps that have begun
  bool ended_ = false;
  bool shown_ = false;
  double begin_ = 0.0;       ///< s, of the run
  double step_begin_ = 0.0;  ///< s
  std::mutex mutex_;
  std::condition_variable wake_;
  std::thread thread_;
};

}  // namespace wellknit
