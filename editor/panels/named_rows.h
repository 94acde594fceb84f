// A list of named things. A click selects one; its buttons rename, replace or delete it.
#pragma once

#include <functional>
#include <string>

namespace slipface {

struct NamedRow {
    std::string name, detail;  // the detail is shown muted at the right
    const char* tooltip = "";
    bool chosen = false;
    const char* replace_tooltip = "";
};
struct NamedRowResult {
    bool chosen = false, replace = false, remove = false;
    std::string renamed;  // the new name; empty: not renamed
};
// Row `index`; `problem` says why a name is not allowed.
NamedRowResult named_row(std::size_t index, const NamedRow& row,
                         const std::function<std::string(const std::string&)>& problem);

}  // namespace slipface
