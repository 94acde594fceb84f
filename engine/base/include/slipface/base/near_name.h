// How similar two names are, for suggestions in messages about unknown names.
#pragma once

#include <cstddef>
#include <string_view>

namespace slipface {

// The Levenshtein distance: letters to insert, delete or replace to make `b` of `a`. O(a.size() * b.size()).
std::size_t edit_distance(std::string_view a, std::string_view b);

}  // namespace slipface
