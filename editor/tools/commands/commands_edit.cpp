// Commands on the history and on parts of the level that are not faces.
#include "tools/commands/command_actions.h"
#include "tools/commands/command_rows.h"
#include "tools/commands/icons.h"
#include "tools/playtest/spawns.h"

namespace slipface {

using namespace command_actions;

std::vector<Command> edit_commands() {
    return {
        {"edit.undo", icons::undo, "Undo", "Edit", "Undo the last step", "back revert", ctrl("Z"), can_undo,
         nullptr, undo},
        {"edit.redo", icons::redo, "Redo", "Edit", "Redo the last undone step", "again repeat",
         ctrl_shift("Z"), can_redo, nullptr, redo},
        {"edit.redo_alternative", icons::redo, "Redo", "", "Redo the last undone step", "again repeat",
         ctrl("Y"), can_redo, nullptr, redo},
        {"edit.set_spawn", icons::flag, "Set spawn point", "Edit",
         "Move the main spawn to the face under the mouse, or to a selected face, or to the middle of the "
         "view, facing the view's direction",
         "start player begin", key("P"), has_document, nullptr, set_spawn_on_target},
        {"edit.add_spawn", icons::flag, "Add spawn", "Edit",
         "Add a spawn on the face under the mouse, or on a selected face, or in the middle of the view, "
         "facing the view's direction",
         "start player begin", ctrl_shift("P"), has_document, nullptr, add_spawn},
    };
}

}  // namespace slipface
