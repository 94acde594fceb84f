// A list of things with names: one is chosen by a click, renamed in place, replaced or deleted by its
// buttons.
#pragma once

#include <functional>
#include <string>

namespace slipface {

struct NamedRow {
    std::string name, detail;  // the detail stands muted at the right
    const char* tooltip = "";
    bool chosen = false;
    const char* replace_tooltip = "";
};
struct NamedRowResult {
    bool chosen = false, replace = false, remove = false;
    std::string renamed;  // empty: not
};
// The row number `index`; `problem` says why a name will not do.
NamedRowResult named_row(std::size_t index, const NamedRow& row,
                         const std::function<std::string(const std::string&)>& problem);

}  // namespace slipface
