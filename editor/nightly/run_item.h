// Runs the items of a night as processes of this program.
#pragma once

#include <functional>

#include "nightly/night_report.h"

namespace slipface {

struct NightRun {
    std::filesystem::path project, out;  // folders; `out` absolute
    int jobs = 1;                        // processes at a time
};

// Runs each item, as many at a time as there are jobs, and stores its result and files below `out`, so that a
// night that dies has them. `done` is called as each finishes, in any order. A process that crashes is its
// item's result.
Status run_items(const NightRun& run, const std::vector<std::pair<std::size_t, const NightItem*>>& items,
                 const std::function<void(NightResult)>& done);

// The result that lies in `out`, if its key is the item's and all its files are there.
std::optional<NightResult> stored_result(const std::filesystem::path& out, const NightItem& item,
                                         std::size_t index);

// What a process of this program printed with these arguments, and its exit code. `folder`: where it runs.
struct ChildOutput {
    int code = 0;  // 128 + signal
    std::string out, err;
};
Result<ChildOutput> run_child(const std::vector<std::string>& arguments, const std::filesystem::path& folder);

}  // namespace slipface
