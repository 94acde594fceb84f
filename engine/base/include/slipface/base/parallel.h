// Data parallelism with results that do not depend on the number of threads.
#pragma once

#include <cstddef>
#include <functional>

namespace slipface {

// Calls body(begin, end) for disjoint ranges that cover [0, count), on as many threads as there are. Each
// range writes only its own results; the split is not specified, so nothing may depend on it.
void parallel_for(std::size_t count, std::size_t grain,
                  const std::function<void(std::size_t, std::size_t)>& body);

}  // namespace slipface
