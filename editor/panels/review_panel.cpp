// Reviewing snapshots: the list and its reasons at the side, the images in place of the view.
#include <fmt/format.h>

#include <cmath>

#include "panels/panels.h"
#include "panels/property_rows.h"
#include "panels/review_view.h"
#include "tools/review/review.h"
#include "widgets/imgui_compat.h"
#include "widgets/theme.h"
#include "widgets/ui.h"

namespace slipface {
namespace {

constexpr double blink_interval_s = 0.7;

ImVec4 color_of(const Review& review, std::size_t index) {
    const ui::Palette& p = ui::palette();
    if (review.marks[index] == ReviewMark::approved) return p.good;
    if (review.marks[index] == ReviewMark::skipped) return p.muted;
    const GoldenState state = review.report.entries[review.shown[index]].state;
    return state == GoldenState::missing || state == GoldenState::orphan ? p.accent : p.bad;
}

void list(Editor& editor) {
    Review& review = *editor.review;
    // As high as what was in it in the last frame, up to half of the panel: acts wrap.
    float* const content = ImGui::GetStateStorage()->GetFloatRef(ImGui::GetID("height of the list"), 0.0f);
    const float height =
        std::clamp(*content, 2.0f * ImGui::GetTextLineHeightWithSpacing(), 0.5f * ImGui::GetWindowHeight());
    ImGui::BeginChild("entries", {0, height}, true, ImGuiWindowFlags_NoSavedSettings);
    std::optional<std::size_t> wanted;
    for (std::size_t i = 0; i < review.shown.size(); ++i) {
        const GoldenResult& entry = review.report.entries[review.shown[i]];
        if (i == 0 || review.act_of[i] != review.act_of[i - 1]) {
            const ActRow& act = review.acts[review.act_of[i]];
            ImGui::PushTextWrapPos(0.0f);
            ImGui::TextUnformatted((act.word + ": " + act.text).c_str());
            ImGui::PopTextWrapPos();
        }
        ImGui::PushStyleColor(ImGuiCol_Text, color_of(review, i));
        ImGui::TextUnformatted(review.marks[i] == ReviewMark::approved   ? "+"
                               : review.marks[i] == ReviewMark::rejected ? "x"
                               : review.marks[i] == ReviewMark::skipped  ? "-"
                                                                         : "\u25cf");
        ImGui::PopStyleColor();
        ImGui::SameLine(1.4f * ImGui::GetFontSize());
        if (ImGui::Selectable(entry.name.c_str(), i == review.current)) wanted = i;
        ui::record_last_item(entry.name, true, i == review.current);
        ui::tooltip(golden_state_name(entry.state));
    }
    *content = ImGui::GetCursorPosY() - ImGui::GetStyle().ItemSpacing.y + ImGui::GetStyle().WindowPadding.y;
    ui::end(ImGui::EndChild);
    if (wanted) review_show(editor, *wanted);
}

void decide(Editor& editor) {
    const ImVec2 none{0, 0};
    if (ui::primary_button("Approve", review_can_approve(editor), none))
        return review_mark(editor, ReviewMark::approved);
    const ActRow& act = editor.review->acts[editor.review->act_of[editor.review->current]];
    if (act.entries.size() > 1) ui::flow(ui::button_width("Approve act"));
    if (act.entries.size() > 1 &&
        ui::button("Approve act", "Approve all that this act changed", review_can_approve(editor)))
        return review_approve_act(editor);
    ui::flow(ui::button_width("Reject"));
    if (ui::button("Reject", "Reject it and go to the next (Alt+R)"))
        return review_mark(editor, ReviewMark::rejected);
    ui::flow(ui::button_width("Skip"));
    if (ui::button("Skip", "Decide later (Alt+S)")) return review_mark(editor, ReviewMark::skipped);
    if (ui::button("Go to camera", "Open its level with the snapshot's camera (Alt+G)",
                   review_has_camera(editor)))
        review_go_to_camera(editor);
}

void modes(Review& review) {
    constexpr const char* names[review_mode_count] = {"Side by side", "Swipe", "Blink", "Heat map"};
    int mode = static_cast<int>(review.mode);
    if (ui::combo("Images", &mode, names, static_cast<int>(review_mode_count),
                  "How the two images are compared")) {
        review.mode = static_cast<ReviewMode>(mode);
        review.images = true;
    }
    if (review.mode == ReviewMode::swipe)
        ui::slider("Swipe", &review.swipe, 0.0, 1.0, "%.2f", "Expected left of the line, actual right of it");
}

void reasons(const GoldenResult& entry) {
    if (!entry.findings.empty()) ui::heading("Why");
    for (const Finding& finding : entry.findings) {
        ImGui::PushTextWrapPos(0.0f);
        ImGui::TextUnformatted(finding.text.c_str());
        ImGui::PopTextWrapPos();
        ui::muted_text(finding.pixels == 0
                           ? cause_name(finding.cause)
                           : fmt::format("{} pixels, {}", finding.pixels, cause_name(finding.cause)).c_str());
        ImGui::Spacing();
    }
    int shown = 0;
    for (const NumberDifference& number : entry.numbers) {
        if (!number.decides) continue;
        if (shown == 0) ui::heading("Numbers");
        if (++shown > 40) break;
        fact(number.path.substr(1).c_str(), number.expected + " \u2192 " + number.actual);
    }
}

void caption(ImVec2 at, const char* text) {
    const ImVec2 size = ImGui::CalcTextSize(text), pad{8 * ui::scale(), 4 * ui::scale()};
    ImDrawList* const draw = ImGui::GetWindowDrawList();
    draw->AddRectFilled(at, {at.x + size.x + 2 * pad.x, at.y + size.y + 2 * pad.y},
                        ui::packed(ui::with_alpha(ui::palette().window, 0.85f)), 4 * ui::scale());
    draw->AddText({at.x + pad.x, at.y + pad.y}, ui::packed(ui::palette().text), text);
}

struct Box {
    ImVec2 min, size;
};

// How large an image is drawn that it fits: smaller, or whole times its pixels.
float fitting_scale(const Image& image, ImVec2 room) {
    const float scale =
        std::min(room.x / static_cast<float>(image.width), room.y / static_cast<float>(image.height));
    return scale > 1.0f ? std::floor(scale) : scale;
}

ImVec2 scaled(const Image& image, float scale) {
    return {std::floor(static_cast<float>(image.width) * scale),
            std::floor(static_cast<float>(image.height) * scale)};
}

Box in_middle(const Box& room, ImVec2 size) {
    return {{std::floor(room.min.x + 0.5f * (room.size.x - size.x)),
             std::floor(room.min.y + 0.5f * (room.size.y - size.y))},
            size};
}

Box fitted(const Image& image, const Box& room) {
    return in_middle(room, scaled(image, fitting_scale(image, room.size)));
}

// Part of the image from `from` to `to`, fractions of its width.
void show(unsigned texture, const Box& box, float from = 0.0f, float to = 1.0f) {
    ImGui::GetWindowDrawList()->AddImage(ui::texture_id(texture), {box.min.x + from * box.size.x, box.min.y},
                                         {box.min.x + to * box.size.x, box.min.y + box.size.y}, {from, 0},
                                         {to, 1});
}

void missing(const Box& room, const char* text) {
    const ImVec2 size = ImGui::CalcTextSize(text);
    ImGui::GetWindowDrawList()->AddText(
        {room.min.x + 0.5f * (room.size.x - size.x), room.min.y + 0.5f * (room.size.y - size.y)},
        ui::packed(ui::palette().muted), text);
}

// Beside each other or one above the other, whichever is larger, and close together.
void side_by_side(const Review& review, FrameContext& frame, const Box& room) {
    const Image& model = review.actual.rgba.empty() ? review.expected : review.actual;
    if (model.rgba.empty())
        return missing(room, is_input(review.entry()->name) ? "What it is made from, without an image"
                                                            : "There is no image");
    const float gap = 8 * ui::scale();
    const ImVec2 inside{room.size.x - gap, room.size.y - gap};
    const float across = fitting_scale(model, {0.5f * (inside.x - gap), inside.y}),
                below = fitting_scale(model, {inside.x, 0.5f * (inside.y - gap)});
    const bool stacked = below > across;
    const ImVec2 size = scaled(model, std::max(across, below));
    const ImVec2 step = stacked ? ImVec2{0, size.y + gap} : ImVec2{size.x + gap, 0};
    Box box = in_middle(room, {size.x + step.x, size.y + step.y});
    box.size = size;
    int slot = 0;
    for (const auto& [image, title, none] : {std::tuple(&review.expected, "Expected", "There is no golden"),
                                             std::tuple(&review.actual, "Actual", "There is no image")}) {
        if (image->rgba.empty()) {
            missing(box, none);
        } else {
            const Box own = fitted(*image, box);
            show(frame.viewport->still(slot, *image, review.images_revision), own);
            caption({own.min.x + 8, own.min.y + 8}, title);
        }
        box.min = {box.min.x + step.x, box.min.y + step.y};
        ++slot;
    }
}

}  // namespace

void review_panel(Editor& editor) {
    const ui::Scope scope("Review");
    if (!editor.review) {
        ui::muted_text(("Nothing is open for review. `slipface snapshot check` writes a report; " +
                        menu_location(*find_command("review.open")) + " opens it")
                           .c_str());
        return;
    }
    Review& review = *editor.review;
    if (review.shown.empty()) return ui::muted_text("No snapshot differs");
    ui::muted_text(
        fmt::format("{} of {} snapshots differ", review.shown.size(), review.report.entries.size()).c_str());
    list(editor);
    decide(editor);
    modes(review);
    if (const GoldenResult* entry = review.entry()) {
        ui::muted_text(entry->comparison.verdict.empty() ? entry->message.c_str()
                                                         : entry->comparison.verdict.c_str());
        reasons(*entry);
    }
}

bool review_view(Editor& editor, FrameContext& frame) {
    if (!editor.review || !editor.review->images || editor.review->entry() == nullptr ||
        frame.viewport == nullptr)
        return false;
    Review& review = *editor.review;
    const Box room{ImGui::GetCursorScreenPos(), ImGui::GetContentRegionAvail()};
    if (room.size.x < 40 || room.size.y < 40) return true;
    const bool both = !review.expected.rgba.empty() && !review.actual.rgba.empty();
    if (!both || review.mode == ReviewMode::side_by_side) {
        side_by_side(review, frame, room);
        return true;
    }
    const Box box = fitted(review.actual, room);
    const auto texture = [&](int slot, const Image& image) {
        return frame.viewport->still(slot, image, review.images_revision);
    };
    if (review.mode == ReviewMode::heat) {
        show(texture(2, review.heat), box);
        caption({box.min.x + 8, box.min.y + 8}, "Difference");
    } else if (review.mode == ReviewMode::blink) {
        review.blink_s += frame.seconds;
        if (review.blink_s > blink_interval_s) {
            review.blink_s = 0.0;
            review.blink_actual = !review.blink_actual;
        }
        frame.animating = true;
        show(review.blink_actual ? texture(1, review.actual) : texture(0, review.expected), box);
        caption({box.min.x + 8, box.min.y + 8}, review.blink_actual ? "Actual" : "Expected");
    } else {
        const auto at = static_cast<float>(review.swipe);
        ImGui::SetCursorScreenPos(box.min);
        ImGui::InvisibleButton("swipe", box.size);
        ui::record_last_item("Images");
        if (ImGui::IsItemActive() || ImGui::IsItemHovered())
            review.swipe = std::clamp(
                static_cast<double>((ImGui::GetIO().MousePos.x - box.min.x) / box.size.x), 0.0, 1.0);
        show(texture(0, review.expected), box, 0.0f, at);
        show(texture(1, review.actual), box, at, 1.0f);
        const float x = std::round(box.min.x + at * box.size.x);
        ImGui::GetWindowDrawList()->AddLine({x, box.min.y}, {x, box.min.y + box.size.y},
                                            ui::packed(ui::palette().accent), 2.0f * ui::scale());
        caption({box.min.x + 8, box.min.y + 8}, "Expected");
        caption({box.min.x + box.size.x - ImGui::CalcTextSize("Actual").x - 24 * ui::scale(), box.min.y + 8},
                "Actual");
    }
    return true;
}

}  // namespace slipface
