// Data parallelism with results that do not depend on the number of threads.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>

namespace slipface {

// Calls body(begin, end) for disjoint ranges that cover [0, count), on as many threads as there are. Each
// range writes only its own results; the split is not specified, so nothing may depend on it.
void parallel_for(std::size_t count, std::size_t grain,
                  const std::function<void(std::size_t, std::size_t)>& body);

// How many threads parallel_for may use now. For sharing out work; no result may depend on it.
int parallel_threads();

// While it lives, parallel_for uses at most `threads` threads (at least 1). The smallest of several limits
// counts.
class ThreadLimit {
  public:
    explicit ThreadLimit(int threads);
    ~ThreadLimit();
    ThreadLimit(const ThreadLimit&) = delete;
    ThreadLimit& operator=(const ThreadLimit&) = delete;

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace slipface
