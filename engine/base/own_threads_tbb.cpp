// The library's own threads: those of TBB.
#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <thread>

#include "own_threads.h"

namespace slipface {

namespace {

#if defined(__SANITIZE_THREAD__)

// ThreadSanitizer cannot see how the TBB library passes work between threads, so it is given plain threads:
// half of the range beside the caller, halved again.
void split_range(std::size_t begin, std::size_t end, std::size_t grain, int halvings,
                 const std::function<void(std::size_t, std::size_t)>& body) {
    if (end - begin <= grain || halvings == 0) return body(begin, end);
    const std::size_t middle = begin + (end - begin) / 2;
    std::thread other([&] { split_range(begin, middle, grain, halvings - 1, body); });
    split_range(middle, end, grain, halvings - 1, body);
    other.join();
}

#else

void split_range(std::size_t begin, std::size_t end, std::size_t grain, int,
                 const std::function<void(std::size_t, std::size_t)>& body) {
    oneapi::tbb::parallel_for(
        oneapi::tbb::blocked_range<std::size_t>(begin, end, grain),
        [&](const oneapi::tbb::blocked_range<std::size_t>& range) { body(range.begin(), range.end()); });
}

#endif

}  // namespace

void run_on_own_threads(std::size_t count, std::size_t grain,
                        const std::function<void(std::size_t, std::size_t)>& body) {
    split_range(0, count, grain, 2, body);
}

int own_threads() {
    using oneapi::tbb::global_control;
    return static_cast<int>(global_control::active_value(global_control::max_allowed_parallelism));
}

struct ThreadLimit::Impl {
    oneapi::tbb::global_control control;
};

ThreadLimit::ThreadLimit(int threads)
    : impl_(new Impl{oneapi::tbb::global_control(oneapi::tbb::global_control::max_allowed_parallelism,
                                                 static_cast<std::size_t>(std::max(threads, 1)))}) {}

ThreadLimit::~ThreadLimit() = default;

}  // namespace slipface
