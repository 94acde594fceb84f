// Widgets with a name. Each records its rectangle, so that scripts and tests find it by its path instead of
// by pixels. Panels use these, and plain ImGui only for what nothing needs to find.
#pragma once

#include <imgui.h>

#include <map>
#include <optional>
#include <string>
#include <string_view>

namespace slipface::ui {

// The rectangle of a widget in the last frame, in pixels of the window.
struct WidgetRect {
    ImVec2 min, max;
    bool enabled = true;
    bool visible = true;          // its centre is neither scrolled nor clipped away
    std::optional<bool> checked;  // of check boxes, toggles and tabs
    ImVec2 clip_min, clip_max;    // the visible part of the window around it
    std::string window;           // its window's name in Dear ImGui
    bool ground = false;          // other widgets may overlap it
    bool text_box = false;        // it scrolls text that does not fit
    bool has_tooltip = false;
    ImVec2 centre() const { return {(min.x + max.x) * 0.5f, (min.y + max.y) * 0.5f}; }
};

// All widgets of the last complete frame by path: "Movement/Keep energy", "Toolbar/Paint", "Menu/File/Save".
const std::map<std::string, WidgetRect, std::less<>>& widgets();
void begin_widget_frame();
void end_widget_frame();
// Scrolls the widget into view when it is drawn next. For scripts; a person would use the wheel.
void bring_into_view(std::string_view path);
// The path of `name` inside the current scopes.
std::string widget_path(std::string_view name);

// Prefixes the paths of the widgets in its scope: Scope scope("Movement");
class Scope {
  public:
    explicit Scope(std::string_view name);
    ~Scope();
    Scope(const Scope&) = delete;
    Scope& operator=(const Scope&) = delete;

  private:
    std::size_t length_;
};

// For items drawn with plain ImGui.
void record_last_item(std::string_view name, bool enabled = true, std::optional<bool> checked = std::nullopt);
// Other widgets may overlap the item recorded last: buttons of a row, overlays of a view.
void mark_as_ground();
void mark_as_text_box();
void mark_as_having_tooltip();  // if the last item is the one recorded last, or a group around it
// The item recorded last is a header, or a row that spans the columns: its own column does not clip it.
void mark_as_table_row();
// Records something drawn without an item: a label in the view, a tooltip.
void record_rect(std::string_view name, ImVec2 min, ImVec2 max);
// Records the rectangle of the previous frame: while a popup is open, the last item is the popup's.
void record_again(std::string_view name);

bool button(const char* label, const char* tooltip = nullptr, bool enabled = true, ImVec2 size = {0, 0});
bool icon_button(const char* icon, const char* name, const char* tooltip, bool active, bool enabled = true);
bool checkbox(const char* label, bool* value, const char* tooltip = nullptr);
bool slider(const char* label, double* value, double minimum, double maximum, const char* format,
            const char* tooltip = nullptr);
// A line under the number shows its position in its range, so that nothing covers the digits. Uses the next
// item width.
bool number_slider(const char* id, double* value, double minimum, double maximum, const char* format,
                   bool logarithmic = false);
bool drag_vec3(const char* label, double* xyz, float speed, const char* format,
               const char* tooltip = nullptr);
bool combo(const char* label, int* index, const char* const* names, int count, const char* tooltip = nullptr);
bool input_text(const char* label, std::string* text, const char* hint = nullptr);
// Several lines, with Tab for the next widget.
bool input_lines(const char* label, std::string* text, ImVec2 size);
// A line that searches the window or panel around it. In a window of its own it has the keyboard from the
// window's first frame on, and nothing that is typed before is lost.
bool search_box(const char* label, std::string* text, const char* hint);
bool typing();  // a text box has the keyboard, or will have it in the next frames
bool selectable(const char* label, bool selected);
bool menu_item(const char* label, const char* shortcut, bool checked, bool enabled, const char* tooltip,
               const char* icon = "");
bool begin_menu(const char* label);
void end_menu();
bool tab(const char* label, bool front);  // true: pressed
// Toggles that show or hide the rows of a kind, with their number, as many per line as fit.
class Chips {
  public:
    Chips();
    ~Chips();
    Chips(const Chips&) = delete;
    Chips& operator=(const Chips&) = delete;
    bool chip(const char* name, std::size_t count, bool shown);  // true: pressed

  private:
    float right_;
    bool first_ = true;
};
// Positions the next item, `width` wide, beside the last one if it fits there, otherwise on a new line.
void flow(float width, float spacing = -1.0f);
float button_width(const char* label);
float icon_button_side();
// The dialog's default answer.
bool primary_button(const char* label, bool enabled = true, ImVec2 size = {0, 0});
void request_accept();           // Enter in a dialog: presses its primary button in the next frame
void tooltip(const char* text);  // for the last item, wrapped
// Draws text that ends in an ellipsis if it does not fit before `right`. Uses no layout space.
void ellipsis(ImVec2 at, float right, const ImVec4& color, const std::string& text);
void heading(const char* text);     // wrapped
void muted_text(const char* text);  // wrapped, less prominent

float scale();  // pixels per design pixel (1 at 100 %)
void set_scale(float scale);
// Seconds that the mouse must rest on a widget before its tooltip shows.
void set_tooltip_delay(double seconds);
double tooltip_due_in_s();    // after the frame built last; infinity: none is due
bool windows_are_settling();  // some are not drawn yet, because their size is not known

}  // namespace slipface::ui
