// The verb about props.
#include <fmt/format.h>

#include "app/script_context.h"
#include "tools/props/props.h"

namespace slipface {
namespace {

constexpr double radians = 0.017453292519943295;

std::optional<std::size_t> prop_named(ScriptContext& context, const std::string& name) {
    const std::vector<Prop>& props = context.editor().document->level().props;
    const auto found = std::ranges::find(props, name, &Prop::name);
    if (found != props.end()) return static_cast<std::size_t>(found - props.begin());
    std::string names;
    for (std::size_t i = 0; i < std::min<std::size_t>(props.size(), 20); ++i)
        names += (i == 0 ? "" : ", ") + props[i].name;
    context.fail("no prop \"" + name + "\"; there are: " + (names.empty() ? "none" : names));
    return std::nullopt;
}

// A member of a prop from its word; false: the script has failed.
bool set_member(ScriptContext& context, Prop& prop, const std::string& member, const std::string& word) {
    const std::pair<const char*, std::string Prop::*> texts[] = {
        {"name", &Prop::name}, {"mesh", &Prop::mesh}, {"texture", &Prop::texture}, {"type", &Prop::type}};
    for (const auto& [name, text] : texts)
        if (member == name) return prop.*text = word, true;
    const std::tuple<const char*, Vec3 Prop::*, double> vectors[] = {{"position", &Prop::position, 1.0},
                                                                     {"rotation", &Prop::rotation, radians},
                                                                     {"scale", &Prop::scale, 1.0}};
    for (const auto& [name, vector, unit] : vectors) {
        if (member != name) continue;
        const std::optional<Vec3> value = vec3(context, word);
        if (value) prop.*vector = *value * unit;
        return value.has_value();
    }
    Animation& animation = prop.animation;
    if (member == "clip") return animation.clip = word, true;
    const std::pair<const char*, double*> numbers[] = {{"speed", &animation.speed},
                                                       {"phase", &animation.phase_s},
                                                       {"scroll_u", &animation.scroll.x()},
                                                       {"scroll_v", &animation.scroll.y()},
                                                       {"pictures_per_second", &animation.pictures_per_s}};
    const std::pair<const char*, int*> counts[] = {{"columns", &animation.columns},
                                                   {"rows", &animation.rows}};
    for (const auto& [name, to] : numbers) {
        if (member != name) continue;
        const std::optional<double> value = number(context, word);
        if (value) *to = *value;
        return value.has_value();
    }
    for (const auto& [name, to] : counts) {
        if (member != name) continue;
        const std::optional<double> value = number(context, word);
        if (value) *to = static_cast<int>(std::clamp(*value, 1.0, static_cast<double>(max_pictures_a_side)));
        return value.has_value();
    }
    context.fail(
        "no member \"" + member +
        "\" of props; there are: name, mesh, position, rotation, scale, texture, type, clip, speed, phase, "
        "scroll_u, scroll_v, columns, rows, pictures_per_second");
    return false;
}

}  // namespace

void verb_prop(ScriptContext& context, const Words& words) {
    Editor& editor = context.editor();
    if (!editor.document) return context.fail("nothing is open");
    const std::string& what = words[1];
    bool done = true;
    if (what == "place" && words.size() >= 4) {
        const std::optional<Vec3> at = vec3(context, words[3]);
        done = at && add_prop(editor, words[2], *at, words.size() == 5 ? words[4] : "");
    } else if (what == "set" && words.size() == 5) {
        const std::optional<std::size_t> prop = prop_named(context, words[2]);
        if (!prop) return;
        Prop to = editor.document->level().props[*prop];
        if (!set_member(context, to, words[3], words[4])) return;
        done = change_prop(editor, *prop, to, "Change " + words[3] + " of " + words[2]);
    } else if (what == "file" && words.size() == 3) {
        editor.props.file = words[2] == "none" ? "" : words[2];
        editor.tool = Tool::props;
    } else if (words.size() == 3 && (what == "choose" || what == "duplicate" || what == "delete")) {
        const std::optional<std::size_t> prop = prop_named(context, words[2]);
        if (!prop) return;
        if (what == "choose") choose_prop(editor, *prop);
        if (what == "duplicate") duplicate_prop(editor, *prop);
        if (what == "delete") remove_prop(editor, *prop);
    } else {
        return context.fail(
            "expected: prop place FILE x,y,z [NAME] | prop set NAME MEMBER VALUE | prop file FILE|none | "
            "prop choose|duplicate|delete NAME");
    }
    if (!done) context.fail(editor.status);
    context.host.frame();
}

}  // namespace slipface
