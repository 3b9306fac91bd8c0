// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// Work on consecutive ranges in parallel, its results taken in order: the same for any number of threads, and only a
/// few results are in memory at a time.
#pragma once

#include <tbb/concurrent_queue.h>
#include <tbb/parallel_pipeline.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace wellknit {

/// `make(begin, end, buffer)` fills a buffer for [begin, end) of `count`, in ranges of `length`; buffers are used
/// again as they are. `take(begin, end, buffer)` gets them one at a time, in order.
template <class Buffer, class Make, class Take>
void run_in_order(std::int64_t count, std::int64_t length, const Make& make, const Take& take) {
  struct Piece {
    std::int64_t begin = 0;
    std::int64_t end = 0;
    Buffer* buffer = nullptr;
  };
  const auto in_flight = static_cast<std::size_t>(tbb::this_task_arena::max_concurrency()) + 1;
  std::vector<Buffer> buffers(in_flight);
  tbb::concurrent_queue<Buffer*> free;
  for (Buffer& b : buffers) free.push(&b);
  std::int64_t next = 0;
  const auto start = [&](tbb::flow_control& control) {
    Piece piece;
    if (next >= count) {
      control.stop();
      return piece;
    }
    piece.begin = next;
    piece.end = next = std::min(count, next + length);
    // As many buffers as pieces may be under way: one is always free here.
    free.try_pop(piece.buffer);
    return piece;
  };
  const auto work = [&](Piece piece) {
    make(piece.begin, piece.end, *piece.buffer);
    return piece;
  };
  const auto finish = [&](Piece piece) {
    take(piece.begin, piece.end, *piece.buffer);
    free.push(piece.buffer);
  };
  tbb::parallel_pipeline(in_flight, tbb::make_filter<void, Piece>(tbb::filter_mode::serial_in_order, start) &
                                        tbb::make_filter<Piece, Piece>(tbb::filter_mode::parallel, work) &
                                        tbb::make_filter<Piece, void>(tbb::filter_mode::serial_in_order, finish));
}

}  // namespace wellknit
