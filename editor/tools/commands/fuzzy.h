// Finding commands by a few letters.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "tools/commands/commands.h"

namespace slipface {

// How well `text` matches `query`, ignoring case: higher is better, nothing if a word of the query is
// missing. A word matches as a whole, at the beginning of a word, inside one, or as letters in this order.
std::optional<int> fuzzy_score(std::string_view query, std::string_view text);

// The commands that match the query, best first. Among equals, and for an empty query, recently run ones come
// first. Commands that cannot run now come after all others.
std::vector<const Command*> find_commands(const Editor& editor, std::string_view query);

}  // namespace slipface
