// What timeline and plots share: the way between ticks and pixels, the cursor, the gestures, the colours of
// runs.
#pragma once

#include <imgui.h>

#include "panels/panels.h"

namespace slipface {

// Ticks along a strip of the window. Tick t lies at the middle of its fraction of the width.
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
// Pressing and dragging scrubs, the wheel goes one tick a notch, with Ctrl it zooms. After the strip's item.
// `pressed`: the tick that was pressed, if it is not the pixel's.
void lab_track_gestures(Editor& editor, const LabTrack& track,
                        std::optional<std::size_t> pressed = std::nullopt);
void draw_lab_cursor(const Editor& editor, const LabTrack& track);

// Of run `index` of the lab, in the view as in the panels; of the record that is lit in the view; of the
// place where two runs part. At least 3:1 against the grounds of the theme in use.
ImVec4 run_color(std::size_t index);
ImVec4 lit_color();
ImVec4 parting_color();

// `text` with line breaks at spaces only, so that no number is cut in two.
std::string wrap_words(const std::string& text, float width);

// The name of a tick: "tick 214, 3.583 s".
std::string tick_text(const Lab& lab, std::size_t tick);

}  // namespace slipface
