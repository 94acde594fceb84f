// The verbs of `slipface snapshot`. Each prints what it did and returns the exit code.
#pragma once

#include <array>

#include "snapshot_verb/worker.h"

namespace slipface {

struct CheckArguments {
    WorkArguments work;
    std::vector<std::string> only;  // names with * and ?; none: all
    std::string shard;              // "2/4"
    std::string actual;             // compare: folder of images rendered earlier
    std::string from;               // approve, review: a report.json
    std::string act;                // approve: only what this act changed, with * and ?
    std::string reason;
    bool detailed = false;  // use the finer exit codes
    bool timing = false, quiet = false;
    bool sheet = false;  // render: also write contact sheets
    bool prune = false, in_ci = false;
    bool orphans_only = false, json = false, fingerprint = false;
};

// The shell's exit code for a check. Detailed: 1 differences, 2 only missing goldens or orphans, 3 something
// could not be rendered, 4 a golden cannot be read. If several apply, the first of 4, 3, 1, 2.
int exit_code_of(const std::vector<GoldenResult>& entries, bool detailed);

int snapshot_check(const CheckArguments& arguments);
int snapshot_compare(const CheckArguments& arguments);
int snapshot_render(const CheckArguments& arguments);
int snapshot_approve(const CheckArguments& arguments);
int snapshot_list(const CheckArguments& arguments);
int snapshot_merge(const std::vector<std::string>& reports, const CheckArguments& arguments);
// Git's merge driver: merges %O, %A and %B into %A; `name` is %P.
int snapshot_merge_driver(const std::array<std::string, 3>& files, const std::string& name);
int snapshot_diff(const std::string& expected, const std::string& actual, const std::string& profile,
                  const std::string& image, bool json);

// True if an environment variable is set that CI systems set.
bool in_ci();

}  // namespace slipface
