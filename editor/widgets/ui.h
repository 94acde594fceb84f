// Widgets with a name: each records where it was drawn, so that scripts and tests find it by its path instead of by pixels.
// Panels use these, and plain ImGui only where nothing needs to be found.
#pragma once

#include <imgui.h>

#include <map>
#include <optional>
#include <string>
#include <string_view>

namespace slipface::ui {

// Where a widget was drawn in the last frame, in pixels of the window.
struct WidgetRect {
    ImVec2 min, max;
    bool enabled = true;
    ImVec2 centre() const { return {(min.x + max.x) * 0.5f, (min.y + max.y) * 0.5f}; }
};

// All widgets of the last complete frame by path: "Movement/Keep energy", "Toolbar/Paint", "Menu/File/Save".
const std::map<std::string, WidgetRect, std::less<>>& widgets();
void begin_widget_frame();

// Prefixes the paths of the widgets inside: Scope scope("Movement");
class Scope {
  public:
    explicit Scope(std::string_view name);
    ~Scope();
    Scope(const Scope&) = delete;
    Scope& operator=(const Scope&) = delete;

  private:
    std::size_t length_;
};

void record_last_item(std::string_view name, bool enabled = true);  // for items drawn with plain ImGui

bool button(const char* label, const char* tooltip = nullptr, bool enabled = true, ImVec2 size = {0, 0});
bool icon_button(const char* icon, const char* name, const char* tooltip, bool active, bool enabled = true);
bool checkbox(const char* label, bool* value, const char* tooltip = nullptr);
bool slider(const char* label, double* value, double minimum, double maximum, const char* format, const char* tooltip = nullptr);
bool drag_vec3(const char* label, double* xyz, float speed, const char* format, const char* tooltip = nullptr);
bool combo(const char* label, int* index, const char* const* names, int count, const char* tooltip = nullptr);
bool input_text(const char* label, std::string* text, const char* hint = nullptr);
bool selectable(const char* label, bool selected);
bool menu_item(const char* label, const char* shortcut, bool checked, bool enabled, const char* tooltip);
bool begin_menu(const char* label);
void end_menu();
void tooltip(const char* text);  // for the last item, wrapped
void heading(const char* text);

float scale();                   // pixels per design pixel (1 at 100 %)
void set_scale(float scale);

}  // namespace slipface::ui
