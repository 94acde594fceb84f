#include "tools/commands/commands.h"

#include <algorithm>
#include <array>
#include <deque>
#include <iterator>

#include "slipface/base/text.h"
#include "tools/commands/command_rows.h"

namespace slipface {
namespace {

// The order of the menus and of the rows in them.
constexpr std::array<std::vector<Command> (*)(), 11> fragments{
    file_commands, edit_commands, select_commands, view_commands,   tool_commands, paint_commands,
    prop_commands, play_commands, lab_commands,    review_commands, help_commands,
};

std::vector<Command> make_commands() {
    std::vector<Command> all;
    for (const auto fragment : fragments) {
        std::vector<Command> rows = fragment();
        std::move(rows.begin(), rows.end(), std::back_inserter(all));
    }
    return all;
}

}  // namespace

const char* lasting(std::string text) {
    static std::deque<std::string> texts;
    return texts.emplace_back(std::move(text)).c_str();
}

std::string Shortcut::text() const {
    if (key.empty()) return {};
    return std::string(ctrl ? "Ctrl+" : "") + (shift ? "Shift+" : "") + (alt ? "Alt+" : "") + key;
}

Shortcut parse_shortcut(std::string_view text) {
    Shortcut key;
    while (true) {
        if (text.starts_with("Ctrl+"))
            key.ctrl = true;
        else if (text.starts_with("Shift+"))
            key.shift = true;
        else if (text.starts_with("Alt+"))
            key.alt = true;
        else
            break;
        text.remove_prefix(text.find('+') + 1);
    }
    key.key = text;
    return key;
}

std::span<const Command> commands() {
    static const std::vector<Command> all = make_commands();
    return all;
}

const Command* find_command(std::string_view id) {
    const auto all = commands();
    const auto found =
        std::find_if(all.begin(), all.end(), [&](const Command& command) { return id == command.id; });
    return found == all.end() ? nullptr : &*found;
}

const Command* command_for(const Shortcut& pressed) {
    if (pressed.key.empty()) return nullptr;
    const auto all = commands();
    const auto found = std::find_if(all.begin(), all.end(),
                                    [&](const Command& command) { return command.shortcut == pressed; });
    return found == all.end() ? nullptr : &*found;
}

std::string command_name(const Editor& editor, const Command& command) {
    return command.name && command.enabled(editor) ? command.name(editor) : std::string(command.label);
}

std::string menu_location(const Command& command) {
    std::string path;
    const std::string_view menu(command.menu);
    for (const std::string_view part : split(menu, '/'))
        if (!part.empty()) path.append(part).append(" > ");
    return path + command.label;
}

std::string shortcut_text(const Editor& editor, const Command& command) {
    return editor.session.keymap.shortcut(command).text();
}

bool run_command(Editor& editor, std::string_view id) {
    const Command* command = find_command(id);
    if (!command || !command->enabled(editor)) return false;
    command->run(editor);
    make_brush_valid(editor);
    return true;
}

}  // namespace slipface
