#include "tools/playtest/play_frame.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tools/editor.h"

namespace slipface {
namespace {

constexpr double look_radians_per_pixel = 0.0028;

std::string falls_text(int falls) {
    return falls == 1 ? "Fell out of the level; back at the start"
                      : fmt::format("Fell out of the level {} times; back at the start", falls);
}

}  // namespace

void play_frame(Editor& editor, const HeldKeys& held, float wheel, double seconds) {
    Playtest& playtest = *editor.playtest;
    PlaytestInput input;
    input.stick = Vec2((held.right ? 1.0 : 0.0) - (held.left ? 1.0 : 0.0),
                       (held.forward ? 1.0 : 0.0) - (held.back ? 1.0 : 0.0)) +
                  held.stick;
    if (input.stick.norm() > 1.0) input.stick.normalize();
    input.jump = held.jump;
    input.look = Vec2(held.look_pixels.x(), -held.look_pixels.y()) * look_radians_per_pixel +
                 held.look_stick * seconds;
    if (wheel != 0.0f)
        playtest.boom = std::clamp(playtest.boom * std::pow(0.88, static_cast<double>(wheel)), 1.0, 30.0);
    const int falls = playtest.falls();
    playtest.advance(editor.lab.scene(*editor.document), editor.document->level().movement, input, seconds);
    if (playtest.falls() > falls) editor.status = falls_text(playtest.falls());
}

}  // namespace slipface
