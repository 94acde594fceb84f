// Finding commands by a few letters.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "tools/commands.h"

namespace slipface {

// How well `text` answers `query`, upper and lower case alike: higher is better, nothing when a word of the
// query is missing. A word is found whole, at the beginning of a word, inside one, or as letters in this
// order.
std::optional<int> fuzzy_score(std::string_view query, std::string_view text);

// The commands that answer the query, the best first; those run lately first among equals, and when nothing
// is asked. A command that cannot run now comes after those that can.
std::vector<const Command*> find_commands(const Editor& editor, std::string_view query);

}  // namespace slipface
