#pragma once
#include <cstddef>

namespace oneapi::tbb {
struct global_control {
    enum parameter { max_allowed_parallelism };
    global_control(parameter, std::size_t) {}
    static std::size_t active_value(parameter) { return 1; }
};
}  // namespace oneapi::tbb
