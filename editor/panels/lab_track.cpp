#include "panels/lab_track.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "widgets/theme.h"
#include "widgets/ui.h"

namespace slipface {

namespace {

using RunColors = std::array<ImVec4, Lab::max_runs>;

// Distinguishable without red and green (Okabe and Ito, 2008), light enough for a dark background.
const RunColors on_dark{{{0.93f, 0.94f, 0.96f, 1.0f},
                         {0.945f, 0.690f, 0.330f, 1.0f},
                         {0.34f, 0.71f, 0.91f, 1.0f},
                         {0.80f, 0.47f, 0.65f, 1.0f},
                         {0.00f, 0.76f, 0.58f, 1.0f},
                         {0.94f, 0.89f, 0.26f, 1.0f},
                         {0.90f, 0.45f, 0.15f, 1.0f},
                         {0.45f, 0.52f, 0.95f, 1.0f}}};
// Ink, rust, blue, plum, teal, umber, navy, violet. The grey at the bottom of a light view leaves only dark
// colours with a contrast of 3:1. These eight are as far apart as possible for eyes that lack one kind of
// cone.
const RunColors on_light{{{0.077f, 0.077f, 0.077f, 1.0f},
                          {0.615f, 0.231f, 0.000f, 1.0f},
                          {0.000f, 0.231f, 1.000f, 1.0f},
                          {0.385f, 0.000f, 0.385f, 1.0f},
                          {0.154f, 0.385f, 0.385f, 1.0f},
                          {0.308f, 0.231f, 0.154f, 1.0f},
                          {0.000f, 0.000f, 0.615f, 1.0f},
                          {0.462f, 0.231f, 0.692f, 1.0f}}};

}  // namespace

ImVec4 run_color(std::size_t index) {
    const RunColors& colors = ui::light_palette() ? on_light : on_dark;
    return colors[std::min(index, colors.size() - 1)];
}

ImVec4 lit_color() {
    return ui::light_palette() ? ImVec4(0.58f, 0.24f, 0.00f, 1.0f) : ImVec4(1.0f, 0.60f, 0.18f, 1.0f);
}

ImVec4 parting_color() {
    return ui::light_palette() ? ImVec4(0.60f, 0.07f, 0.05f, 1.0f) : ImVec4(0.937f, 0.400f, 0.361f, 1.0f);
}

std::string wrap_words(const std::string& text, float width) {
    std::string wrapped;
    std::size_t line = 0;  // where the last line begins
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t end = std::min(text.find(' ', at), text.size());
        const std::string word = text.substr(at, end - at);
        const std::string longer = wrapped.substr(line) + (wrapped.size() > line ? " " : "") + word;
        if (wrapped.size() > line && ImGui::CalcTextSize(longer.c_str()).x > width) {
            wrapped += '\n';
            line = wrapped.size();
        } else if (wrapped.size() > line) {
            wrapped += ' ';
        }
        wrapped += word;
        at = end + 1;
    }
    return wrapped;
}

std::string tick_text(const Lab& lab, std::size_t tick) {
    return fmt::format("tick {}, {:.3f} s", tick, static_cast<double>(tick + 1) * lab.tape().dt);
}

LabTrack lab_track(const Lab& lab, ImVec2 min, ImVec2 max) {
    return {min, max, lab.shown_first(), lab.shown_last()};
}

void lab_track_gestures(Editor& editor, const LabTrack& track, std::optional<std::size_t> pressed) {
    Lab& lab = editor.lab;
    const ImGuiIO& io = ImGui::GetIO();
    if (ImGui::IsItemActive()) {
        lab.motion = LabMotion::paused;
        lab.seek(pressed.value_or(static_cast<std::size_t>(std::max(0.0, track.tick_at(io.MousePos.x)))));
    }
    if (!ImGui::IsItemHovered() || io.MouseWheel == 0.0f) return;
    const double wheel = static_cast<double>(io.MouseWheel);
    if (io.KeyCtrl)
        lab.zoom(std::pow(0.8, wheel), track.tick_at(io.MousePos.x));
    else
        lab.step(static_cast<int>(wheel > 0.0 ? -std::ceil(wheel) : -std::floor(wheel)));
}

void draw_lab_cursor(const Editor& editor, const LabTrack& track) {
    const Lab& lab = editor.lab;
    const float x = std::round(track.x(static_cast<double>(lab.cursor())));
    if (x < track.min.x || x > track.max.x) return;
    const float scale = ui::scale();
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const ImU32 color = ui::packed(ui::palette().accent);
    list.AddLine({x, track.min.y}, {x, track.max.y}, color, 2.0f * scale);
    list.AddTriangleFilled({x - 5 * scale, track.min.y}, {x + 5 * scale, track.min.y},
                           {x, track.min.y + 7 * scale}, color);
}

}  // namespace slipface
