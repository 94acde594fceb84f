#pragma once

namespace oneapi::tbb {
template <class Range, class Body>
void parallel_for(const Range& range, const Body& body) {
    body(range);
}
}  // namespace oneapi::tbb
