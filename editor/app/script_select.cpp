// The verbs that select faces, store selections and cameras, and replace types.
#include <fmt/format.h>

#include <algorithm>

#include "app/script_context.h"
#include "slipface/base/text.h"
#include "tools/selection/selecting.h"
#include "tools/view/cameras.h"

namespace slipface {
namespace {

std::string listed(const std::vector<std::string>& names) {
    std::string text;
    for (const std::string& name : names)
        text += (text.empty() ? "" : ", ") + name;
    return text.empty() ? "none" : text;
}

std::optional<std::size_t> saved_named(ScriptContext& context, const std::string& name) {
    const Document& document = *context.editor().document;
    const std::optional<std::size_t> found = find_selection(document, name);
    if (found) return found;
    std::vector<std::string> names;
    for (const SavedSelection& saved : document.saved_selections())
        names.push_back(saved.name);
    context.fail("no selection \"" + name + "\"; there are: " + listed(names));
    return std::nullopt;
}

// "3", "3,4,9" or "3-7,12".
std::optional<std::vector<FaceId>> face_list(ScriptContext& context, const std::string& text) {
    std::vector<FaceId> faces;
    const auto count = static_cast<std::int64_t>(context.editor().document->face_count());
    for (const std::string_view part : split(text, ',')) {
        const std::size_t dash = part.find('-');
        const std::optional<std::int64_t> first = parse_int(part.substr(0, dash));
        const std::optional<std::int64_t> last =
            dash == std::string_view::npos ? first : parse_int(part.substr(dash + 1));
        if (!first || !last || *first < 0 || *last < *first || *last >= count) {
            context.fail(fmt::format("found \"{}\", expected faces 0 to {}, such as 3,5-9", part, count - 1));
            return std::nullopt;
        }
        for (std::int64_t face = *first; face <= *last; ++face)
            faces.push_back(static_cast<FaceId>(face));
    }
    return faces;
}

std::optional<SurfaceId> type_named(ScriptContext& context, const std::string& name) {
    const Level& level = context.editor().document->level();
    if (const auto found = find_surface(level, name)) return found;
    std::vector<std::string> names;
    for (const SurfaceType& type : level.surfaces)
        names.push_back(type.name);
    context.fail("no surface type \"" + name + "\"; there are: " + listed(names));
    return std::nullopt;
}

}  // namespace

void verb_select(ScriptContext& context, const Words& words) {
    Editor& editor = context.editor();
    if (!editor.document) return context.fail("nothing is open");
    const std::string& what = words[1];
    if (what == "faces" && words.size() >= 3) {
        const std::optional<std::vector<FaceId>> faces = face_list(context, words[2]);
        SelectBy by = SelectBy::replace;
        if (words.size() == 4 && words[3] == "add") by = SelectBy::add;
        if (words.size() == 4 && words[3] == "remove") by = SelectBy::remove;
        if (faces) apply_selection(editor, *faces, by, "Select faces");
    } else if (what == "type" && words.size() == 3) {
        if (const auto type = type_named(context, words[2]))
            apply_selection(editor, faces_of_type(*editor.document, *type), SelectBy::replace,
                            "Select by type");
    } else if (what == "save" && words.size() == 3) {
        save_selection(editor, words[2]);
    } else if (what == "recall" && words.size() == 3) {
        if (const auto saved = saved_named(context, words[2]))
            recall_selection(editor, *saved, SelectBy::replace);
    } else if (what == "rename" && words.size() == 4) {
        if (const auto saved = saved_named(context, words[2])) rename_selection(editor, *saved, words[3]);
    } else if (what == "delete" && words.size() == 3) {
        if (const auto saved = saved_named(context, words[2])) remove_selection(editor, *saved);
    } else {
        return context.fail(
            "expected: select faces 3,5-9 [add|remove] | select type NAME | "
            "select save|recall|delete NAME | select rename NAME NEW");
    }
    context.host.frame();
}

void verb_replace(ScriptContext& context, const Words& words) {
    Editor& editor = context.editor();
    if (!editor.document) return context.fail("nothing is open");
    const std::optional<SurfaceId> from = type_named(context, words[1]);
    if (!from) return;
    if (words[2] == "unset") {
        replace_type(editor, *from, std::nullopt);
    } else if (const std::optional<SurfaceId> to = type_named(context, words[2])) {
        replace_type(editor, *from, to);
    }
    context.host.frame();
}

// The bookmark part of verb_camera(). False: the words are not about bookmarks.
bool camera_bookmark(ScriptContext& context, const Words& words) {
    Editor& editor = context.editor();
    const std::string& what = words[1];
    const bool known = what == "bookmark" || what == "save" || what == "delete" || what == "rename";
    if (!known || words.size() != (what == "rename" ? 4u : 3u)) return false;
    if (!editor.document) {
        context.fail("nothing is open");
        return true;
    }
    if (what == "save") {
        save_camera(editor, words[2]);
        return true;
    }
    const std::optional<std::size_t> camera = find_camera(*editor.document, words[2]);
    if (!camera) {
        std::vector<std::string> names;
        for (const CameraBookmark& other : editor.document->level().cameras)
            names.push_back(other.name);
        context.fail("no camera \"" + words[2] + "\"; there are: " + listed(names));
        return true;
    }
    if (what == "bookmark") go_to_camera(editor, *camera);
    if (what == "delete") remove_camera(editor, *camera);
    if (what == "rename") rename_camera(editor, *camera, words[3]);
    return true;
}

void verb_pane(ScriptContext& context, const Words& words) {
    const std::optional<std::int64_t> pane = parse_int(words[1]);
    const std::size_t count = context.editor().panes.count;
    if (!pane || *pane < 1 || static_cast<std::size_t>(*pane) > count)
        return context.fail(fmt::format("expected a view from 1 to {}, found \"{}\"", count, words[1]));
    activate_pane(context.editor(), static_cast<std::size_t>(*pane - 1));
    context.host.frame();
}

}  // namespace slipface
