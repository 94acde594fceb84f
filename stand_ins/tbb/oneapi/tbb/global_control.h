#pragma once
#include "threads.h"

namespace oneapi::tbb {
class global_control {
  public:
    enum parameter { max_allowed_parallelism };
    global_control(parameter, std::size_t threads) : threads_(threads) {
        slipface_threads::add_limit(threads_);
    }
    ~global_control() { slipface_threads::remove_limit(threads_); }
    global_control(const global_control&) = delete;
    global_control& operator=(const global_control&) = delete;
    static std::size_t active_value(parameter) { return slipface_threads::limit(); }

  private:
    std::size_t threads_;
};
}  // namespace oneapi::tbb
