// Snapshots in several processes. Each renders the names that it receives and answers with one line per name.
// If a process dies, only its current snapshot is lost.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "snapshot_verb/suite_set.h"

namespace slipface {

enum class WorkKind { check, render, approve };

struct WorkArguments {
    WorkKind kind = WorkKind::check;
    SuiteArguments suite;
    std::string out = "out/snapshots";
    bool twice = false;         // check: render twice
    bool force = false;         // approve: also rewrite what passes
    bool quick = false;         // approve: compress images fast instead of small
    bool here = false;          // approve: only for the libraries that draw here
    bool any_renderer = false;  // approve: also with hardware renderers
    int jobs = 1;
};

// Does one snapshot. State `same` means success; for `render` and `approve` the message names the files.
GoldenResult do_work(Studio& studio, const WorkArguments& arguments, const std::string& name);

// Does all of `names`, here or in `jobs` processes, and calls `done` as each finishes, in any order. Returns
// the renderer. Fails if no process can be started.
Result<std::string> do_all_work(const WorkArguments& arguments, const SuiteSet& set,
                                const std::vector<std::string>& names,
                                const std::function<void(const GoldenResult&)>& done);

// The worker's side: reads names from standard input until it ends, writes results to standard output.
int run_worker(const WorkArguments& arguments);

}  // namespace slipface
