// Commands of the playtest, and a switch for each movement hack.
#include <array>
#include <cstdlib>
#include <utility>

#include "slipface/level/preset.h"
#include "tools/commands/command_actions.h"
#include "tools/commands/command_rows.h"
#include "tools/commands/icons.h"

namespace slipface {

using namespace command_actions;

namespace {

// One for each switch of the settings table. The ids live as long as the program.
template <std::size_t... I>
std::vector<Command> hack_commands(std::index_sequence<I...>) {
    static std::array<std::string, sizeof...(I)> ids;
    std::vector<Command> rows;
    const auto add = [&](std::size_t i, auto checked, auto run) {
        if (i >= settings_table().size()) return;
        const SettingInfo& info = settings_table()[i];
        if (!is_switch(info)) return;
        ids[i] = std::string("movement.") + info.name;
        rows.push_back({ids[i].c_str(),
                        "",
                        info.label,
                        "Playtest",
                        info.meaning,
                        "hack switch toggle movement",
                        {},
                        has_document,
                        checked,
                        run});
    };
    (add(I, setting_is_on<I>, toggle_setting<I>), ...);
    return rows;
}

// One for each shipped preset. The ids live as long as the program.
template <std::size_t... I>
std::vector<Command> preset_commands(std::index_sequence<I...>) {
    static std::array<std::string, sizeof...(I)> ids;
    std::vector<Command> rows;
    const auto add = [&](std::size_t i, auto checked, auto run) {
        if (i >= shipped_presets().size()) return;
        const ShippedPreset& shipped = shipped_presets()[i];
        ids[i] = std::string("movement.preset.") + shipped.id;
        rows.push_back({ids[i].c_str(),
                        "",
                        shipped.preset.name.c_str(),
                        "Playtest/Presets",
                        shipped.preset.about.c_str(),
                        "preset settings movement hacks defaults",
                        {},
                        has_document,
                        checked,
                        run});
    };
    (add(I, preset_is_used<I>, use_shipped_preset<I>), ...);
    return rows;
}

}  // namespace

std::vector<Command> play_commands() {
    constexpr std::size_t max_settings = 96;
    constexpr std::size_t max_presets = 16;
    if (settings_table().size() > max_settings || shipped_presets().size() > max_presets) std::abort();
    std::vector<Command> rows{
        {"playtest.start", icons::play, "Play", "Playtest", "Walk the level from the spawn point",
         "run walk test game", key("F5"), has_document, nullptr, start_playtest},
        {"playtest.stop", icons::stop, "Stop", "Playtest", "Return to editing", "end leave exit",
         key("Escape"), is_playing, nullptr, stop_playtest},
        {"playtest.restart", icons::restart, "Restart", "Playtest", "Restart this walk",
         "again respawn reset", key("R"), is_playing, nullptr, restart_playtest},
        {"playtest.from_here", icons::play, "Play from here", "Playtest",
         "Walk from the face under the mouse, facing the view's direction", "run walk test cursor hovered",
         alt("F5"), has_hovered, nullptr, play_from_hovered},
        {"playtest.toggle_person", icons::person, "First person", "Playtest", "First-person view",
         "third camera view", key("V"), is_playing, is_first_person, toggle_person},
    };
    for (Command& row : hack_commands(std::make_index_sequence<max_settings>()))
        rows.push_back(std::move(row));
    for (Command& row : preset_commands(std::make_index_sequence<max_presets>()))
        rows.push_back(std::move(row));
    rows.push_back({"movement.open_preset",
                    icons::folder_open,
                    "Open preset…",
                    "Playtest",
                    "Read all movement settings from a file, as one step of history",
                    "load settings movement hacks file",
                    {},
                    has_document,
                    nullptr,
                    ask_for_file<FileDialogKind::open_preset>});
    rows.push_back({"movement.save_preset",
                    icons::save,
                    "Save preset…",
                    "Playtest",
                    "Write all movement settings into a file, for other levels and for --preset",
                    "write store settings movement hacks file",
                    {},
                    has_document,
                    nullptr,
                    ask_for_file<FileDialogKind::save_preset>});
    rows.push_back({"movement.reset",
                    icons::reset,
                    "Reset movement",
                    "Playtest",
                    "Set every hack and parameter to its default",
                    "default settings hacks",
                    {},
                    movement_differs,
                    nullptr,
                    reset_movement});
    return rows;
}

}  // namespace slipface
