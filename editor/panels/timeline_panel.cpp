// The lab's tape, tick by tick: transport, one lane per run, and a marker for every event.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "panels/input_lanes.h"
#include "panels/lab_track.h"
#include "tools/commands/icons.h"
#include "tools/lab/why.h"
#include "widgets/theme.h"
#include "widgets/ui.h"

namespace slipface {
namespace {

constexpr float name_width = 118.0f, lane_height = 17.0f, marker_height = 20.0f, ruler_height = 16.0f,
                marker_radius = 5.5f;

enum class Shape { up, down, square, circle, diamond, cross, dot };

struct Marker {
    const char* kind;  // as events name it
    const char* words;
    Shape shape;
    ImVec4 color;
};

// Each kind has its own shape, so that the colour is not needed to distinguish them.
const Marker markers[] = {
    {"jump", "jumps off", Shape::up, {0.34f, 0.71f, 0.91f, 1}},
    {"land", "lands on", Shape::down, {0.45f, 0.78f, 0.545f, 1}},
    {"leave ground", "leaves the ground", Shape::up, {0.62f, 0.66f, 0.72f, 1}},
    {"surface", "comes onto", Shape::square, {0.80f, 0.47f, 0.65f, 1}},
    {"climb", "takes hold of", Shape::square, {0.90f, 0.62f, 0.0f, 1}},
    {"stick", "sticks to", Shape::square, {0.90f, 0.62f, 0.0f, 1}},
    {"contact", "touches a wall", Shape::circle, {1.0f, 0.86f, 0.20f, 1}},
    {"push-out", "is pushed out of geometry", Shape::diamond, {1.0f, 0.60f, 0.18f, 1}},
    {"crushed", "is crushed by a platform", Shape::cross, {0.937f, 0.400f, 0.361f, 1}},
    {"hazard", "touches a hazard", Shape::cross, {0.937f, 0.400f, 0.361f, 1}},
    {"dash", "dashes", Shape::diamond, {0.34f, 0.71f, 0.91f, 1}},
    {"grab", "grabs a ledge", Shape::square, {0.90f, 0.62f, 0.0f, 1}},
    {"crouch", "crouches", Shape::down, {0.62f, 0.66f, 0.72f, 1}},
    {"stand up", "stands up", Shape::up, {0.62f, 0.66f, 0.72f, 1}},
    {"fall", "falls out of the level", Shape::cross, {0.937f, 0.400f, 0.361f, 1}},
};

const Marker other_marker{"", "", Shape::dot, {0.62f, 0.66f, 0.72f, 1}};

const Marker& find_marker(std::string_view kind) {
    for (const Marker& marker : markers)
        if (kind == marker.kind) return marker;
    return other_marker;
}

void draw_marker(ImDrawList& list, const Marker& marker, ImVec2 c, float r) {
    const ImU32 color = ui::packed(marker.color);
    switch (marker.shape) {
        case Shape::up:
            list.AddTriangleFilled({c.x - r, c.y + r}, {c.x + r, c.y + r}, {c.x, c.y - r}, color);
            break;
        case Shape::down:
            list.AddTriangleFilled({c.x - r, c.y - r}, {c.x, c.y + r}, {c.x + r, c.y - r}, color);
            break;
        case Shape::square:
            list.AddRectFilled({c.x - 0.8f * r, c.y - 0.8f * r}, {c.x + 0.8f * r, c.y + 0.8f * r}, color);
            break;
        case Shape::circle: list.AddCircleFilled(c, 0.85f * r, color, 16); break;
        case Shape::dot: list.AddCircleFilled(c, 0.5f * r, color, 12); break;
        case Shape::diamond:
            list.AddQuadFilled({c.x, c.y - r}, {c.x + r, c.y}, {c.x, c.y + r}, {c.x - r, c.y}, color);
            break;
        case Shape::cross:
            list.AddLine({c.x - r, c.y - r}, {c.x + r, c.y + r}, color, 2.0f * ui::scale());
            list.AddLine({c.x - r, c.y + r}, {c.x + r, c.y - r}, color, 2.0f * ui::scale());
            break;
    }
}

void command_button(Editor& editor, const char* id, const char* icon = nullptr) {
    const Command* command = find_command(id);
    if (!command) return;
    const bool active = command->checked && command->checked(editor);
    const std::string tooltip = std::string(command->label) + "\n" + command->description;
    if (ui::icon_button(icon ? icon : command->icon, command->label, tooltip.c_str(), active,
                        command->enabled(editor)))
        run_command(editor, id);
}

// Buttons continue on the next line where the dock ends.
void next_button(float gap = 3.0f) {
    ui::flow(ui::icon_button_side(), gap * ui::scale());
}
constexpr float group_gap = 14.0f;

// What stands in a line with icon buttons, as high as they are.
void push_button_height() {
    const ImVec2 usual = ImGui::GetStyle().FramePadding;
    const float more = 0.5f * (ui::icon_button_side() - ImGui::GetFrameHeight());
    ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {usual.x, usual.y + more});
}

// On the line of the buttons, or wrapped on the next.
void words(const ImVec4& color, const std::string& text) {
    ui::flow(ImGui::CalcTextSize(text.c_str()).x, group_gap * ui::scale());
    push_button_height();
    ImGui::AlignTextToFramePadding();
    ImGui::PushStyleColor(ImGuiCol_Text, color);
    ImGui::PushTextWrapPos(0.0f);
    ImGui::TextUnformatted(text.c_str());
    ImGui::PopTextWrapPos();
    ImGui::PopStyleColor();
    ImGui::PopStyleVar();
}

void transport(Editor& editor) {
    Lab& lab = editor.lab;
    const ui::Scope scope("Transport");
    command_button(editor, "lab.start");
    for (const char* id : {"lab.previous_event", "lab.step_back", "lab.reverse", "lab.play",
                           "lab.step_forward", "lab.next_event", "lab.end", "lab.loop"}) {
        const bool runs = (lab.motion == LabMotion::backward && id == std::string_view("lab.reverse")) ||
                          (lab.motion == LabMotion::forward && id == std::string_view("lab.play"));
        next_button();
        command_button(editor, id, runs ? icons::pause : nullptr);
    }
    static constexpr double speeds[] = {0.1, 0.25, 0.5, 1.0, 2.0, 4.0};
    static constexpr const char* names[] = {"1/10", "1/4", "1/2", "1x", "2x", "4x"};
    int speed = 3;
    for (int i = 0; i < 6; ++i)
        if (speeds[i] == lab.speed) speed = i;
    ui::flow(66 * ui::scale(), group_gap * ui::scale());
    ImGui::SetNextItemWidth(66 * ui::scale());
    push_button_height();
    if (ImGui::Combo("##Speed", &speed, names, 6)) lab.speed = speeds[speed];
    ImGui::PopStyleVar();
    ui::record_last_item("Speed");
    ui::tooltip("Playback speed; 1x is real time");
    float gap = group_gap;
    for (const char* id : {"lab.look", "lab.resume", "lab.pin", "lab.save_tape", "lab.export_csv"}) {
        next_button(gap);
        gap = 3.0f;
        command_button(editor, id);
    }
    // A level that was painted since explains all there is to explain.
    if (!lab.doubt().empty()) words(ui::palette().accent, lab.doubt());
}

// In the names' column, which is free there: the tick, beside the markers, and whether the run is the
// recorded one, beside the ruler.
void beside_tracks(const Lab& lab, ImVec2 marker, ImVec2 ruler) {
    const auto line = [](ImVec2 at, const ImVec4& color, const std::string& text, const char* tip) {
        const float width = (name_width - 6) * ui::scale();
        ImGui::SetCursorScreenPos(at);
        ImGui::Dummy({width, ImGui::GetTextLineHeight()});
        ui::tooltip(tip);
        ui::ellipsis(at, at.x + width, color, text);
    };
    line(marker, ui::palette().text, fmt::format("tick {} of {}", lab.cursor(), lab.ticks()),
         tick_text(lab, lab.cursor()).c_str());
    constexpr const char* tip = "Whether the run ends with the same bits as when it was recorded";
    const std::optional<bool> repeats = lab.repeats();
    if (!lab.doubt().empty()) return;
    if (repeats && !*repeats)
        line(ruler, ui::palette().bad, "Does not repeat", tip);
    else if (repeats)
        line(ruler, ui::palette().good, "Replays exactly", tip);
    else if (lab.edited())
        line(ruler, ui::palette().muted, "Inputs changed", tip);
}

// Seconds under the lanes, as many as there is room for.
void ruler(ImDrawList& list, const Lab& lab, const LabTrack& track, float y) {
    const double dt = lab.tape().dt;
    const double wanted_s = 70.0 * static_cast<double>(ui::scale()) * track.ticks_per_pixel() * dt;
    double unit = 0.05;
    for (const double candidate :
         {0.05, 0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0, 30.0, 60.0, 300.0, 600.0, 3600.0}) {
        unit = candidate;
        if (candidate >= wanted_s) break;
    }
    const ui::Font& font = ui::fonts().small;
    const ImU32 color = ui::packed(ui::palette().muted);
    for (double s = std::ceil(track.first * dt / unit) * unit; s <= track.last * dt; s += unit) {
        const float x = std::round(track.x(s / dt - 1.0));
        if (x < track.min.x || x > track.max.x) continue;
        list.AddLine({x, track.max.y}, {x, track.max.y + 4 * ui::scale()}, color);
        const std::string text = unit < 1.0 ? fmt::format("{:.2f} s", s) : fmt::format("{:.0f} s", s);
        if (x + 3 * ui::scale() + ui::text_size(font, text.c_str()).x > track.max.x) continue;
        list.AddText(font.face, font.pixels, {x + 3 * ui::scale(), y}, color, text.c_str());
    }
}

// The surface under the run at each tick, in the colours of the surface types; empty in the air.
void lane(ImDrawList& list, const Document& document, const TapeRun& run, const LabTrack& track, float top,
          float bottom) {
    list.AddRectFilled({track.min.x, top}, {track.max.x, bottom}, ui::packed(ui::palette().raised), 2.0f);
    const auto& surfaces = document.level().surfaces;
    const auto samples = run.samples();
    const auto kind_of = [&](std::size_t tick) -> int {
        const TickSample& s = samples[tick];
        if (s.respawned) return -2;
        if (!(s.grounded || s.climbing || s.stuck || s.hanging)) return -1;
        return s.surface;
    };
    const double step = std::max(1.0, track.ticks_per_pixel());
    for (double t = std::floor(track.first); t < track.last;) {
        const auto tick = static_cast<std::size_t>(std::max(0.0, t));
        if (tick >= samples.size()) break;
        const int kind = kind_of(tick);
        double end = t + step;
        while (end < track.last && static_cast<std::size_t>(end) < samples.size() &&
               kind_of(static_cast<std::size_t>(end)) == kind)
            end += step;
        const float a = std::clamp(track.x(t - 0.5), track.min.x, track.max.x);
        const float b = std::clamp(track.x(std::min(end, static_cast<double>(samples.size())) - 0.5),
                                   track.min.x, track.max.x);
        if (kind == -2) {
            list.AddRectFilled({a, top}, {std::max(b, a + 1), bottom}, ui::packed(ui::palette().bad));
        } else if (kind >= 0 && static_cast<std::size_t>(kind) < surfaces.size()) {
            const auto& c = surfaces[static_cast<std::size_t>(kind)].color;
            list.AddRectFilled({a, top}, {b, bottom}, ui::packed({c[0], c[1], c[2], 0.85f}));
        }
        t = end;
    }
}

struct Event {
    std::size_t tick;
    const Marker* marker;
    const RunEvent* reported;         // with its reason; null: only its kind is known
    const SimulationEvent* observed;  // null if reported
};

std::string event_text(const Event& event) {
    return event.reported ? event.reported->text
                          : fmt::format("{} {}", event.marker->words, event.observed->detail);
}

// Those that are reported with their reasons, and of the others those that nothing of the same tick reports.
std::vector<Event> events_of(Editor& editor) {
    std::vector<Event> events;
    std::vector<std::size_t> reported;  // their ticks, ascending
    if (const RunFindings* const found = findings(editor))
        for (const RunEvent& event : found->events) {
            reported.push_back(event.first);
            if (is_shown(editor.why, event)) events.push_back({event.first, &other_marker, &event, nullptr});
        }
    for (const SimulationEvent& event : editor.lab.runs()[editor.lab.explained()].run.events()) {
        const Marker& marker = find_marker(event.kind);
        if (&marker == &other_marker && std::ranges::binary_search(reported, event.tick)) continue;
        events.push_back({event.tick, &marker, nullptr, &event});
    }
    return events;
}

// The event whose marker lies at `at`; of several the nearest.
std::optional<std::size_t> tick_of_marker_at(std::span<const Event> events, const LabTrack& track,
                                             ImVec2 at) {
    if (at.y < track.min.y || at.y > track.min.y + marker_height * ui::scale()) return std::nullopt;
    float nearest = (marker_radius + 1.0f) * ui::scale();
    std::optional<std::size_t> tick;
    for (const Event& event : events) {
        const float away = std::abs(track.x(static_cast<double>(event.tick)) - at.x);
        if (away > nearest) continue;
        nearest = away;
        tick = event.tick;
    }
    return tick;
}

void event_tooltip(std::span<const Event> events, const Lab& lab, const LabTrack& track) {
    const double tick = track.tick_at(ImGui::GetIO().MousePos.x);
    const double reach = std::max(1.0, 6.0 * track.ticks_per_pixel());
    std::string text =
        tick_text(lab, static_cast<std::size_t>(std::clamp(tick, 0.0, static_cast<double>(lab.ticks() - 1))));
    text[0] = 'T';
    int lines = 0;
    for (const Event& event : events) {
        if (std::abs(static_cast<double>(event.tick) + 0.5 - tick) > reach || lines > 6) continue;
        const auto explains_it = [&](const Event& other) {
            return other.reported && other.tick == event.tick;
        };
        if (event.observed && std::ranges::any_of(events, explains_it)) continue;
        text += fmt::format("\n{}: {}", event.tick, event_text(event));
        ++lines;
    }
    ui::tooltip(text.c_str());
}

// Names on the left; a click selects the run for the story.
void run_names(Lab& lab, const std::vector<std::size_t>& shown, ImVec2 left, float y) {
    const float scale = ui::scale();
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const ui::Scope scope("Runs");
    for (const std::size_t index : shown) {
        ImGui::SetCursorScreenPos({left.x, y});
        const LabRun& run = lab.runs()[index];
        ImGui::PushID(static_cast<int>(index));
        if (ImGui::InvisibleButton("lane", {(name_width - 8) * scale, lane_height * scale}))
            lab.explain(index);
        ui::record_last_item(run.name, true, lab.explained() == index);
        ui::tooltip((run.name + "\nClick to show this run's story").c_str());
        ImGui::PopID();
        const float middle = y + 0.5f * lane_height * scale;
        list.AddCircleFilled({left.x + 5 * scale, middle}, 4 * scale, ui::packed(run_color(index)), 16);
        ui::ellipsis({left.x + 14 * scale, middle - 0.5f * ImGui::GetTextLineHeight()},
                     left.x + (name_width - 6) * scale,
                     lab.explained() == index ? ui::palette().text : ui::palette().muted, run.name);
        y += (lane_height + 3) * scale;
    }
}

void tracks(Editor& editor) {
    Lab& lab = editor.lab;
    const float scale = ui::scale();
    const ImVec2 origin = ImGui::GetCursorScreenPos();
    const float width = ImGui::GetContentRegionAvail().x;
    std::vector<std::size_t> shown;
    for (std::size_t i = 0; i < lab.runs().size(); ++i)
        if (lab.runs()[i].shown) shown.push_back(i);
    const float lanes = static_cast<float>(shown.size()) * (lane_height + 3) * scale;
    const float height = lanes + marker_height * scale;
    const ImVec2 min{origin.x + name_width * scale, origin.y}, max{origin.x + width, origin.y + height};
    const LabTrack track = lab_track(lab, min, max);

    ImGui::SetCursorScreenPos(min);
    ImGui::InvisibleButton("track", {std::max(1.0f, max.x - min.x), height + ruler_height * scale});
    ui::record_last_item("Track");
    const std::vector<Event> events = events_of(editor);
    // A press on a marker means its event, even if the pixel belongs to another tick; dragging moves the
    // cursor.
    const bool dragged = ImGui::IsMouseDragging(ImGuiMouseButton_Left);
    lab_track_gestures(
        editor, track,
        dragged ? std::nullopt
                : tick_of_marker_at(events, track, ImGui::GetIO().MouseClickedPos[ImGuiMouseButton_Left]));
    if (ImGui::IsItemHovered() && !ImGui::IsItemActive()) event_tooltip(events, lab, track);

    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.PushClipRect({min.x, min.y - 2}, {max.x, max.y + ruler_height * scale}, true);
    float y = min.y + marker_height * scale;
    for (const std::size_t index : shown) {
        lane(list, *editor.document, lab.runs()[index].run, track, y, y + lane_height * scale);
        if (const auto& divergence = lab.divergence(index)) {
            const float x = track.x(static_cast<double>(divergence->first) - 0.5);
            list.AddRectFilled({x - scale, y - 2 * scale}, {x + scale, y + (lane_height + 2) * scale},
                               ui::packed(ui::palette().bad));
        }
        y += (lane_height + 3) * scale;
    }
    const float r = marker_radius * scale;
    for (const Event& event : events) {
        const float x = track.x(static_cast<double>(event.tick));
        if (x < min.x - r || x > max.x + r) continue;
        draw_marker(list, *event.marker, {x, min.y + 0.5f * marker_height * scale}, r);
    }
    ruler(list, lab, track, max.y + scale);
    list.PopClipRect();

    run_names(lab, shown, origin, min.y + marker_height * scale);
    beside_tracks(lab, {origin.x, min.y + scale}, {origin.x, max.y});
    const float inputs = max.y + (ruler_height + 3) * scale;
    const float end = inputs + input_lanes_height(lab);
    input_lanes(editor, track, origin.x, inputs);
    list.PushClipRect({min.x, min.y - 2}, {max.x, end}, true);
    draw_lab_cursor(editor, lab_track(lab, min, {max.x, end}));
    list.PopClipRect();
    ImGui::SetCursorScreenPos({origin.x, end});
    ImGui::Dummy({1, 1});
}

}  // namespace

void timeline_panel(Editor& editor) {
    if (!editor.document) return;
    const ui::Scope scope("Timeline");
    if (editor.playtest) {
        const Tape& tape = editor.playtest->tape();
        const std::size_t ticks = tape.tick_count();
        ui::muted_text(fmt::format("Recording: {} ticks, {:.1f} s. Press Esc to stop and show it here.",
                                   ticks, static_cast<double>(ticks) * tape.dt)
                           .c_str());
        return;
    }
    if (!editor.lab.has_tape()) {
        ui::muted_text(
            "Every playtest is recorded. Walk the level or open a tape, then step through it tick by tick.");
        ImGui::Spacing();
        if (ui::button("Play", "Walk the level from the spawn point")) run_command(editor, "playtest.start");
        ImGui::SameLine();
        if (ui::button("Open tape…", "Open a recorded run")) run_command(editor, "lab.open_tape");
        return;
    }
    transport(editor);
    if (!editor.lab.has_tape()) return;
    ImGui::Dummy({1, 2 * ui::scale()});
    tracks(editor);
}

}  // namespace slipface
