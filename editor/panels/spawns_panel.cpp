// Where a walk can begin, and how deep a fall may be.
#include <fmt/format.h>

#include "panels/named_rows.h"
#include "panels/panels.h"
#include "panels/property_rows.h"
#include "slipface/level/find_start.h"
#include "tools/playtest/spawns.h"
#include "widgets/ui.h"

namespace slipface {
namespace {

void fall_limit_row(Editor& editor) {
    const Level& level = editor.document->level();
    const double lowest = level.mesh.bounds().min.y();
    double height = level.fall_limit.value_or(lowest - 60.0);
    const bool own = level.fall_limit.has_value();
    const char* const tooltip =
        "A player below this height has fallen out of the level and restarts at the spawn. Default: 60 m "
        "below the lowest point of level and spawn";
    ImGui::Spacing();
    if (!begin_property_rows("limit", label_width_of("Fall limit"))) return;
    property_row("Fall limit", tooltip, own);
    if (number_slider("Fall limit", &height, lowest - 200.0, level.mesh.bounds().max.y(), "m", tooltip)) {
        live_edit(editor, "Set fall limit");
        editor.document->set_fall_limit(height);
    }
    if (reset_cell("Fall limit", own)) editor.document->set_fall_limit(std::nullopt);
    end_property_rows();
}

}  // namespace

void spawns_panel(Editor& editor) {
    settle_live_edit(editor);
    if (!editor.document) return;
    const ui::Scope scope("Spawns");
    if (ui::button("Add spawn", "Add a spawn on a selected face, or on the one in the middle of the view"))
        add_spawn(editor);
    const std::vector<Spawn> spawns = all_spawns(editor.document->level());
    if (spawns.empty())
        ui::muted_text("None: Play begins at the origin, or on open floor near the middle of the level");
    ImGui::Spacing();
    for (std::size_t i = 0; i < spawns.size(); ++i) {
        NamedRow row;
        row.name = spawns[i].name;
        row.detail = i == 0 ? "Play begins here" : "";
        row.tooltip = "Make this the main spawn, where Play begins; a double click renames it";
        row.replace_tooltip = "Move this spawn to a selected face, or to the one in the middle of the view";
        row.chosen = i == 0;
        const NamedRowResult did = named_row(
            i, row, [&](const std::string& name) { return spawn_name_problem(*editor.document, i, name); });
        if (!did.renamed.empty()) return rename_spawn(editor, i, did.renamed);
        if (did.replace) return move_spawn(editor, i);
        if (did.remove) return remove_spawn(editor, i);
        if (did.chosen) return make_main_spawn(editor, i);
    }
    fall_limit_row(editor);
}

}  // namespace slipface
