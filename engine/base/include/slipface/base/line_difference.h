// How one text of lines differs from another. It is short where the texts are alike, so that it can be sent
// in place of the text.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace slipface {

// What makes `text` of `base`: rows "=FIRST COUNT" that copy lines of `base`, counted from 0, and rows
// "+LINE" that add one. O(lines) for texts without many equal lines.
std::string line_difference(std::string_view base, std::string_view text);

// The text that line_difference(base, text) was made for. Nothing: the difference has a row of another form,
// copies lines that `base` lacks, or makes a text of more than `max_bytes`.
std::optional<std::string> apply_line_difference(std::string_view base, std::string_view difference,
                                                 std::size_t max_bytes);

}  // namespace slipface
