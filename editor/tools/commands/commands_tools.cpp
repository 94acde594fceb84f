// Commands that choose a tool.
#include "tools/commands/command_actions.h"
#include "tools/commands/command_rows.h"
#include "tools/commands/icons.h"

namespace slipface {

using namespace command_actions;

std::vector<Command> tool_commands() {
    return {
        {"tools.select", icons::pointer, "Select", "Tools",
         "Click faces to select them; Ctrl+click adds and removes", "pointer pick arrow", key("Q"), always,
         tool_is<Tool::select>, use_tool<Tool::select>},
        {"tools.paint", icons::brush, "Paint", "Tools",
         "Drag over faces to give them the brush's surface type", "brush draw", key("B"), always,
         tool_is<Tool::paint>, use_tool<Tool::paint>},
        {"tools.fill", icons::fill, "Fill", "Tools",
         "Click to paint all faces connected across edges that bend less than the fill angle",
         "flood bucket coplanar region", key("G"), always, tool_is<Tool::fill>, use_tool<Tool::fill>},
        {"tools.probe", icons::crosshairs, "Probe", "Tools",
         "Click to place the player's ellipsoid, drag to sweep it through the level",
         "sweep contact ellipsoid", key("T"), always, tool_is<Tool::probe>, use_tool<Tool::probe>},
    };
}

}  // namespace slipface
