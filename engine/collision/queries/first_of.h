// The first of many results, offered in any order, in a buffer of fixed size.
#pragma once

#include <algorithm>
#include <span>

namespace slipface::detail {

template <class T>
class FirstOf {
  public:
    using Before = bool (*)(const T&, const T&);
    FirstOf(std::span<T> out, Before before) : out_(out), before_(before) {}

    // `out` is a heap with the last of them on top, so that the first ones stay, whatever the order.
    void add(const T& one) {
        ++found_;
        if (stored_ == out_.size()) {
            if (stored_ == 0 || !before_(one, out_[0])) return;
            std::ranges::pop_heap(out_.first(stored_--), before_);
        }
        out_[stored_++] = one;
        std::ranges::push_heap(out_.first(stored_), before_);
    }
    // Sorts what is stored; the number of all that were added.
    std::size_t finish() {
        std::ranges::sort_heap(out_.first(stored_), before_);
        return found_;
    }

  private:
    std::span<T> out_;
    Before before_;
    std::size_t found_ = 0, stored_ = 0;
};

}  // namespace slipface::detail
