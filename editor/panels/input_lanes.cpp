#include "panels/input_lanes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "panels/panel_memory.h"
#include "slipface/sim/tape_edit.h"
#include "widgets/theme.h"
#include "widgets/ui.h"

namespace slipface {
namespace {

constexpr float lane_height = 13.0f, lane_gap = 2.0f, edge = 5.0f;

struct Lane {
    std::string name;   // "jump"
    std::string label;  // "Jump"
    ButtonSet buttons;  // none: the stick's lane
};

enum class Grip { none, first, last, whole, draw, choose };

// What the mouse does, from the press of its button on.
struct Hand {
    Grip grip = Grip::none;
    ButtonSet buttons;
    TickRange press{};                   // as it was; where it began, while one is drawn or chosen
    std::size_t tick = 0;                // under the mouse, at the beginning
    std::shared_ptr<const Tape> tape{};  // as it was
    bool changed = false;                // one step of undo was made
    TickRange chosen{};                  // ticks of the stick that the pad bends
    bool bending = false, bent = false;  // on the pad
};

Hand& hand() {
    static Hand state;
    return state;
}

std::vector<Lane> lanes_of(const Lab& lab) {
    std::vector<Lane> lanes{{"stick", "Stick", {}}};
    const Tape& tape = lab.tape();
    ButtonSet used = buttons_of(tape);
    used.set(Button::jump);
    for (std::size_t bit = 0; bit < ButtonSet::capacity; ++bit) {
        ButtonSet one;
        one.bits = used.bits & (std::uint32_t{1} << bit);
        if (one.bits == 0) continue;
        const std::string name = button_names(tape, one).front();
        const ButtonInfo* info = find_button(name);
        lanes.push_back({name, info ? info->label : name, one});
    }
    return lanes;
}

// One step of undo for a whole drag.
void change(Editor& editor, Tape tape) {
    Hand& now = hand();
    const Status status = editor.lab.edit(*editor.document, std::move(tape), now.changed);
    now.changed = true;
    editor.status = status ? "Changed the inputs; can be undone" : status.error().text();
}

std::size_t tick_under(const Lab& lab, const LabTrack& track, float x) {
    const double last = static_cast<double>(lab.ticks());
    return static_cast<std::size_t>(std::clamp(track.tick_at(x), 0.0, last - 1.0));
}

// Which part of which press is at `x`.
Grip grip_at(const std::vector<TickRange>& presses, const LabTrack& track, float x, TickRange& found) {
    const float reach = edge * ui::scale();
    for (const TickRange& press : presses) {
        const float a = track.x(static_cast<double>(press.first) - 0.5);
        const float b = track.x(static_cast<double>(press.last) - 0.5);
        if (x < a - reach || x > b + reach) continue;
        found = press;
        // The middle of a short press still moves it.
        const float inner = std::min(reach, (b - a) / 3.0f);
        if (x < a + inner) return Grip::first;
        if (x > b - inner) return Grip::last;
        return Grip::whole;
    }
    return Grip::none;
}

// Where the press goes if the mouse went from `from` to `to`.
TickRange dragged(const Hand& now, std::size_t to, std::size_t ticks) {
    const auto moved = [&](std::size_t tick) {
        const auto by = static_cast<std::ptrdiff_t>(to) - static_cast<std::ptrdiff_t>(now.tick);
        return static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(static_cast<std::ptrdiff_t>(tick) + by, 0,
                                                                   static_cast<std::ptrdiff_t>(ticks)));
    };
    TickRange press = now.press;
    switch (now.grip) {
        case Grip::first: press.first = std::min(moved(press.first), press.last - 1); break;
        case Grip::last: press.last = std::max(moved(press.last), press.first + 1); break;
        case Grip::whole: {
            const std::size_t length = press.last - press.first;
            press.first = std::min(moved(press.first), ticks - std::min(length, ticks));
            press.last = press.first + length;
            break;
        }
        case Grip::draw:
        case Grip::choose: press = {std::min(now.tick, to), std::max(now.tick, to) + 1}; break;
        case Grip::none: break;
    }
    return press;
}

std::string press_text(const Lab& lab, const TickRange& press) {
    return fmt::format("ticks {} to {}, {:.3f} s", press.first, press.last - 1,
                       static_cast<double>(press.last - press.first) * lab.tape().dt);
}

void drag_button(Editor& editor, const LabTrack& track, const Lane& lane) {
    Lab& lab = editor.lab;
    Hand& now = hand();
    const ImGuiIO& io = ImGui::GetIO();
    const std::vector<TickRange> presses = presses_of(lab.tape(), lane.buttons);
    TickRange under;
    const Grip grip = grip_at(presses, track, io.MousePos.x, under);
    if (ImGui::IsItemActivated()) {
        TickRange held;
        const Grip pressed = grip_at(presses, track, io.MouseClickedPos[ImGuiMouseButton_Left].x, held);
        now.grip = pressed == Grip::none ? Grip::draw : pressed;
        now.buttons = lane.buttons;
        now.press = held;
        now.tick = tick_under(lab, track, io.MouseClickedPos[ImGuiMouseButton_Left].x);
        now.tape = lab.shared_tape();
        now.changed = false;
    }
    if (ImGui::IsItemActive() && now.buttons == lane.buttons && now.tape &&
        ImGui::IsMouseDragging(ImGuiMouseButton_Left)) {
        const TickRange press = dragged(now, tick_under(lab, track, io.MousePos.x), now.tape->tick_count());
        const TickRange from = now.grip == Grip::draw ? TickRange{} : now.press;
        change(editor, move_press(*now.tape, lane.buttons, from, press));
        lab.seek(press.first);
    } else if (ImGui::IsItemDeactivated()) {
        if (!now.changed) lab.seek(now.tick);
        now.grip = Grip::none;
        now.tape.reset();
    }
    if (!ImGui::IsItemHovered() || ImGui::IsItemActive()) return;
    if (grip == Grip::first || grip == Grip::last) ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeEW);
    if (grip == Grip::whole) ImGui::SetMouseCursor(ImGuiMouseCursor_Hand);
    if (grip == Grip::none) {
        ui::tooltip((lane.label + "\nDrag here to hold it").c_str());
        return;
    }
    ui::tooltip(fmt::format("{}, {}\nDrag its middle or an end; the right button deletes it", lane.label,
                            press_text(lab, under))
                    .c_str());
    if (ImGui::IsMouseClicked(ImGuiMouseButton_Right)) {
        now.changed = false;
        change(editor, with_buttons(lab.tape(), under.first, under.last, lane.buttons, false));
    }
}

void choose_ticks(Editor& editor, const LabTrack& track) {
    Lab& lab = editor.lab;
    Hand& now = hand();
    const float x = ImGui::GetIO().MousePos.x;
    if (ImGui::IsItemActivated()) {
        now.grip = Grip::choose;
        now.tick = tick_under(lab, track, ImGui::GetIO().MouseClickedPos[ImGuiMouseButton_Left].x);
    }
    if (ImGui::IsItemActive() && ImGui::IsMouseDragging(ImGuiMouseButton_Left))
        now.chosen = dragged(now, tick_under(lab, track, x), lab.ticks());
    if (!ImGui::IsItemDeactivated() || now.grip != Grip::choose) {
        if (ImGui::IsItemHovered() && !ImGui::IsItemActive())
            ui::tooltip("Stick\nClick a part, or drag over ticks, to bend the stick there");
        return;
    }
    now.grip = Grip::none;
    if (!ImGui::IsMouseDragPastThreshold(ImGuiMouseButton_Left))
        for (const StickSpan& span : stick_spans(lab.tape()))
            if (now.tick >= span.first && now.tick < span.last) now.chosen = {span.first, span.last};
    lab.motion = LabMotion::paused;
    lab.seek(now.chosen.first);
    now.bent = now.bending = false;
    ImGui::OpenPopup("Stick");
}

// The direction of the stick, seen from above with -Z upwards, as the view from above shows the level.
void draw_stick(ImDrawList& list, ImVec2 middle, float radius, const Vec2& wish, ImU32 color, float width) {
    const ImVec2 tip{middle.x + radius * static_cast<float>(wish.x()),
                     middle.y + radius * static_cast<float>(wish.y())};
    list.AddLine(middle, tip, color, width);
    list.AddCircleFilled(tip, 1.3f * width, color, 8);
}

void bend(Editor& editor, const Vec2& wish) {
    Hand& now = hand();
    now.changed = now.bent;
    change(editor, with_stick(editor.lab.tape(), now.chosen.first, now.chosen.last, wish));
    now.bent = true;
}

void pad(Editor& editor, Vec2 wish) {
    Hand& now = hand();
    const float radius = 52.0f * ui::scale();
    const ImVec2 origin = ImGui::GetCursorScreenPos();
    const ImVec2 middle{origin.x + radius, origin.y + radius};
    ImGui::InvisibleButton("pad", {2.0f * radius, 2.0f * radius});
    ui::record_last_item("Pad");
    if (ImGui::IsItemActivated()) now.bent = false;
    if (ImGui::IsItemActive()) {
        const ImVec2 at = ImGui::GetIO().MousePos;
        wish = {static_cast<double>((at.x - middle.x) / radius),
                static_cast<double>((at.y - middle.y) / radius)};
        if (wish.norm() > 1.0) wish.normalize();
        // Whole hundredths, which read well in the tape's text; no longer than 1.
        wish = Vec2((wish * 100.0).array().round() / 100.0);
        if (wish.norm() > 1.0) wish.normalize();
        bend(editor, wish);
    }
    if (!ImGui::IsItemActive()) ui::tooltip("Drag the stick: up is -Z of the level, right is +X");
    const ui::Palette& p = ui::palette();
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddCircleFilled(middle, radius, ui::packed(p.raised), 48);
    list.AddCircle(middle, radius, ui::packed(p.hairline), 48, ui::scale());
    list.AddLine({middle.x - radius, middle.y}, {middle.x + radius, middle.y}, ui::packed(p.hairline));
    list.AddLine({middle.x, middle.y - radius}, {middle.x, middle.y + radius}, ui::packed(p.hairline));
    draw_stick(list, middle, radius, wish, ui::packed(p.accent), 3.0f * ui::scale());
    const ui::Font& font = ui::fonts().small;
    list.AddText(font.face, font.pixels, {middle.x + 3 * ui::scale(), origin.y + ui::scale()},
                 ui::packed(p.muted), "-Z");
    list.AddText(font.face, font.pixels, {middle.x + radius - 17 * ui::scale(), middle.y + ui::scale()},
                 ui::packed(p.muted), "+X");
}

void stick_popup(Editor& editor) {
    if (!ImGui::BeginPopup("Stick")) return;
    Lab& lab = editor.lab;
    Hand& now = hand();
    const ui::Scope scope("Stick");
    now.chosen.last = std::clamp<std::size_t>(now.chosen.last, 1, lab.ticks());
    now.chosen.first = std::min(now.chosen.first, now.chosen.last - 1);
    Vec2 wish = Vec2::Zero();
    for (const StickSpan& span : stick_spans(lab.tape()))
        if (now.chosen.first >= span.first && now.chosen.first < span.last) wish = span.wish;
    ImGui::TextUnformatted(press_text(lab, now.chosen).c_str());
    pad(editor, wish);
    ImGui::SameLine();
    ImGui::BeginGroup();
    double degrees =
        wish.isZero(0.0) ? 0.0 : std::atan2(wish.x(), -wish.y()) * 180.0 / std::numbers::pi + 0.0;
    double strength = std::min(wish.norm(), 1.0) * 100.0;
    const float width = 150 * ui::scale();
    const auto turned = [&] {
        const double angle = degrees * std::numbers::pi / 180.0;
        const Vec2 way = Vec2(std::sin(angle), -std::cos(angle)) * (strength / 100.0);
        return way.norm() > 1.0 ? Vec2(way.normalized()) : way;
    };
    ImGui::SetNextItemWidth(width);
    if (ui::number_slider("Direction", &degrees, -180.0, 180.0, "%.0f\u00b0")) {
        if (strength == 0.0) strength = 100.0;
        bend(editor, turned());
    }
    if (ImGui::IsItemDeactivated()) now.bent = false;
    ui::tooltip("From -Z to the right");
    ImGui::SetNextItemWidth(width);
    if (ui::number_slider("Strength", &strength, 0.0, 100.0, "%.0f %%")) bend(editor, turned());
    if (ImGui::IsItemDeactivated()) now.bent = false;
    ui::tooltip("0: at rest; 100: as far as it goes");
    const std::size_t length = now.chosen.last - now.chosen.first;
    if (ui::button("Repeat", "Insert these ticks once more after them")) {
        now.changed = false;
        change(editor, insert_ticks(lab.tape(), now.chosen.last, length));
    }
    ImGui::SameLine();
    if (ui::button("Remove", "Take these ticks out of the tape; what follows comes earlier",
                   length < lab.ticks())) {
        now.changed = false;
        change(editor, remove_ticks(lab.tape(), now.chosen.first, now.chosen.last));
        ImGui::CloseCurrentPopup();
    }
    ui::end(ImGui::EndGroup);
    ui::end(ImGui::EndPopup);
}

void draw_stick_lane(ImDrawList& list, const Lab& lab, const LabTrack& track, float top, float bottom) {
    const float middle = 0.5f * (top + bottom), radius = 0.42f * (bottom - top);
    for (const StickSpan& span : stick_spans(lab.tape())) {
        const float a = std::max(track.x(static_cast<double>(span.first) - 0.5), track.min.x);
        const float b = std::min(track.x(static_cast<double>(span.last) - 0.5), track.max.x);
        if (b <= a || span.wish.isZero(0.0)) continue;
        ImVec4 color = ui::palette().accent;
        color.w = 0.18f + 0.30f * static_cast<float>(std::min(1.0, span.wish.norm()));
        list.AddRectFilled({a, top}, {b, bottom}, ui::packed(color));
        list.AddLine({a, top}, {a, bottom}, ui::packed(ui::palette().window));
        if (b - a > 2.6f * radius)
            draw_stick(list, {a + 1.3f * radius, middle}, radius, span.wish, ui::packed(ui::palette().text),
                       1.5f * ui::scale());
    }
    const Hand& now = hand();
    if (now.chosen.last == 0 || !(now.grip == Grip::choose || ImGui::IsPopupOpen("Stick"))) return;
    list.AddRect({track.x(static_cast<double>(now.chosen.first) - 0.5), top},
                 {track.x(static_cast<double>(now.chosen.last) - 0.5), bottom},
                 ui::packed(ui::palette().text), 0, 0, 1.5f * ui::scale());
}

void draw_presses(ImDrawList& list, const Lab& lab, const LabTrack& track, const Lane& lane, float top,
                  float bottom) {
    for (const TickRange& press : presses_of(lab.tape(), lane.buttons)) {
        const float a = track.x(static_cast<double>(press.first) - 0.5);
        const float b = std::max(track.x(static_cast<double>(press.last) - 0.5), a + ui::scale());
        if (b < track.min.x || a > track.max.x) continue;
        list.AddRectFilled({a, top + ui::scale()}, {b, bottom - ui::scale()},
                           ui::packed(ui::palette().accent), 2.0f * ui::scale());
    }
}

}  // namespace

float input_lanes_height(const Lab& lab) {
    return static_cast<float>(lanes_of(lab).size()) * (lane_height + lane_gap) * ui::scale();
}

void input_lanes(Editor& editor, const LabTrack& track, float left, float y) {
    Lab& lab = editor.lab;
    const ui::Scope scope("Inputs");
    const float scale = ui::scale();
    ImDrawList& list = *ImGui::GetWindowDrawList();
    for (const Lane& lane : lanes_of(lab)) {
        const float bottom = y + lane_height * scale;
        const float text = 0.5f * (y + bottom - ImGui::GetTextLineHeight());
        ui::ellipsis({left + 14 * scale, text}, track.min.x - 6 * scale, ui::palette().muted, lane.label);
        ImGui::SetCursorScreenPos({track.min.x, y});
        ImGui::PushID(lane.name.c_str());
        ImGui::InvisibleButton("lane", {std::max(1.0f, track.max.x - track.min.x), lane_height * scale});
        ImGui::PopID();
        ui::record_last_item(lane.name);
        lane.buttons.bits == 0 ? choose_ticks(editor, track) : drag_button(editor, track, lane);
        list.PushClipRect({track.min.x, y}, {track.max.x, bottom}, true);
        list.AddRectFilled({track.min.x, y}, {track.max.x, bottom}, ui::packed(ui::palette().raised),
                           2.0f * scale);
        if (lane.buttons.bits == 0)
            draw_stick_lane(list, lab, track, y, bottom);
        else
            draw_presses(list, lab, track, lane, y, bottom);
        list.PopClipRect();
        y = bottom + lane_gap * scale;
    }
    stick_popup(editor);
}

void forget_input_lanes() {
    hand() = {};
}

}  // namespace slipface
