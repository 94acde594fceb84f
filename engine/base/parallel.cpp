#include "slipface/base/parallel.h"

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/parallel_for.h>

#include <algorithm>

namespace slipface {

void parallel_for(std::size_t count, std::size_t grain,
                  const std::function<void(std::size_t, std::size_t)>& body) {
    grain = std::max<std::size_t>(grain, 1);
    if (count == 0) return;
    if (count <= grain) return body(0, count);
    oneapi::tbb::parallel_for(
        oneapi::tbb::blocked_range<std::size_t>(0, count, grain),
        [&](const oneapi::tbb::blocked_range<std::size_t>& range) { body(range.begin(), range.end()); });
}

struct ThreadLimit::Impl {
    oneapi::tbb::global_control control;
};

ThreadLimit::ThreadLimit(int threads)
    : impl_(new Impl{oneapi::tbb::global_control(oneapi::tbb::global_control::max_allowed_parallelism,
                                                 static_cast<std::size_t>(std::max(threads, 1)))}) {}

ThreadLimit::~ThreadLimit() = default;

}  // namespace slipface
