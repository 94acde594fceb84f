// Where parallel_for runs if the program brings no job system: own_threads_tbb.cpp, or own_threads_none.cpp
// in the library that depends on nothing (engine/c). CMake picks.
#pragma once

#include "slipface/base/parallel.h"

namespace slipface {

void run_on_own_threads(std::size_t count, std::size_t grain,
                        const std::function<void(std::size_t, std::size_t)>& body);
int own_threads();

}  // namespace slipface
