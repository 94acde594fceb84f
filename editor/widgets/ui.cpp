#include "widgets/ui.h"

#include <fmt/format.h>
#include <imgui_internal.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

#include "widgets/imgui_compat.h"
#include "widgets/theme.h"

namespace slipface::ui {
namespace {

struct TooltipTimer {
    double delay_s = 0.45;
    ImGuiID item = 0;
    double rested_s = 0.0;
    int frame = -1;
};

TooltipTimer& tooltip_timer() {
    static TooltipTimer timer;
    return timer;
}

// The frame in which Enter presses the dialog's primary button.
int& accepting_frame() {
    static int frame = -1;
    return frame;
}

std::vector<std::unique_ptr<Scope>>& menu_scopes() {
    static std::vector<std::unique_ptr<Scope>> scopes;
    return scopes;
}

// Groups have no id of their own; the item's position distinguishes them.
ImGuiID place_id() {
    const ImVec2 min = ImGui::GetItemRectMin();
    return ImHashData(&min, sizeof min, ImGui::GetItemID());
}

// Below and right of the mouse, or on its other sides near the window's edge. Text that is too high for the
// window is made wider.
void show_tooltip(const char* text) {
    const ImVec2 padding{10 * scale(), 8 * scale()}, screen = ImGui::GetIO().DisplaySize;
    const ImVec2 mouse = ImGui::GetIO().MousePos;
    const float margin = 4 * scale(), widest = screen.x - 2 * (padding.x + margin);
    float wrap = std::min(24.0f * ImGui::GetFontSize(), widest);
    ImVec2 size = ImGui::CalcTextSize(text, nullptr, false, wrap);
    while (size.y + 2 * padding.y > screen.y - 2 * margin && wrap < widest) {
        wrap = std::min(1.4f * wrap, widest);
        size = ImGui::CalcTextSize(text, nullptr, false, wrap);
    }
    size = {size.x + 2 * padding.x, size.y + 2 * padding.y};
    ImVec2 at{mouse.x + 16 * scale(), mouse.y + 16 * scale()};
    if (at.x + size.x > screen.x - margin) at.x = screen.x - margin - size.x;
    if (at.y + size.y > screen.y - margin) at.y = mouse.y - 8 * scale() - size.y;
    at = {std::round(std::max(margin, at.x)), std::round(std::max(margin, at.y))};
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, padding);
    ImGui::SetNextWindowPos(at);
    ImGui::BeginTooltip();
    ImGui::PushTextWrapPos(padding.x + wrap);
    ImGui::TextUnformatted(text);
    ImGui::PopTextWrapPos();
    if (!ImGui::GetCurrentWindow()->Hidden) record_rect("Tooltip", at, {at.x + size.x, at.y + size.y});
    ui::end(ImGui::EndTooltip);
    ImGui::PopStyleVar();
}

// What of it fits, with an ellipsis.
std::string shortened(std::string text, float width) {
    if (ImGui::CalcTextSize(text.c_str()).x <= width) return text;
    while (!text.empty() && ImGui::CalcTextSize((text + "\u2026").c_str()).x > width) {
        while (text.size() > 1 && (static_cast<unsigned char>(text.back()) & 0xC0u) == 0x80u)
            text.pop_back();
        text.pop_back();
    }
    return text + "\u2026";
}

// A property row: the label at the left, the control over the rest of the line.
std::string begin_row(const char* label) {
    const char* const end = ImGui::FindRenderedTextEnd(label);
    if (end != label) {
        const float width = ImGui::GetContentRegionAvail().x;
        const float label_width = std::min(width * 0.46f, 15.0f * ImGui::GetFontSize());
        const ImVec2 at = ImGui::GetCursorScreenPos();
        const float x = ImGui::GetCursorPosX();
        ImGui::AlignTextToFramePadding();
        ellipsis({at.x, at.y + ImGui::GetStyle().FramePadding.y}, at.x + label_width - 4.0f * scale(),
                 ImGui::GetStyleColorVec4(ImGuiCol_Text), std::string(label, end));
        ImGui::Dummy({std::max(1.0f, label_width - 4.0f * scale()), ImGui::GetFrameHeight()});
        ImGui::SameLine();
        ImGui::SetCursorPosX(x + label_width);
    }
    ImGui::SetNextItemWidth(std::max(40.0f * scale(), ImGui::GetContentRegionAvail().x));
    return std::string("##") + label;
}

}  // namespace

void set_tooltip_delay(double seconds) {
    tooltip_timer().delay_s = seconds;
}
double tooltip_due_in_s() {
    const TooltipTimer& timer = tooltip_timer();
    const bool rests = timer.frame == ImGui::GetFrameCount() && timer.rested_s < timer.delay_s;
    return rests ? timer.delay_s - timer.rested_s : std::numeric_limits<double>::infinity();
}

bool windows_are_settling() {
    const auto& windows = ImGui::GetCurrentContext()->Windows;
    return std::any_of(windows.begin(), windows.end(), [](const ImGuiWindow* window) {
        // A child that is scrolled away is hidden for good.
        const bool on_top = window->Active && (window->Flags & ImGuiWindowFlags_ChildWindow) == 0;
        return on_top && (window->HiddenFramesCanSkipItems > 0 || window->HiddenFramesCannotSkipItems > 0);
    });
}

void tooltip(const char* text) {
    if (!text || !*text) return;
    mark_as_having_tooltip();
    if (!ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled)) return;
    TooltipTimer& timer = tooltip_timer();
    const ImGuiID item = place_id();
    const int frame = ImGui::GetFrameCount();
    if (timer.item != item || timer.frame < frame - 1)
        timer.rested_s = 0.0;
    else if (timer.frame != frame)
        timer.rested_s += static_cast<double>(ImGui::GetIO().DeltaTime);
    timer.item = item;
    timer.frame = frame;
    if (timer.rested_s < timer.delay_s) return;
    show_tooltip(text);
}

bool button(const char* label, const char* tip, bool enabled, ImVec2 size) {
    ImGui::BeginDisabled(!enabled);
    const bool pressed = ImGui::Button(label, size);
    record_last_item(label, enabled);
    ImGui::EndDisabled();
    tooltip(tip);
    return pressed;
}

void request_accept() {
    accepting_frame() = ImGui::GetFrameCount() + 1;
}

bool primary_button(const char* label, bool enabled, ImVec2 size) {
    const Palette& p = palette();
    ImGui::PushStyleColor(ImGuiCol_Button, p.accent);
    ImGui::PushStyleColor(ImGuiCol_ButtonHovered, with_alpha(p.accent, 0.88f));
    ImGui::PushStyleColor(ImGuiCol_ButtonActive, with_alpha(p.accent, 0.75f));
    ImGui::PushStyleColor(ImGuiCol_Text, p.on_accent);
    const bool pressed = button(label, nullptr, enabled, size);
    ImGui::PopStyleColor(4);
    const bool in_dialog = (ImGui::GetCurrentWindow()->RootWindow->Flags & ImGuiWindowFlags_Modal) != 0;
    const bool by_key = enabled && in_dialog && accepting_frame() == ImGui::GetFrameCount();
    if (by_key) accepting_frame() = -1;
    return pressed || by_key;
}

bool icon_button(const char* icon, const char* name, const char* tip, bool active, bool enabled) {
    const Palette& p = palette();
    ImGui::PushID(name);
    ImGui::BeginDisabled(!enabled);
    ImGui::PushStyleColor(ImGuiCol_Button, active ? with_alpha(p.accent, 0.22f) : ImVec4(0, 0, 0, 0));
    if (active) ImGui::PushStyleColor(ImGuiCol_Text, p.accent);
    const float side = icon_button_side();
    const bool pressed = ImGui::Button(icon && *icon ? icon : name, {icon && *icon ? side : 0.0f, side});
    ImGui::PopStyleColor(active ? 2 : 1);
    record_last_item(name, enabled, active);
    ImGui::EndDisabled();
    tooltip(tip);
    ImGui::PopID();
    return pressed;
}

bool checkbox(const char* label, bool* value, const char* tip) {
    const char* const end = ImGui::FindRenderedTextEnd(label);
    const float gap = ImGui::GetStyle().ItemInnerSpacing.x, text = ImGui::CalcTextSize(label, end).x;
    const float room = ImGui::GetContentRegionAvail().x - ImGui::GetFrameHeight() - gap;
    if (text <= room || end == label) {
        const bool changed = ImGui::Checkbox(label, value);
        record_last_item(label, true, *value);
        tooltip(tip);
        return changed;
    }
    // A label that is too long ends in an ellipsis.
    const bool changed = ImGui::Checkbox((std::string("##") + label).c_str(), value);
    record_last_item(label, true, *value);
    tooltip(tip);
    ImGui::SameLine(0, gap);
    const ImVec2 at = ImGui::GetCursorScreenPos();
    ellipsis({at.x, at.y + ImGui::GetStyle().FramePadding.y}, at.x + room,
             ImGui::GetStyleColorVec4(ImGuiCol_Text), std::string(label, end));
    ImGui::Dummy({std::max(1.0f, room), ImGui::GetFrameHeight()});
    tooltip(tip);
    return changed;
}

bool number_slider(const char* id, double* value, double minimum, double maximum, const char* format,
                   bool logarithmic) {
    const ImGuiSliderFlags flags =
        ImGuiSliderFlags_AlwaysClamp | (logarithmic ? ImGuiSliderFlags_Logarithmic : ImGuiSliderFlags_None);
    ImGui::PushStyleColor(ImGuiCol_SliderGrab, ImVec4(0, 0, 0, 0));
    ImGui::PushStyleColor(ImGuiCol_SliderGrabActive, ImVec4(0, 0, 0, 0));
    // Dragging is relative, a double click types: a press alone changes nothing.
    const float speed =
        static_cast<float>((maximum - minimum) / std::max(1.0, static_cast<double>(ImGui::CalcItemWidth())));
    const bool changed =
        ImGui::DragScalar(id, ImGuiDataType_Double, value, speed, &minimum, &maximum, format, flags);
    ImGui::PopStyleColor(2);
    const bool active = ImGui::IsItemActive();
    if (!ImGui::IsItemVisible() || ImGui::TempInputIsActive(ImGui::GetItemID())) return changed;
    // The slider's grab, computed for an id that no item has, so that it changes nothing.
    const ImRect frame(ImGui::GetItemRectMin(), ImGui::GetItemRectMax());
    constexpr ImGuiID nobody = ~ImGuiID{0};
    ImRect grab;
    ImGui::SliderBehavior(frame, nobody, ImGuiDataType_Double, value, &minimum, &maximum, format, flags,
                          &grab);
    const float inset = ImGui::GetStyle().FrameRounding, thick = std::max(2.0f, std::round(2.0f * scale()));
    const float left = frame.Min.x + inset, right = frame.Max.x - inset, bottom = frame.Max.y - scale();
    const float at = std::clamp(grab.GetCenter().x, left, right);
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const ImVec4 color = palette().accent;
    list.AddRectFilled({left, bottom - thick}, {right, bottom}, packed(with_alpha(color, 0.18f)));
    list.AddRectFilled({left, bottom - thick}, {at, bottom},
                       packed(with_alpha(color, active ? 1.0f : 0.75f)));
    list.AddRectFilled({at - thick, bottom - 2 * thick}, {at + thick, bottom + scale()},
                       packed(with_alpha(color, active ? 1.0f : 0.9f)), thick);
    return changed;
}

bool slider(const char* label, double* value, double minimum, double maximum, const char* format,
            const char* tip) {
    ImGui::BeginGroup();
    const std::string id = begin_row(label);
    const bool changed = number_slider(id.c_str(), value, minimum, maximum, format);
    record_last_item(label);
    ui::end(ImGui::EndGroup);
    tooltip(tip);
    return changed;
}

bool drag_vec3(const char* label, double* xyz, float speed, const char* format, const char* tip) {
    static constexpr const char* axes[] = {"X", "Y", "Z"};
    static constexpr ImU32 marks[] = {IM_COL32(222, 92, 88, 255), IM_COL32(116, 184, 92, 255),
                                      IM_COL32(88, 142, 226, 255)};
    ImGui::BeginGroup();
    begin_row(label);
    const float gap = ImGui::GetStyle().ItemInnerSpacing.x;
    const float width = (ImGui::CalcItemWidth() - 2.0f * gap) / 3.0f;
    ImGui::PushID(label);
    const Scope scope(label);
    bool changed = false;
    for (int axis = 0; axis < 3; ++axis) {
        if (axis > 0) ImGui::SameLine(0, gap);
        ImGui::SetNextItemWidth(std::max(1.0f, width));
        ImGui::PushID(axis);
        changed |=
            ImGui::DragScalar("##value", ImGuiDataType_Double, xyz + axis, speed, nullptr, nullptr, format);
        ImGui::PopID();
        record_last_item(axes[axis]);
        const ImVec2 min = ImGui::GetItemRectMin(), max = ImGui::GetItemRectMax();
        ImGui::GetWindowDrawList()->AddRectFilled({min.x, min.y + 4 * scale()},
                                                  {min.x + 2 * scale(), max.y - 4 * scale()}, marks[axis]);
    }
    ImGui::PopID();
    ui::end(ImGui::EndGroup);
    tooltip(tip);
    return changed;
}

bool combo(const char* label, int* index, const char* const* names, int count, const char* tip) {
    ImGui::BeginGroup();
    const std::string id = begin_row(label);
    const float room =
        ImGui::CalcItemWidth() - ImGui::GetFrameHeight() - 2.0f * ImGui::GetStyle().FramePadding.x;
    const std::string preview = shortened(*index >= 0 && *index < count ? names[*index] : "", room);
    bool changed = false;
    const bool open = ImGui::BeginCombo(id.c_str(), preview.c_str());
    if (open)
        record_again(label);
    else
        record_last_item(label);
    if (open) {
        const Scope scope(label);
        for (int i = 0; i < count; ++i) {
            if (selectable(names[i], i == *index)) {
                changed = i != *index;
                *index = i;
            }
        }
        ui::end(ImGui::EndCombo);
    }
    ui::end(ImGui::EndGroup);
    tooltip(tip);
    return changed;
}

bool input_text(const char* label, std::string* text, const char* hint) {
    const std::string id = begin_row(label);
    const bool changed = ImGui::InputTextWithHint(id.c_str(), hint ? hint : "", text);
    record_last_item(label);
    mark_as_text_box();
    return changed;
}

bool input_lines(const char* label, std::string* text, ImVec2 size) {
    const bool changed = ImGui::InputTextMultiline(label, text, size);
    record_last_item(label);
    mark_as_text_box();
    return changed;
}

namespace {

struct SearchFocus {
    ImGuiID box = 0;  // will have the keyboard
    bool caret_to_end = false;
    int frame = -1;
};
SearchFocus& search_focus() {
    static SearchFocus focus;
    return focus;
}

// Dear ImGui selects the whole text of a box that gets the keyboard: the next letter would replace it.
int move_caret_to_end(ImGuiInputTextCallbackData* data) {
    if (std::exchange(search_focus().caret_to_end, false))
        data->CursorPos = data->SelectionStart = data->SelectionEnd = data->BufTextLen;
    return 0;
}

}  // namespace

bool search_box(const char* label, std::string* text, const char* hint) {
    SearchFocus& focus = search_focus();
    const ImGuiID id = ImGui::GetID(label);
    const ImGuiWindow* const root = ImGui::GetCurrentWindow()->RootWindow;
    const bool docked = (root->Flags & ImGuiWindowFlags_NoBringToFrontOnFocus) != 0;
    if (!docked && root->Appearing) {
        ImGui::SetKeyboardFocusHere();
        focus = {id, false, 0};
    }
    bool changed = false;
    if (focus.box == id) {
        focus.frame = ImGui::GetFrameCount();
        ImVector<ImWchar>& typed = ImGui::GetIO().InputQueueCharacters;
        for (const ImWchar c : typed) {
            char utf8[5] = {};
            ImTextCharToUtf8(utf8, c);
            *text += utf8;
            changed = true;
        }
        typed.resize(0);
        focus.caret_to_end = true;
    }
    ImGui::SetNextItemWidth(std::max(40.0f * scale(), ImGui::GetContentRegionAvail().x));
    changed |=
        ImGui::InputTextWithHint(label, hint, text, ImGuiInputTextFlags_CallbackAlways, move_caret_to_end);
    if (focus.box == id && ImGui::IsItemActive()) focus.box = 0;
    record_last_item(label);
    mark_as_text_box();
    return changed;
}

bool typing() {
    const ImGuiID active = ImGui::GetActiveID();
    // Dear ImGui itself says so only a frame after the box was entered.
    return ImGui::GetIO().WantTextInput || (active != 0 && ImGui::GetInputTextState(active)) ||
           (search_focus().box != 0 && search_focus().frame >= ImGui::GetFrameCount() - 1);
}

bool selectable(const char* label, bool selected) {
    const bool pressed = ImGui::Selectable(label, selected);
    record_last_item(label, true, selected);
    return pressed;
}

bool menu_item(const char* label, const char* shortcut, bool checked, bool enabled, const char* tip,
               const char* icon) {
    const bool pressed = ImGui::MenuItemEx(label, icon, shortcut, checked, enabled);
    record_last_item(label, enabled, checked);
    tooltip(tip);
    return pressed;
}

bool begin_menu(const char* label) {
    // A submenu, too, is no higher than the window: Dear ImGui 1.90 lets it grow out of it.
    const float highest =
        ImGui::GetMainViewport()->WorkSize.y - 2 * ImGui::GetStyle().DisplaySafeAreaPadding.y;
    ImGui::SetNextWindowSizeConstraints({0, 0}, {FLT_MAX, highest});
    const bool open = ImGui::BeginMenu(label);
    if (open) {
        record_again(label);
        menu_scopes().push_back(std::make_unique<Scope>(label));
    } else {
        record_last_item(label);
    }
    return open;
}

void end_menu() {
    menu_scopes().pop_back();
    ui::end(ImGui::EndMenu);
}

bool tab(const char* label, bool front) {
    const Palette& p = palette();
    ImGui::PushStyleColor(ImGuiCol_Button, front ? p.raised : ImVec4(0, 0, 0, 0));
    ImGui::PushStyleColor(ImGuiCol_Text, front ? p.text : p.muted);
    const bool pressed = ImGui::Button(label);
    ImGui::PopStyleColor(2);
    record_last_item(label, true, front);
    return pressed;
}

void flow(float width, float spacing) {
    const float gap = spacing < 0.0f ? ImGui::GetStyle().ItemSpacing.x : spacing;
    const float end = ImGui::GetCursorScreenPos().x + ImGui::GetContentRegionAvail().x;
    if (ImGui::GetItemRectMax().x + gap + width <= end) ImGui::SameLine(0, gap);
}

Chips::Chips() : right_(ImGui::GetCursorScreenPos().x + ImGui::GetContentRegionAvail().x) {
    ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {8 * scale(), 2 * scale()});
    ImGui::PushStyleVar(ImGuiStyleVar_FrameRounding, 10 * scale());
    push_font(fonts().small);
}

Chips::~Chips() {
    ImGui::PopFont();
    ImGui::PopStyleVar(2);
}

bool Chips::chip(const char* name, std::size_t count, bool shown) {
    const Palette& p = palette();
    const std::string label = fmt::format("{}  {}###{}", name, count, name);
    if (!std::exchange(first_, false)) {
        ImGui::SameLine(0, 4 * scale());
        if (ImGui::GetCursorScreenPos().x + button_width(label.c_str()) > right_) ImGui::NewLine();
    }
    ImGui::PushStyleColor(ImGuiCol_Button, shown ? with_alpha(p.accent, 0.20f) : p.raised);
    ImGui::PushStyleColor(ImGuiCol_Text, shown ? p.text : p.muted);
    const bool pressed = ImGui::Button(label.c_str());
    ImGui::PopStyleColor(2);
    record_last_item(name, true, shown);
    tooltip(shown ? "Click to hide these" : "Click to show these");
    return pressed;
}

float button_width(const char* label) {
    return ImGui::CalcTextSize(label, nullptr, true).x + 2.0f * ImGui::GetStyle().FramePadding.x;
}

float icon_button_side() {
    return ImGui::GetFrameHeight() + 4.0f * scale();
}

void ellipsis(ImVec2 at, float right, const ImVec4& color, const std::string& text) {
    const ImVec2 size = ImGui::CalcTextSize(text.c_str());
    ImGui::PushStyleColor(ImGuiCol_Text, color);
    ellipsis_text(*ImGui::GetWindowDrawList(), at, {right, at.y + size.y}, right, text.c_str(),
                  text.c_str() + text.size(), &size);
    ImGui::PopStyleColor();
}

void heading(const char* text) {
    ImGui::Dummy({0, 2.0f * scale()});
    push_font(fonts().semibold);
    ImGui::PushStyleColor(ImGuiCol_Text, palette().muted);
    ImGui::PushTextWrapPos(0.0f);
    ImGui::TextUnformatted(text);
    ImGui::PopTextWrapPos();
    ImGui::PopStyleColor();
    ImGui::PopFont();
}

void muted_text(const char* text) {
    ImGui::PushStyleColor(ImGuiCol_Text, palette().muted);
    ImGui::PushTextWrapPos(0.0f);
    ImGui::TextUnformatted(text);
    ImGui::PopTextWrapPos();
    ImGui::PopStyleColor();
}

}  // namespace slipface::ui
