// Merges the numbers and facts of two branches: git calls it instead of merging lines.
#pragma once

#include <string>
#include <string_view>

#include "slipface/base/result.h"

namespace slipface {

// What differs from `base` on one side only is taken. Lists of names are merged name by name. Error: both
// sides changed one member otherwise, which it names; texts that are no JSON.
Result<std::string> merge_facts(std::string_view base, std::string_view ours, std::string_view theirs);

}  // namespace slipface
