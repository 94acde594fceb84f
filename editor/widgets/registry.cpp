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
    float scale = 1.0f;
};

Registry& registry() {
    static Registry instance;
    return instance;
}

// What a label shows. The part after "###" stands for the whole where there is one, the part after "##" where
// nothing is shown.
std::string_view visible_name(std::string_view label) {
    if (const std::size_t id = label.find("###"); id != std::string_view::npos) return label.substr(id + 3);
    const std::size_t hash = label.find("##");
    return hash == 0 ? label.substr(2) : label.substr(0, hash);
}

}  // namespace

const std::map<std::string, WidgetRect, std::less<>>& widgets() {
    return registry().complete;
}

void begin_widget_frame() {
    Registry& r = registry();
    r.current.clear();
    r.prefix.clear();
}

void end_widget_frame() {
    Registry& r = registry();
    r.complete.swap(r.current);
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
    WidgetRect rect{.min = ImGui::GetItemRectMin(), .max = ImGui::GetItemRectMax(), .checked = checked};
    rect.enabled = enabled && (ImGui::GetCurrentContext()->CurrentItemFlags & ImGuiItemFlags_Disabled) == 0;
    rect.visible = ImGui::GetCurrentWindowRead()->ClipRect.Contains(rect.centre());
    std::string path = widget_path(name);
    if (path == r.bring_into_view) {
        if (!rect.visible) ImGui::SetScrollHereY(0.5f);
        r.bring_into_view.clear();
    }
    r.current.try_emplace(std::move(path), rect);
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
