// Time measurement for the benchmarks that print ratios.
#pragma once

#include <time.h>

#include <algorithm>
#include <vector>

namespace slipface::bench {

// Processor time of this thread: the cost of a query, however busy the machine is.
inline double seconds() {
    timespec time{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

// Elapsed time, for work on several threads.
inline double wall_seconds() {
    timespec time{};
    clock_gettime(CLOCK_MONOTONIC, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

// The list must not be empty.
inline double median(std::vector<double> list) {
    std::sort(list.begin(), list.end());
    return list[list.size() / 2];
}

}  // namespace slipface::bench
