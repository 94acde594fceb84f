// Commands on the history and on parts of the level that are not faces.
#include "tools/command_actions.h"
#include "tools/command_rows.h"
#include "tools/icons.h"
#include "tools/spawns.h"

namespace slipface {

using namespace command_actions;

std::vector<Command> edit_commands() {
    return {
        {"edit.undo", icons::undo, "Undo", "Edit", "Take back the last step", "back revert", ctrl("Z"),
         can_undo, nullptr, undo},
        {"edit.redo", icons::redo, "Redo", "Edit", "Do again what was undone", "again repeat",
         ctrl_shift("Z"), can_redo, nullptr, redo},
        {"edit.redo_alternative", icons::redo, "Redo", "", "Do again what was undone", "again repeat",
         ctrl("Y"), can_redo, nullptr, redo},
        {"edit.set_spawn", icons::flag, "Set spawn point", "Edit",
         "Put the player's start on the face under the mouse, looking where the camera looks",
         "start player begin", key("P"), has_hovered, nullptr, set_spawn_hovered},
        {"edit.add_spawn", icons::flag, "Add spawn", "Edit",
         "Put a further spawn on the face under the mouse, looking where the camera looks",
         "start player begin", ctrl_shift("P"), has_hovered, nullptr, add_spawn_hovered},
    };
}

}  // namespace slipface
