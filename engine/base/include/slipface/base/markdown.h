// Parts of pages that are made from tables.
#pragma once

#include <initializer_list>
#include <string>
#include <string_view>

namespace slipface {

// "`name`"
inline std::string markdown_code(std::string_view name) {
    return "`" + std::string(name) + "`";
}

// "| a | b |". A '|' would end a cell, and two '*' outside of code would set what is between them in italics.
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
