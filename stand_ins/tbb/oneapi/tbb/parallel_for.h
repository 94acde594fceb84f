// What the project calls of TBB, over the threads of stand_ins/tbb/threads.cpp.
#pragma once
#include <algorithm>

#include "threads.h"

namespace oneapi::tbb {
template <class Range, class Body>
void parallel_for(const Range& range, const Body& body) {
    constexpr std::size_t parts_for_each_thread = 4;
    const std::size_t count = range.end() - range.begin();
    const std::size_t threads = slipface_threads::allowed();
    const std::size_t size =
        std::max<std::size_t>(range.grain(), count / (threads * parts_for_each_thread) + 1);
    slipface_threads::run((count + size - 1) / size, [&](std::size_t part) {
        const std::size_t first = range.begin() + part * size;
        body(Range(first, std::min<std::size_t>(first + size, range.end()), range.grain()));
    });
}
}  // namespace oneapi::tbb
