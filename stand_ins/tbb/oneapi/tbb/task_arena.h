#pragma once
#include "threads.h"

namespace oneapi::tbb {
class task_arena {
  public:
    explicit task_arena(int threads) : threads_(static_cast<std::size_t>(threads)) {}
    template <class Body>
    auto execute(const Body& body) {
        const slipface_threads::Arena arena(threads_);
        return body();
    }

  private:
    std::size_t threads_;
};
}  // namespace oneapi::tbb
namespace tbb = oneapi::tbb;
