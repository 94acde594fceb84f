// Commands of the playtest, and a switch for each movement hack.
#include "slipface/base/text.h"
#include "slipface/level/preset.h"
#include "tools/commands/command_actions.h"
#include "tools/commands/command_rows.h"
#include "tools/commands/icons.h"
#include "tools/lab/lab_actions.h"

namespace slipface {

using namespace command_actions;

namespace {

void toggle_setting(Editor& editor, const SettingInfo& info) {
    MovementSettings movement = editor.document->level().movement;
    const bool on = get_setting(movement, info) != 0.0;
    if (!set_setting(movement, info, on ? 0.0 : 1.0)) return;
    editor.document->set_movement(movement,
                                  std::string(on ? "Switch off " : "Switch on ") + to_lower(info.label));
    editor.status = std::string(info.label) + (on ? " off" : " on");
}

// One for each switch of the settings table.
void add_hack_commands(std::vector<Command>& rows) {
    for (const SettingInfo& info : settings_table()) {
        if (!is_switch(info)) continue;
        rows.push_back({lasting(std::string("movement.") + info.name), "", info.label, "Playtest",
                        info.meaning, "hack switch toggle movement", no_key(), has_document,
                        [&info](const Editor& e) {
                            return e.document && get_setting(e.document->level().movement, info) != 0.0;
                        },
                        [&info](Editor& e) { toggle_setting(e, info); }});
    }
}

void add_preset_commands(std::vector<Command>& rows) {
    for (const ShippedPreset& shipped : shipped_presets()) {
        const Preset& preset = shipped.preset;
        rows.push_back({lasting(std::string("movement.preset.") + shipped.id), "", preset.name.c_str(),
                        "Playtest/Presets", preset.about.c_str(), "preset settings movement hacks defaults",
                        no_key(), has_document,
                        [&preset](const Editor& e) {
                            return e.document && e.document->level().movement == preset.settings;
                        },
                        [&preset](Editor& e) { use_preset(e, preset); }});
    }
}

}  // namespace

std::vector<Command> play_commands() {
    std::vector<Command> rows{
        {"playtest.start", icons::play, "Play", "Playtest", "Walk the level from the spawn point",
         "run walk test game", key("F5"), has_document, nullptr, start_playtest},
        {"playtest.stop", icons::stop, "Stop", "Playtest", "Return to editing", "end leave exit",
         key("Escape"), is_playing, nullptr, stop_playtest},
        {"playtest.restart", icons::restart, "Restart", "Playtest", "Restart this walk",
         "again respawn reset", key("R"), is_playing, nullptr, restart_playtest},
        {"playtest.from_here", icons::play, "Play from here", "Playtest",
         "Walk from the face under the mouse, or from a selected face, or from the middle of the view, "
         "facing "
         "the view's direction",
         "run walk test cursor hovered", alt("F5"), has_document, nullptr, play_from_target},
        {"playtest.from_view", icons::play, "Play from the view", "Playtest",
         "Walk from the face in the middle of the view, facing its direction", "run walk test camera look",
         shift_alt("F5"), has_document, nullptr, play_from_view},
        {"playtest.toggle_person", icons::person, "First person", "Playtest", "First-person view",
         "third camera view", key("V"), is_playing, is_first_person, toggle_person},
    };
    add_hack_commands(rows);
    add_preset_commands(rows);
    rows.push_back({"movement.open_preset", icons::folder_open, "Open preset…", "Playtest",
                    "Read all movement settings from a file, as one step of history",
                    "load settings movement hacks file", no_key(), has_document, nullptr,
                    ask_for_file<FileDialogKind::open_preset>});
    rows.push_back({"movement.save_preset", icons::save, "Save preset…", "Playtest",
                    "Write all movement settings into a file, for other levels and for --preset",
                    "write store settings movement hacks file", no_key(), has_document, nullptr,
                    ask_for_file<FileDialogKind::save_preset>});
    rows.push_back({"movement.reset", icons::reset, "Reset movement", "Playtest",
                    "Set every hack and parameter to its default", "default settings hacks", no_key(),
                    movement_differs, nullptr, reset_movement});
    return rows;
}

}  // namespace slipface
