#include "tools/commands/docs.h"

#include <fmt/format.h>

#include <algorithm>

#include "slipface/base/markdown.h"
#include "tools/commands/commands.h"

namespace slipface {

std::string commands_markdown() {
    std::string text =
        "# Commands\n\n"
        "**What it is.** Every command of the editor, from the table that makes menus, toolbar, keys "
        "and tooltips.\n\n"
        "**How you use it.** By menu or key, by name with Ctrl+P, in scripts by its id. Shortcuts go "
        "by the letter on the key. W A S D Q E fly while the right mouse button is down.\n\n"
        "**What it costs.** A command that changes the level is one step of undo.\n\n";
    std::vector<std::string_view> menus;
    for (const Command& command : commands())
        if (std::find(menus.begin(), menus.end(), command.menu) == menus.end()) menus.push_back(command.menu);
    std::stable_partition(menus.begin(), menus.end(), [](std::string_view menu) { return !menu.empty(); });
    for (const std::string_view menu : menus) {
        std::string title(menu.empty() ? "Without a menu entry" : menu);
        if (const std::size_t slash = title.find('/'); slash != std::string::npos)
            title.replace(slash, 1, ", ");
        text += fmt::format("## {}\n\n", title);
        text += markdown_row({"Command", "Shortcut", "Id", "What it does"}) +
                markdown_row({"---", "---", "---", "---"});
        for (const Command& command : commands())
            if (std::string_view(command.menu) == menu)
                text += markdown_row(
                    {command.label, command.shortcut.text(), markdown_code(command.id), command.description});
        text += "\n";
    }
    text.pop_back();
    return text;
}

}  // namespace slipface
