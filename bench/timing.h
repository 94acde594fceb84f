// What the benchmarks that print ratios measure with.
#pragma once

#include <time.h>

#include <algorithm>
#include <vector>

namespace slipface::bench {

// Processor time of this thread: what a query needs, however busy the machine is.
inline double seconds() {
    timespec time{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

// For work on several threads.
inline double wall_seconds() {
    timespec time{};
    clock_gettime(CLOCK_MONOTONIC, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

// Of a list that is not empty.
inline double median(std::vector<double> list) {
    std::sort(list.begin(), list.end());
    return list[list.size() / 2];
}

}  // namespace slipface::bench
