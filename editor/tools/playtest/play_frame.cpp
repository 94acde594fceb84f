#include "tools/playtest/play_frame.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "tools/editor.h"

namespace slipface {
namespace {

constexpr double look_radians_per_pixel = 0.0028;

std::string falls_text(int falls) {
    return falls == 1 ? "Fell out of the level; back at the start"
                      : fmt::format("Fell out of the level {} times; back at the start", falls);
}

constexpr std::array<std::pair<std::string_view, bool HeldKeys::*>, 7> flags{{{"W", &HeldKeys::forward},
                                                                              {"S", &HeldKeys::back},
                                                                              {"A", &HeldKeys::left},
                                                                              {"D", &HeldKeys::right},
                                                                              {"E", &HeldKeys::up},
                                                                              {"Q", &HeldKeys::down},
                                                                              {"Shift", &HeldKeys::fast}}};

}  // namespace

bool hold_key(HeldKeys& held, std::string_view key, bool down) {
    bool known = false;
    for (const auto& [name, flag] : flags) {
        if (key != name) continue;
        held.*flag = down;
        known = true;
    }
    for (const ButtonInfo& info : button_table()) {
        if (key != info.key) continue;
        held.buttons.set(info.button, down);
        known = true;
    }
    return known;
}

std::string movement_key_names() {
    std::vector<std::string_view> names;
    const auto add = [&](std::string_view name) {
        if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
    };
    for (const auto& [name, flag] : flags)
        add(name);
    for (const ButtonInfo& info : button_table())
        add(info.key);
    std::string text(names.front());
    for (std::size_t i = 1; i < names.size(); ++i)
        text += fmt::format("{}{}", i + 1 < names.size() ? ", " : " or ", names[i]);
    return text;
}

void play_frame(Editor& editor, const HeldKeys& held, float wheel, double seconds) {
    Playtest& playtest = *editor.playtest;
    PlaytestInput input;
    input.stick = Vec2((held.right ? 1.0 : 0.0) - (held.left ? 1.0 : 0.0),
                       (held.forward ? 1.0 : 0.0) - (held.back ? 1.0 : 0.0)) +
                  held.stick;
    if (input.stick.norm() > 1.0) input.stick.normalize();
    input.buttons = held.buttons;
    input.look = Vec2(held.look_pixels.x(), -held.look_pixels.y()) * look_radians_per_pixel +
                 held.look_stick * seconds;
    if (wheel != 0.0f)
        playtest.boom = std::clamp(playtest.boom * std::pow(0.88, static_cast<double>(wheel)), 1.0, 30.0);
    const int falls = playtest.falls();
    playtest.advance(editor.lab.scene(*editor.document), editor.document->level().movement, input, seconds);
    if (playtest.falls() > falls) editor.status = falls_text(playtest.falls());
}

}  // namespace slipface
