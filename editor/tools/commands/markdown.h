// Parts of the pages that are made from tables.
#pragma once

#include <fmt/format.h>

#include <string>
#include <string_view>

namespace slipface {

inline std::string markdown_code(const char* name) {
    return fmt::format("`{}`", name);
}

// A '|' would end a cell.
inline std::string markdown_row(std::initializer_list<std::string_view> cells) {
    std::string line = "|";
    for (const std::string_view text : cells) {
        line += ' ';
        for (const char c : text)
            line += c == '|' ? std::string("\\|") : std::string(1, c);
        line += " |";
    }
    return line + "\n";
}

}  // namespace slipface
