// The numbers beside a golden picture: NAME.json next to NAME.png. They fail before pixels do and say why:
// which setting, which contact, where the path goes. Compared field by field, each with its own tolerance.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "slipface/base/result.h"

namespace slipface {

// What kind of change a difference comes from. Each section of the numbers belongs to one.
enum class Cause { renderer, view, level, movement, ui };
const char* cause_name(Cause cause);  // "renderer", "view", "level", "movement", "UI"

struct NumberDifference {
    std::string path;  // "/movement/tape/samples/3"
    Cause cause = Cause::level;
    std::string expected, actual;  // as JSON; "nothing" where a side lacks it
    bool decides = true;  // false: it explains and never fails a check (the renderer, hashes, widgets)
};

// Two texts of numbers. The error is the golden's: no JSON, no object, another version. Empty texts have no
// numbers, and two of them do not differ.
Result<std::vector<NumberDifference>> compare_numbers(std::string_view expected, std::string_view actual,
                                                      const std::string& location);

// JSON in the layout of the files: two-space indent, lists of plain values on one line, so that a diff shows
// one row a change.
std::string numbers_to_text(std::string_view json);

// Whether one of them fails a check.
bool any_decides(const std::vector<NumberDifference>& differences);

}  // namespace slipface
