// Data parallelism with results that do not depend on the number of threads.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>

namespace slipface {

// Calls body(begin, end) for disjoint ranges that cover [0, count), on all available threads. A range of at
// most `grain` items is not split. Each range must write only its own results. The split is not specified, so
// no result may depend on it.
void parallel_for(std::size_t count, std::size_t grain,
                  const std::function<void(std::size_t, std::size_t)>& body);

// The number of threads that parallel_for may use now. For dividing work; no result may depend on it.
int parallel_threads();

// While it lives, parallel_for uses at most `threads` threads (at least 1). If several limits are alive, the
// smallest applies.
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
