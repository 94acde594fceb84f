#pragma once
#include <algorithm>

extern "C" int slipface_in_slices();  // web/one_thread.cpp
extern "C" void slipface_turn();

namespace oneapi::tbb {
// On one thread: the whole range at once, or in parts with the page's turn after each.
template <class Range, class Body>
void parallel_for(const Range& range, const Body& body) {
    if (slipface_in_slices() == 0) return body(range);
    constexpr unsigned max_parts = 64;  // a part may begin with work of its own
    const auto part = std::max(range.grain(), (range.end() - range.begin()) / max_parts);
    for (auto first = range.begin(); first < range.end(); first += part) {
        body(Range(first, std::min(first + part, range.end()), range.grain()));
        slipface_turn();
    }
}
}  // namespace oneapi::tbb
