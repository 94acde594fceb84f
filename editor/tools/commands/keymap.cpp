#include "tools/commands/keymap.h"

#include <algorithm>

#include "tools/commands/commands.h"

namespace slipface {
namespace {

constexpr std::string_view prefix = "shortcut.";

}  // namespace

const Shortcut& Keymap::shortcut(const Command& command) const {
    const auto found = changed_.find(std::string_view(command.id));
    return found == changed_.end() ? command.shortcut : found->second;
}

const Command* Keymap::command_for(const Shortcut& pressed) const {
    if (pressed.key.empty()) return nullptr;
    // The user's own choice wins over the table's.
    for (const Command& command : commands())
        if (is_changed(command) && shortcut(command) == pressed) return &command;
    for (const Command& command : commands())
        if (shortcut(command) == pressed) return &command;
    return nullptr;
}

std::vector<const Command*> Keymap::users_of(const Shortcut& pressed) const {
    std::vector<const Command*> users;
    if (pressed.key.empty()) return users;
    for (const Command& command : commands())
        if (shortcut(command) == pressed) users.push_back(&command);
    return users;
}

bool Keymap::is_changed(const Command& command) const {
    return changed_.contains(std::string_view(command.id));
}

void Keymap::bind(const Command& command, const Shortcut& shortcut) {
    if (shortcut == command.shortcut)
        reset(command);
    else
        changed_.insert_or_assign(command.id, shortcut);
}

void Keymap::take_from_others(const Command& command) {
    for (const Command* other : users_of(shortcut(command)))
        if (other != &command) bind(*other, {});
}

void Keymap::reset(const Command& command) {
    if (const auto found = changed_.find(std::string_view(command.id)); found != changed_.end())
        changed_.erase(found);
}

void Keymap::load(const Preferences& preferences) {
    changed_.clear();
    for (const auto& [name, value] : preferences.values()) {
        if (!name.starts_with(prefix)) continue;
        if (const Command* const command = find_command(std::string_view(name).substr(prefix.size())))
            bind(*command, parse_shortcut(value));
    }
}

void Keymap::store(Preferences& preferences) const {
    for (const Command& command : commands()) {
        const std::string name = std::string(prefix) + command.id;
        if (is_changed(command))
            preferences.set(name, shortcut(command).text());
        else
            preferences.remove(name);
    }
}

}  // namespace slipface
