// What the verbs of a script have in common.
#pragma once

#include "app/script.h"
#include "widgets/ui.h"

namespace slipface {

struct ScriptContext {
    OffscreenHost& host;
    std::filesystem::path folder;
    ScriptFailure failure = ScriptFailure::none;
    std::string message;

    Editor& editor() const { return host.editor(); }
    void fail(std::string text) { set(ScriptFailure::bad_input, std::move(text)); }
    void unmet(std::string text) { set(ScriptFailure::expectation, std::move(text)); }

  private:
    void set(ScriptFailure kind, std::string text) {
        if (failure != ScriptFailure::none) return;
        failure = kind;
        message = std::move(text);
    }
};

using Words = std::vector<std::string>;

// The widget, scrolled into view if needed. If it does not exist the script fails and names the nearest ones.
std::optional<ui::WidgetRect> find_widget(ScriptContext& context, const std::string& path);
std::string nearest_widgets(const std::string& path);  // "a", "b", ...
// Reads "x" "y" in pixels of the view, or "@x,y,z" in the level, and returns a pixel of the window. Moves
// `next` past what was read.
std::optional<ImVec2> view_point(ScriptContext& context, const Words& words, std::size_t& next);
std::optional<double> number(ScriptContext& context, const std::string& word);
std::optional<Vec3> vec3(ScriptContext& context, const std::string& word);
std::filesystem::path script_path(const ScriptContext& context, const std::string& word);

void verb_viewport(ScriptContext& context, const Words& words);
void verb_hold(ScriptContext& context, const Words& words);
void verb_look(ScriptContext& context, const Words& words);
void verb_camera(ScriptContext& context, const Words& words);
bool camera_bookmark(ScriptContext& context, const Words& words);
void verb_only(ScriptContext& context, const Words& words);
void verb_select(ScriptContext& context, const Words& words);
void verb_prop(ScriptContext& context, const Words& words);
void verb_replace(ScriptContext& context, const Words& words);
void verb_pane(ScriptContext& context, const Words& words);
void verb_run(ScriptContext& context, const Words& words);
void verb_preset(ScriptContext& context, const Words& words);
void verb_export(ScriptContext& context, const Words& words);
void verb_expect(ScriptContext& context, const Words& words);
std::string expectations_markdown();

}  // namespace slipface
