#pragma once

namespace oneapi::tbb {
template <class T>
struct blocked_range {
    blocked_range(T first, T last, T grain) : first_(first), last_(last), grain_(grain) {}
    T begin() const { return first_; }
    T end() const { return last_; }
    T grain() const { return grain_; }

  private:
    T first_, last_, grain_;
};
}  // namespace oneapi::tbb
namespace tbb = oneapi::tbb;
