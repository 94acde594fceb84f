// Where each widget was drawn.
#include <imgui_internal.h>

#include <algorithm>

#include "widgets/ui.h"

namespace slipface::ui {
namespace {

struct Registry {
    std::map<std::string, WidgetRect, std::less<>> complete, current;
    std::string prefix;
    std::string bring_into_view;
    WidgetRect* last = nullptr;  // in `current`
    float scale = 1.0f;
};

Registry& registry() {
    static Registry instance;
    return instance;
}

// What a label shows. The part after "###" is the name if there is one, the part after "##" if nothing is
// shown.
std::string_view visible_name(std::string_view label) {
    if (const std::size_t id = label.find("###"); id != std::string_view::npos) return label.substr(id + 3);
    const std::size_t hash = label.find("##");
    return hash == 0 ? label.substr(2) : label.substr(0, hash);
}

void note_window(WidgetRect& rect) {
    const ImGuiWindow& window = *ImGui::GetCurrentWindowRead();
    rect.visible = window.ClipRect.Contains(rect.centre());
    rect.clip_min = window.ClipRect.Min;
    rect.clip_max = window.ClipRect.Max;
    rect.window = window.Name;
}

}  // namespace

const std::map<std::string, WidgetRect, std::less<>>& widgets() {
    return registry().complete;
}

void begin_widget_frame() {
    Registry& r = registry();
    r.current.clear();
    r.last = nullptr;
    r.prefix.clear();
}

void end_widget_frame() {
    Registry& r = registry();
    r.complete.swap(r.current);
    r.last = nullptr;
}

void bring_into_view(std::string_view path) {
    registry().bring_into_view = path;
}

std::string widget_path(std::string_view name) {
    std::string path = registry().prefix;
    path += visible_name(name);
    return path;
}

Scope::Scope(std::string_view name) : length_(registry().prefix.size()) {
    registry().prefix += visible_name(name);
    registry().prefix += '/';
}

Scope::~Scope() {
    registry().prefix.resize(std::min(length_, registry().prefix.size()));
}

void record_last_item(std::string_view name, bool enabled, std::optional<bool> checked) {
    Registry& r = registry();
    WidgetRect rect;
    rect.min = ImGui::GetItemRectMin();
    rect.max = ImGui::GetItemRectMax();
    rect.checked = checked;
    rect.enabled = enabled && (ImGui::GetCurrentContext()->CurrentItemFlags & ImGuiItemFlags_Disabled) == 0;
    note_window(rect);
    std::string path = widget_path(name);
    if (path == r.bring_into_view) {
        if (!rect.visible) ImGui::SetScrollHereY(0.5f);
        r.bring_into_view.clear();
    }
    r.last = &r.current.try_emplace(std::move(path), std::move(rect)).first->second;
}

void mark_as_table_row() {
    const ImGuiTable* const table = ImGui::GetCurrentContext()->CurrentTable;
    if (!registry().last || !table) return;
    WidgetRect& rect = *registry().last;
    rect.clip_min.x = table->InnerClipRect.Min.x;
    rect.clip_max.x = table->InnerClipRect.Max.x;
    // The outermost headers extend beyond the table's sides by the padding of their cells, where nothing is
    // drawn.
    const float reach = table->CellSpacingX1 + table->CellSpacingX2;
    rect.min.x = std::max(rect.min.x, std::min(rect.min.x + reach, rect.clip_min.x));
    rect.max.x = std::min(rect.max.x, std::max(rect.max.x - reach, rect.clip_max.x));
    rect.visible = ImRect(rect.clip_min, rect.clip_max).Contains(rect.centre());
}

void mark_as_ground() {
    if (registry().last) registry().last->ground = true;
}

void mark_as_text_box() {
    if (registry().last) registry().last->text_box = true;
}

void mark_as_having_tooltip() {
    // The item may be a name beside the widget, which is not recorded.
    const ImRect item(ImGui::GetItemRectMin(), ImGui::GetItemRectMax());
    if (WidgetRect* const last = registry().last; last && item.Contains(ImRect(last->min, last->max)))
        last->has_tooltip = true;
}

void record_rect(std::string_view name, ImVec2 min, ImVec2 max) {
    WidgetRect rect;
    rect.min = min;
    rect.max = max;
    note_window(rect);
    rect.ground = true;
    registry().current.try_emplace(widget_path(name), std::move(rect));
}

void record_again(std::string_view name) {
    Registry& r = registry();
    const std::string path = widget_path(name);
    if (const auto found = r.complete.find(path); found != r.complete.end())
        r.current.try_emplace(path, found->second);
}

float scale() {
    return registry().scale;
}
void set_scale(float scale) {
    registry().scale = scale;
}

}  // namespace slipface::ui
