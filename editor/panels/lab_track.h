// What timeline and plots have in common: ticks to pixels and back, the cursor, the gestures, the colours of
// runs.
#pragma once

#include <imgui.h>

#include "panels/panels.h"

namespace slipface {

// Ticks along a strip of the window. Each tick has the same width and lies in the middle of it.
struct LabTrack {
    ImVec2 min, max;
    double first = 0.0, last = 1.0;  // ticks shown, [first, last)

    float x(double tick) const {
        const double fraction = (tick + 0.5 - first) / (last - first);
        return min.x + static_cast<float>(fraction) * (max.x - min.x);
    }
    double tick_at(float x_pixel) const {
        return first +
               (static_cast<double>(x_pixel - min.x) / static_cast<double>(max.x - min.x)) * (last - first);
    }
    double ticks_per_pixel() const { return (last - first) / static_cast<double>(max.x - min.x); }
};

LabTrack lab_track(const Lab& lab, ImVec2 min, ImVec2 max);
// Pressing and dragging moves the cursor, the wheel moves it by one tick, Ctrl with the wheel zooms. Call it
// after the strip's item. `pressed`: the tick that was pressed, if not that of the pixel.
void lab_track_gestures(Editor& editor, const LabTrack& track,
                        std::optional<std::size_t> pressed = std::nullopt);
void draw_lab_cursor(const Editor& editor, const LabTrack& track);

// Colours of run `index` in the view and in the panels, of the highlighted record in the view, and of the
// position where two runs diverge. Contrast of at least 3:1 on the backgrounds of the current theme.
ImVec4 run_color(std::size_t index);
ImVec4 lit_color();
ImVec4 parting_color();

// Breaks the lines of `text` at spaces only, so that no number is split.
std::string wrap_words(const std::string& text, float width);

// The name of a tick: "tick 214, 3.583 s".
std::string tick_text(const Lab& lab, std::size_t tick);

}  // namespace slipface
