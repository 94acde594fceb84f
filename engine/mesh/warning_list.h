#pragma once

#include <fmt/format.h>

#include <string>
#include <utility>

#include "slipface/base/result.h"

namespace slipface {

// Warnings up to a limit, so that a file with a million faults does not fill memory.
class WarningList {
  public:
    explicit WarningList(std::size_t limit) : limit_(limit) {}

    void add(const std::string& location, std::string message) {
        if (list_.size() < limit_) {
            list_.push_back({location, std::move(message)});
        } else {
            ++unlisted_;
        }
    }

    std::size_t room() const { return limit_ - list_.size(); }
    // True if the next warning would not be listed; its text is then not needed.
    bool full() const { return list_.size() >= limit_; }
    void add_unworded() { ++unlisted_; }

    // An empty list with the same limit, for a part of the work; append() adds it to this one.
    WarningList empty_copy() const { return WarningList(limit_); }
    void append(WarningList& later) {
        for (Diagnostic& warning : std::exchange(later.list_, {}))
            add(warning.location, std::move(warning.message));
        unlisted_ += std::exchange(later.unlisted_, 0);
    }

    // Returns the list, ended by the number of warnings that are not listed.
    Warnings take(const std::string& location) {
        if (unlisted_ > 0) list_.push_back({location, fmt::format("{} more warnings", unlisted_)});
        unlisted_ = 0;
        return std::exchange(list_, {});
    }

  private:
    std::size_t limit_;
    std::size_t unlisted_ = 0;
    Warnings list_;
};

}  // namespace slipface
