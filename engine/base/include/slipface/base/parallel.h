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

// A program's own threads instead of this library's: `run` calls job(data, i) for every i below `count`, on
// any of its threads, and returns when all have returned. Jobs wait for no other job and never throw.
struct JobSystem {
    void (*run)(void* user, std::size_t count, void (*job)(void* data, std::size_t i), void* data) = nullptr;
    void* user = nullptr;
    int threads = 1;  // for how many it is worth cutting work into jobs
};
// Before the first use of parallel_for, or while none runs. `run` null: the library's own threads again.
void set_job_system(const JobSystem& jobs);

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
