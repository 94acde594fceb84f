// The fragments of the command table, one file per area (commands_<area>.cpp), and short names for writing
// rows. A new command is a row in its area's fragment. commands() joins them in the order listed in
// commands.cpp.
#pragma once

#include <string>
#include <vector>

#include "tools/commands/commands.h"

namespace slipface {

std::vector<Command> file_commands();
std::vector<Command> edit_commands();
std::vector<Command> select_commands();
std::vector<Command> view_commands();
std::vector<Command> tool_commands();
std::vector<Command> paint_commands();
std::vector<Command> prop_commands();
std::vector<Command> play_commands();
std::vector<Command> lab_commands();
std::vector<Command> review_commands();
std::vector<Command> help_commands();

// The same text for as long as the program runs: for rows that are made from other tables.
const char* lasting(std::string text);

inline Shortcut no_key() {
    return {};
}
inline Shortcut key(const char* name) {
    return {name, false, false, false};
}
inline Shortcut ctrl(const char* name) {
    return {name, true, false, false};
}
inline Shortcut shift(const char* name) {
    return {name, false, true, false};
}
inline Shortcut ctrl_shift(const char* name) {
    return {name, true, true, false};
}
inline Shortcut alt(const char* name) {
    return {name, false, false, true};
}
inline Shortcut ctrl_alt(const char* name) {
    return {name, true, false, true};
}
inline Shortcut shift_alt(const char* name) {
    return {name, false, true, true};
}

}  // namespace slipface
