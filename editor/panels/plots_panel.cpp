// The lab's runs as curves, tick by tick, with the timeline's cursor.
#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

#include "panels/lab_track.h"
#include "panels/panel_memory.h"
#include "slipface/sim/channels.h"
#include "widgets/theme.h"
#include "widgets/ui.h"

namespace slipface {
namespace {

// Which channels are drawn, in the order of run_channels(); one bit each.
struct Shown {
    std::uint32_t channels = 0;
    bool differences = false;  // from the recorded run, instead of the values
};

Shown usual_plots() {
    Shown first;
    for (std::size_t i = 0; i < run_channels().size(); ++i) {
        const std::string_view name = run_channels()[i].name;
        if (name == "speed" || name == "height" || name == "energy") first.channels |= 1u << i;
    }
    return first;
}

Shown& shown() {
    static Shown state = usual_plots();
    return state;
}

struct Range {
    double low = 1e300, high = -1e300;
    void add(double value) {
        if (!std::isfinite(value)) return;
        low = std::min(low, value);
        high = std::max(high, value);
    }
    bool empty() const { return !(low <= high); }
};

double value_of(const RunChannel& channel, const Lab& lab, std::size_t index, std::size_t tick,
                bool difference) {
    const double value = channel.value(lab.runs()[index].run, tick);
    if (!difference) return value;
    const TapeRun& recorded = lab.runs()[0].run;
    return tick < recorded.samples().size() ? value - channel.value(recorded, tick)
                                            : std::numeric_limits<double>::quiet_NaN();
}

void curve(ImDrawList& list, const RunChannel& channel, const Lab& lab, std::size_t index,
           const LabTrack& track, const Range& range, bool difference) {
    const TapeRun& run = lab.runs()[index].run;
    const double height = static_cast<double>(track.max.y - track.min.y);
    const double span = std::max(range.high - range.low, 1e-9);
    const auto y = [&](double value) {
        return track.max.y - static_cast<float>((value - range.low) / span * height);
    };
    const ImU32 color = ui::packed(run_color(index));
    const float width = (index == lab.explained() ? 2.0f : 1.4f) * ui::scale();
    const double step = std::max(1.0, track.ticks_per_pixel());
    std::vector<ImVec2> points;
    const auto flush = [&] {
        if (points.size() > 1)
            list.AddPolyline(points.data(), static_cast<int>(points.size()), color, 0, width);
        else if (points.size() == 1)
            list.AddCircleFilled(points[0], width, color);
        points.clear();
    };
    for (double t = std::floor(track.first); t < track.last; t += step) {
        const auto tick = static_cast<std::size_t>(std::max(0.0, t));
        if (tick >= run.samples().size()) break;
        const double value = value_of(channel, lab, index, tick, difference);
        if (!std::isfinite(value)) {
            flush();
            continue;
        }
        if (run.samples()[tick].respawned && !channel.step) flush();
        const ImVec2 point{track.x(static_cast<double>(tick)), y(value)};
        if (channel.step && !points.empty()) points.push_back({point.x, points.back().y});
        points.push_back(point);
    }
    flush();
}

void plot(Editor& editor, const RunChannel& channel, float height) {
    const Lab& lab = editor.lab;
    const bool difference = shown().differences;
    const float scale = ui::scale();
    const ImVec2 origin = ImGui::GetCursorScreenPos();
    const float width = ImGui::GetContentRegionAvail().x;
    const ImVec2 min{origin.x + 118 * scale, origin.y}, max{origin.x + width, origin.y + height - 5 * scale};
    LabTrack track = lab_track(lab, min, max);
    ImGui::PushID(channel.name);
    ImGui::SetCursorScreenPos(min);
    ImGui::InvisibleButton("plot", {std::max(1.0f, max.x - min.x), max.y - min.y});
    ui::record_last_item(channel.label);
    lab_track_gestures(editor, track);

    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddRectFilled(min, max, ui::packed(ui::palette().window), 3 * scale);
    Range range;
    for (std::size_t i = 0; i < lab.runs().size(); ++i) {
        if (!lab.runs()[i].shown || (difference && i == 0)) continue;
        const double step = std::max(1.0, track.ticks_per_pixel());
        for (double t = std::floor(track.first); t < track.last; t += step) {
            const auto tick = static_cast<std::size_t>(std::max(0.0, t));
            if (tick >= lab.runs()[i].run.samples().size()) break;
            range.add(value_of(channel, lab, i, tick, difference));
        }
    }
    if (!range.empty()) {
        const double room = std::max(0.06 * (range.high - range.low), channel.step ? 0.1 : 1e-3);
        range = {range.low - room, range.high + room};
        list.PushClipRect(min, max, true);
        if (range.low < 0.0 && range.high > 0.0) {
            const float y =
                max.y - static_cast<float>(-range.low / (range.high - range.low)) * (max.y - min.y);
            list.AddLine({min.x, y}, {max.x, y}, ui::packed(ui::palette().hairline), scale);
        }
        for (std::size_t i = lab.runs().size(); i-- > 0;)
            if (lab.runs()[i].shown && !(difference && i == 0))
                curve(list, channel, lab, i, track, range, difference);
        draw_lab_cursor(editor, track);
        list.PopClipRect();
    }

    // Name, range, and the value at the cursor.
    list.AddText({origin.x, origin.y}, ui::packed(ui::palette().text), channel.label);
    const ui::Font& font = ui::fonts().small;
    float y = origin.y + ImGui::GetTextLineHeight();
    list.PushClipRect(origin, {min.x - 4 * scale, max.y}, true);
    for (std::size_t i = 0; i < lab.runs().size(); ++i) {
        const LabRun& run = lab.runs()[i];
        if (!run.shown || lab.cursor() >= run.run.samples().size() || (difference && i == 0)) continue;
        const double value = value_of(channel, lab, i, lab.cursor(), difference);
        const std::string text =
            std::isfinite(value) ? fmt::format("{:.3f} {}", value + 0.0, channel.unit) : "none";
        list.AddText(font.face, font.pixels, {origin.x, y}, ui::packed(run_color(i)), text.c_str());
        y += font.pixels + scale;
    }
    list.PopClipRect();
    if (!range.empty() && height > 40 * scale) {
        const ImU32 quiet = ui::packed(ui::palette().muted);
        list.AddText(font.face, font.pixels, {min.x + 3 * scale, min.y + scale}, quiet,
                     fmt::format("{:.2f}", range.high).c_str());
        list.AddText(font.face, font.pixels, {min.x + 3 * scale, max.y - font.pixels - scale}, quiet,
                     fmt::format("{:.2f}", range.low + 0.0).c_str());
    }
    ImGui::SetCursorScreenPos({origin.x, origin.y + height});
    ImGui::PopID();
}

}  // namespace

void forget_plots() {
    shown() = usual_plots();
}

void plots_panel(Editor& editor) {
    if (!editor.document) return;
    const ui::Scope scope("Plots");
    if (!editor.lab.has_tape() || editor.playtest) {
        ui::muted_text(
            "Walk the level or open a tape to see its speed, height, energy and more, tick by tick.");
        return;
    }
    Shown& state = shown();
    const auto channels = run_channels();
    {
        const ui::Scope toggles("Show");
        bool first = true;
        const auto check_width = [](const char* label) {
            return ImGui::GetFrameHeight() + ImGui::GetStyle().ItemInnerSpacing.x +
                   ImGui::CalcTextSize(label).x;
        };
        for (std::size_t i = 0; i < channels.size(); ++i) {
            if (!*channels[i].label) continue;
            bool on = (state.channels >> i) & 1u;
            if (!std::exchange(first, false)) ui::flow(check_width(channels[i].label), 10 * ui::scale());
            if (ui::checkbox(channels[i].label, &on, channels[i].meaning)) state.channels ^= 1u << i;
        }
        ui::flow(check_width("Differences"), 10 * ui::scale());
        ui::checkbox("Differences", &state.differences, "Difference of each run from the recorded one");
    }
    const auto count = static_cast<float>(std::popcount(state.channels));
    if (count == 0) return;
    const float room = ImGui::GetContentRegionAvail().y;
    const float height = std::max(38 * ui::scale(), std::floor(room / count) - ui::scale());
    for (std::size_t i = 0; i < channels.size(); ++i)
        if ((state.channels >> i) & 1u) plot(editor, channels[i], height);
}

}  // namespace slipface
