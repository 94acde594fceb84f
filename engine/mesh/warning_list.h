#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "slipface/base/result.h"

namespace slipface {

// Warnings up to a limit, so that a file with a million faults does not fill memory. Those with the same
// message are one, at the place of the first, that says how many more there are.
class WarningList {
  public:
    explicit WarningList(std::size_t limit) : limit_(limit) {}

    void add(const std::string& location, std::string message, std::size_t count = 1) {
        const auto same = std::find_if(list_.begin(), list_.end(),
                                       [&](const Entry& entry) { return entry.warning.message == message; });
        if (same != list_.end()) {
            same->count += count;
        } else if (!full()) {
            list_.push_back({{location, std::move(message)}, count});
        } else {
            unlisted_ += count;
        }
    }

    std::size_t room() const { return limit_ - list_.size(); }
    // True if the next warning would not be listed; its text is then not needed.
    bool full() const { return list_.size() >= limit_; }
    void add_unworded() { ++unlisted_; }

    // An empty list with the same limit, for a part of the work; append() adds it to this one.
    WarningList empty_copy() const { return WarningList(limit_); }
    void append(WarningList& later) {
        for (Entry& entry : std::exchange(later.list_, {}))
            add(entry.warning.location, std::move(entry.warning.message), entry.count);
        unlisted_ += std::exchange(later.unlisted_, 0);
    }

    // Returns the list, ended by the number of warnings that are not listed.
    Warnings take(const std::string& location) {
        Warnings warnings;
        for (Entry& entry : std::exchange(list_, {})) {
            if (entry.count > 1) entry.warning.message += fmt::format("; {} more of these", entry.count - 1);
            warnings.push_back(std::move(entry.warning));
        }
        if (const std::size_t more = std::exchange(unlisted_, 0); more > 0)
            warnings.push_back({location, fmt::format("{} more warning{}", more, more == 1 ? "" : "s")});
        return warnings;
    }

  private:
    struct Entry {
        Diagnostic warning;
        std::size_t count;
    };

    std::size_t limit_;
    std::size_t unlisted_ = 0;
    std::vector<Entry> list_;
};

}  // namespace slipface
