// Which key runs which command: the table's shortcuts, and what the user made of them.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "document/preferences.h"
#include "tools/shortcut.h"

namespace slipface {

struct Command;

class Keymap {
  public:
    // The key of the command; without one of the user's own, the table's.
    const Shortcut& shortcut(const Command& command) const;
    // The command that a pressed key runs, or null.
    const Command* command_for(const Shortcut& pressed) const;
    // The commands that have this key.
    std::vector<const Command*> users_of(const Shortcut& shortcut) const;

    bool is_changed(const Command& command) const;
    // Gives the command that key, or none if the key is empty. Others that have it keep it: that is a
    // conflict, which the window shows, until resolve() or another bind().
    void bind(const Command& command, const Shortcut& shortcut);
    void take_from_others(const Command& command);  // other commands with the same key lose it
    void reset(const Command& command);
    void reset_all() { changed_.clear(); }

    // As "shortcut.file.save = Ctrl+S" rows; an empty value means no key. Rows of commands that do not exist
    // stay in the preferences and do nothing.
    void load(const Preferences& preferences);
    void store(Preferences& preferences) const;

  private:
    std::map<std::string, Shortcut, std::less<>> changed_;  // by command id
};

}  // namespace slipface
