// Parts of a loop on several threads, for builds without TBB.
#pragma once
#include <cstddef>
#include <functional>

namespace slipface_threads {

// Calls body(i) for each i below `parts`, on the caller and on threads that wait for work. A part may call
// run() itself. The first exception of a part is thrown again here, after the others have ended.
void run(std::size_t parts, const std::function<void(std::size_t)>& body);

// How many threads run() uses now: those of the processor, or of the arena that the caller is in, but none
// beyond limit().
std::size_t allowed();

// The smallest of the limits that were added and not removed; without any, the processor's threads.
std::size_t limit();
void add_limit(std::size_t threads);
void remove_limit(std::size_t threads);

// While it lives, run() on the thread that made it uses `threads` threads.
class Arena {
  public:
    explicit Arena(std::size_t threads);
    ~Arena();
    Arena(const Arena&) = delete;
    Arena& operator=(const Arena&) = delete;

  private:
    std::size_t before_;
};

}  // namespace slipface_threads
