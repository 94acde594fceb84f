// What each `slipface snapshot ...` does. All return the exit code and print what they did.
#pragma once

#include "snapshots/worker.h"

namespace slipface {

struct CheckArguments {
    WorkArguments work;
    std::vector<std::string> only;  // names with * and ?; none: all
    std::string shard;              // "2/4"
    std::string actual;             // compare: folder of pictures rendered before
    std::string from;               // approve, review: a report.json
    std::string reason;
    bool detailed = false;  // the finer exit codes
    bool timing = false, quiet = false;
    bool sheet = false;  // render: contact sheets besides
    bool prune = false, in_ci = false;
    bool orphans_only = false, json = false;
};

// How a check ended, for the shell. Detailed: 1 differences, 2 only missing goldens or orphans, 3 something
// could not be rendered, 4 a golden cannot be read; the worst counts, in the order 4, 3, 1, 2.
int exit_code_of(const std::vector<GoldenResult>& entries, bool detailed);

int snapshot_check(const CheckArguments& arguments);
int snapshot_compare(const CheckArguments& arguments);
int snapshot_render(const CheckArguments& arguments);
int snapshot_approve(const CheckArguments& arguments);
int snapshot_list(const CheckArguments& arguments);
int snapshot_merge(const std::vector<std::string>& reports, const CheckArguments& arguments);
int snapshot_diff(const std::string& expected, const std::string& actual, const std::string& profile,
                  const std::string& image, bool json);

// True when one of the variables is set by which CI systems tell that they run.
bool in_ci();

}  // namespace slipface
