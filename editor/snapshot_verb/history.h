// How a golden became what it is: its commits in git, and the acts between them.
#pragma once

#include <string>

#include "goldens/report.h"

namespace slipface {

// Prints each commit that changed the golden `name` below `goldens`, or what it was made from, newest first.
// Returns the exit code.
int snapshot_history(const std::string& goldens, const std::string& name);

// Gives the entries that are not the same their last commits. Without git or a repository they have none.
void add_history(Report& report);

}  // namespace slipface
