// One thread: the whole range at once.
#pragma once

namespace oneapi::tbb {
template <class T>
struct blocked_range {
    blocked_range(T first, T last, T) : first_(first), last_(last) {}
    T begin() const { return first_; }
    T end() const { return last_; }

  private:
    T first_, last_;
};
}  // namespace oneapi::tbb
