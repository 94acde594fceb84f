// The verbs for the view, the camera and movement keys, and for finding widgets.
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "app/script_context.h"
#include "panels/viewport_panel.h"
#include "slipface/base/near_name.h"
#include "slipface/base/text.h"

namespace slipface {
namespace {

constexpr std::size_t max_suggestions = 6;

struct Mouse {
    int button = 0;
    bool ctrl = false, shift = false, alt = false;
};

std::optional<Mouse> mouse_words(ScriptContext& context, const Words& words, std::size_t next) {
    Mouse mouse;
    for (; next < words.size(); ++next) {
        const std::string& word = words[next];
        if (word == "left")
            mouse.button = 0;
        else if (word == "right")
            mouse.button = 1;
        else if (word == "middle")
            mouse.button = 2;
        else if (word == "ctrl")
            mouse.ctrl = true;
        else if (word == "shift")
            mouse.shift = true;
        else if (word == "alt")
            mouse.alt = true;
        else {
            context.fail("found \"" + word + "\", expected left, middle, right, ctrl, shift or alt");
            return std::nullopt;
        }
    }
    return mouse;
}

}  // namespace

std::string nearest_widgets(const std::string& path) {
    const std::string wanted = to_lower(std::string_view(path).substr(0, 200));
    const std::string leaf =
        wanted.substr(wanted.rfind('/') == std::string::npos ? 0 : wanted.rfind('/') + 1);
    std::vector<std::pair<std::size_t, std::string>> ranked;
    for (const auto& [name, rect] : ui::widgets()) {
        const std::string lower = to_lower(name);
        std::size_t distance = edit_distance(wanted, lower);
        if (!leaf.empty() && lower.find(leaf) != std::string::npos) distance /= 3;
        ranked.emplace_back(distance, name);
    }
    std::sort(ranked.begin(), ranked.end());
    std::string text;
    for (std::size_t i = 0; i < std::min(max_suggestions, ranked.size()); ++i)
        text += (i ? ", \"" : "\"") + ranked[i].second + "\"";
    return text;
}

std::optional<ui::WidgetRect> find_widget(ScriptContext& context, const std::string& path) {
    auto found = ui::widgets().find(path);
    if (found == ui::widgets().end()) {
        context.fail("no widget \"" + path + "\"; near: " + nearest_widgets(path));
        return std::nullopt;
    }
    if (!found->second.visible) {
        // One scroll may not reach a row that is far away.
        for (int i = 0; i < 4 && found != ui::widgets().end() && !found->second.visible; ++i) {
            ui::bring_into_view(path);
            for (int frame = 0; frame < 3; ++frame)
                context.host.frame();
            found = ui::widgets().find(path);
        }
        if (found == ui::widgets().end() || !found->second.visible) {
            context.fail("widget \"" + path + "\" cannot be brought into view");
            return std::nullopt;
        }
    }
    return found->second;
}

std::optional<double> number(ScriptContext& context, const std::string& word) {
    const std::optional<double> value = parse_double(word);
    if (!value) context.fail("expected a number, found \"" + word + "\"");
    return value;
}

std::optional<Vec3> vec3(ScriptContext& context, const std::string& word) {
    const std::optional<Vec3> value = parse_vec3(word);
    if (!value) context.fail("expected x,y,z, found \"" + word + "\"");
    return value;
}

std::filesystem::path script_path(const ScriptContext& context, const std::string& word) {
    const std::filesystem::path path(word);
    return path.is_absolute() ? path : context.folder / path;
}

std::optional<ImVec2> view_point(ScriptContext& context, const Words& words, std::size_t& next) {
    const ViewportState& view = viewport_state();
    if (next >= words.size()) {
        context.fail("expected a point: x y, or @x,y,z");
        return std::nullopt;
    }
    if (words[next].starts_with('@')) {
        const std::optional<Vec3> point = vec3(context, words[next++].substr(1));
        if (!point) return std::nullopt;
        const Vec3 pixel = project(shown_camera(context.editor()), *point,
                                   {static_cast<double>(view.size.x), static_cast<double>(view.size.y)});
        const ImVec2 at{static_cast<float>(pixel.x()), static_cast<float>(pixel.y())};
        if (pixel.z() <= 0.0 || at.x < 0 || at.y < 0 || at.x >= view.size.x || at.y >= view.size.y) {
            context.fail("the point " + words[next - 1] + " is outside the view");
            return std::nullopt;
        }
        return ImVec2{view.min.x + at.x, view.min.y + at.y};
    }
    if (next + 1 >= words.size()) {
        context.fail("expected a point: x y, or @x,y,z");
        return std::nullopt;
    }
    const std::optional<double> x = number(context, words[next]), y = number(context, words[next + 1]);
    next += 2;
    if (!x || !y) return std::nullopt;
    return ImVec2{view.min.x + static_cast<float>(*x), view.min.y + static_cast<float>(*y)};
}

void verb_viewport(ScriptContext& context, const Words& words) {
    if (!context.editor().document) return context.fail("nothing is open");
    const std::string& action = words[1];
    if (action != "click" && action != "hover" && action != "drag")
        return context.fail("found \"" + action + "\", expected click, hover or drag");
    std::size_t next = 2;
    const std::optional<ImVec2> from = view_point(context, words, next);
    if (!from) return;
    const std::optional<ImVec2> to = action == "drag" ? view_point(context, words, next) : from;
    if (!to) return;
    const std::optional<Mouse> mouse = mouse_words(context, words, next);
    if (!mouse) return;

    OffscreenHost& host = context.host;
    host.modifiers(mouse->ctrl, mouse->shift, mouse->alt);
    host.move_mouse(*from);
    host.frame();
    host.frame();
    if (action != "hover") {
        host.mouse_button(mouse->button, true);
        host.frame();
        constexpr int steps = 12;
        for (int i = 1; action == "drag" && i <= steps; ++i) {
            const float fraction = static_cast<float>(i) / steps;
            host.move_mouse({from->x + (to->x - from->x) * fraction, from->y + (to->y - from->y) * fraction});
            host.frame();
        }
        host.mouse_button(mouse->button, false);
        host.frame();
    }
    host.modifiers(false, false, false);
    host.frame();
}

void verb_only(ScriptContext& context, const Words& words) {
    PanelLayout& layout = context.editor().layout;
    if (words[1] == "all" || words[1] == "view") {
        if (words.size() > 2) return context.fail("a size needs a panel");
        layout.focus = words[1] == "view";
        layout.focused.reset();
    } else {
        std::string names;
        std::optional<PanelId> panel;
        for (const PanelInfo& info : panel_table()) {
            if (words[1] == info.name) panel = info.id;
            names += std::string(", ") + info.name;
        }
        if (!panel) return context.fail("no panel \"" + words[1] + "\"; there are: view, all" + names);
        if (words.size() > 2) {
            const std::optional<double> size = number(context, words[2]);
            if (!size) return;
            if (*size < 90.0 || *size > 640.0)
                return context.fail("expected a size of 90 to 640, found \"" + words[2] + "\"");
            const Dock dock = layout.dock(*panel);
            (dock == Dock::bottom  ? layout.bottom
             : dock == Dock::right ? layout.right
                                   : layout.left) = static_cast<float>(*size);
        }
        layout.focus_on(panel);
    }
    context.host.frame();
    context.host.frame();
}

void verb_hold(ScriptContext& context, const Words& words) {
    const std::optional<std::int64_t> frames = parse_int(words.back());
    if (!frames || *frames < 1 || *frames > 36000)
        return context.fail("expected 1 to 36000 frames, found \"" + words.back() + "\"");
    HeldKeys held;
    for (std::size_t i = 1; i + 1 < words.size(); ++i)
        if (!hold_key(held, words[i], true))
            return context.fail("found \"" + words[i] + "\", expected " + movement_key_names());
    for (std::int64_t i = 0; i < *frames; ++i) {
        context.host.app().context().held = held;
        context.host.frame();
    }
    context.host.app().context().held = {};
}

void verb_look(ScriptContext& context, const Words& words) {
    const std::optional<double> x = number(context, words[1]), y = number(context, words[2]);
    if (!x || !y) return;
    context.host.app().context().held.look_pixels = {*x, *y};
    context.host.frame();
}

void verb_camera(ScriptContext& context, const Words& words) {
    Editor& editor = context.editor();
    if (words[1] == "eye" && words.size() == 5 && words[3] == "target") {
        const std::optional<Vec3> eye = vec3(context, words[2]), target = vec3(context, words[4]);
        if (!eye || !target) return;
        editor.view.look_at(*eye, *target);
    } else if (camera_bookmark(context, words)) {
        if (context.failure != ScriptFailure::none) return;
    } else if (words[1] == "frame" && words.size() == 2) {
        const ViewportState& view = viewport_state();
        frame_selected(editor, static_cast<double>(view.size.x / view.size.y));
    } else {
        return context.fail(
            "expected: camera eye x,y,z target x,y,z | camera bookmark|save|delete NAME | "
            "camera rename NAME NEW | camera frame");
    }
    context.host.frame();
}

}  // namespace slipface
