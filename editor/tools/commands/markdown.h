// Parts of the pages that are made from tables.
#pragma once

#include <fmt/format.h>

#include <string>
#include <string_view>

namespace slipface {

inline std::string markdown_code(const char* name) {
    return fmt::format("`{}`", name);
}

// A '|' would end a cell, and two '*' outside of code would set what is between them in italics.
inline std::string markdown_row(std::initializer_list<std::string_view> cells) {
    std::string line = "|";
    for (const std::string_view text : cells) {
        line += ' ';
        bool code = false;
        for (const char c : text) {
            if (c == '`') code = !code;
            if (c == '|' || (c == '*' && !code)) line += '\\';
            line += c;
        }
        line += " |";
    }
    return line + "\n";
}

}  // namespace slipface
