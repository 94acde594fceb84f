// Snapshots in several processes: each renders what it is told by name and answers with one line. A process
// that dies takes only the snapshot with it that it had in hand.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "snapshots/suite_set.h"

namespace slipface {

enum class WorkKind { check, render, approve };

struct WorkArguments {
    WorkKind kind = WorkKind::check;
    SuiteArguments suite;
    std::string out = "out/snapshots";
    bool twice = false;         // check: render twice
    bool force = false;         // approve: rewrite what passes, too
    bool quick = false;         // approve: pack pictures fast instead of small
    bool any_renderer = false;  // approve: not only software
    int jobs = 1;
};

// Does one snapshot. `state` same means that it worked; for `render` and `approve` the message names the
// files.
GoldenResult do_work(Studio& studio, const WorkArguments& arguments, const std::string& name);

// Does all of `names`, here or in `jobs` processes, and calls `done` as they finish, in no special order.
// Returns the renderer. The error is that no process can be started.
Result<std::string> do_all_work(const WorkArguments& arguments, const SuiteSet& set,
                                const std::vector<std::string>& names,
                                const std::function<void(const GoldenResult&)>& done);

// The other end: reads names from standard input until it ends, writes results to standard output.
int run_worker(const WorkArguments& arguments);

}  // namespace slipface
