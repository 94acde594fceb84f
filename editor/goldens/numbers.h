// The numbers beside a golden image: NAME.json next to NAME.png. They detect changes that pixels do not show,
// and name the cause: a setting, a contact, the path. Compared field by field, each with its own tolerance.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "slipface/base/result.h"

namespace slipface {

// What caused a difference. Each field of the numbers belongs to one.
enum class Cause { renderer, view, level, movement, ui, program, order };
inline constexpr std::size_t cause_count = 7;
const char* cause_name(Cause cause);  // "renderer", "view", "level", "movement", "UI", "program", "order"

struct NumberDifference {
    std::string path;  // "/movement/tape/samples/3"
    Cause cause = Cause::level;
    std::string expected, actual;  // as JSON; "nothing" on a side without the field
    bool decides = true;  // false: only explains, never fails a check (the renderer, orders, widgets)
};

// The differences of two texts of numbers. An empty text has no numbers. Errors, at `location`: a text that
// is no JSON object; another version in `expected`.
Result<std::vector<NumberDifference>> compare_numbers(std::string_view expected, std::string_view actual,
                                                      const std::string& location);

// Formats valid JSON like the files: two-space indent, lists of plain values on one line, so that a diff
// shows one row per change.
std::string numbers_to_text(std::string_view json);

// Whether at least one difference fails a check.
bool any_decides(const std::vector<NumberDifference>& differences);

}  // namespace slipface
