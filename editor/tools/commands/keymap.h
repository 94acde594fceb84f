// Which key runs which command: the table's shortcuts with the user's changes.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "document/preferences.h"
#include "tools/commands/shortcut.h"

namespace slipface {

struct Command;

class Keymap {
  public:
    // The user's key for the command, or the table's.
    const Shortcut& shortcut(const Command& command) const;
    // The command that a pressed key runs, or null.
    const Command* command_for(const Shortcut& pressed) const;
    // The commands that have this key.
    std::vector<const Command*> users_of(const Shortcut& shortcut) const;

    bool is_changed(const Command& command) const;
    // Gives the command this key; an empty key means none. Other commands with the key also have it: a
    // conflict, which the window shows until take_from_others() or another bind().
    void bind(const Command& command, const Shortcut& shortcut);
    void take_from_others(const Command& command);  // other commands with the same key lose it
    void reset(const Command& command);
    void reset_all() { changed_.clear(); }

    // Reads and writes rows "shortcut.file.save = Ctrl+S"; an empty value means no key. Rows of unknown
    // commands stay in the preferences and have no effect.
    void load(const Preferences& preferences);
    void store(Preferences& preferences) const;

  private:
    std::map<std::string, Shortcut, std::less<>> changed_;  // by command id
};

}  // namespace slipface
