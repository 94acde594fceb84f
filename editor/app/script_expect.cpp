// What a script can check.
#include <fmt/format.h>

#include <algorithm>

#include "app/parts.h"
#include "app/script_context.h"
#include "slipface/base/text.h"

namespace slipface {
namespace {

bool yes_or_no(ScriptContext& context, const std::string& word) {
    if (word != "yes" && word != "no") context.fail("expected yes or no, found \"" + word + "\"");
    return word == "yes";
}

void expect_text(ScriptContext& context, const char* what, const std::string& found,
                 const std::string& pattern) {
    if (!glob_match(pattern, found))
        context.unmet(fmt::format("expected {} \"{}\", found \"{}\"", what, pattern, found));
}

void expect_state(ScriptContext& context, const char* what, bool found, const std::string& word) {
    if (found != yes_or_no(context, word))
        context.unmet(fmt::format("expected {} {}, found {}", what, word, found ? "yes" : "no"));
}

void expect_number(ScriptContext& context, const std::string& what, std::size_t found,
                   const std::string& word) {
    const std::optional<std::int64_t> wanted = parse_int(word);
    if (!wanted) return context.fail("expected a number, found \"" + word + "\"");
    if (*wanted < 0 || static_cast<std::size_t>(*wanted) != found)
        context.unmet(fmt::format("expected {} {}, found {}", what, word, found));
}

const Document* document(ScriptContext& context) {
    if (!context.editor().document) context.fail("nothing is open");
    return context.editor().document.get();
}

std::string type_name(const Document& document, SurfaceId id) {
    const auto& surfaces = document.level().surfaces;
    return id < surfaces.size() ? surfaces[id].name : "?";
}

void expect_status(ScriptContext& c, const Words& w) {
    expect_text(c, "status", c.editor().status, w[2]);
}
void expect_message(ScriptContext& c, const Words& w) {
    expect_text(c, "message",
                c.editor().message ? c.editor().message->title + ": " + c.editor().message->text : "", w[2]);
}
void expect_title(ScriptContext& c, const Words& w) {
    expect_text(c, "title", window_title(c.editor()), w[2]);
}
void expect_widget(ScriptContext& c, const Words& w) {
    if (!ui::widgets().contains(w[2])) c.unmet("no widget \"" + w[2] + "\"; near: " + nearest_widgets(w[2]));
}
void expect_no_widget(ScriptContext& c, const Words& w) {
    if (ui::widgets().contains(w[2])) c.unmet("expected no widget \"" + w[2] + "\"");
}
void expect_enabled(ScriptContext& c, const Words& w) {
    if (const auto widget = find_widget(c, w[2])) expect_state(c, "enabled", widget->enabled, w[3]);
}
void expect_checked(ScriptContext& c, const Words& w) {
    if (const auto widget = find_widget(c, w[2]))
        expect_state(c, "checked", widget->checked.value_or(false), w[3]);
}
void expect_dirty(ScriptContext& c, const Words& w) {
    if (const Document* d = document(c)) expect_state(c, "dirty", d->dirty(), w[2]);
}
void expect_playing(ScriptContext& c, const Words& w) {
    expect_state(c, "playing", c.editor().playtest.has_value(), w[2]);
}
void expect_grounded(ScriptContext& c, const Words& w) {
    if (!c.editor().playtest) return c.fail("nobody is playing");
    expect_state(c, "grounded", c.editor().playtest->state().grounded, w[2]);
}
void expect_tape(ScriptContext& c, const Words& w) {
    expect_text(c, "tape", std::to_string(c.editor().lab.ticks()), w[2]);
}
void expect_tick(ScriptContext& c, const Words& w) {
    expect_number(c, "tick", c.editor().lab.cursor(), w[2]);
}
void expect_ghosts(ScriptContext& c, const Words& w) {
    expect_number(c, "ghosts", c.editor().lab.runs().size(), w[2]);
}
void expect_parts(ScriptContext& c, const Words& w) {
    const std::optional<std::int64_t> run = parse_int(w[2]);
    const Lab& lab = c.editor().lab;
    if (!run || *run < 1 || static_cast<std::size_t>(*run) >= lab.runs().size())
        return c.fail("no ghost " + w[2]);
    expect_state(c, "parts", lab.divergence(static_cast<std::size_t>(*run)).has_value(), w[3]);
}
void expect_repeats(ScriptContext& c, const Words& w) {
    const std::optional<bool> repeats = c.editor().lab.repeats();
    if (!repeats) return c.fail("the tape has no final hash, or its run is not complete");
    expect_state(c, "repeats", *repeats, w[2]);
}
void expect_story(ScriptContext& c, const Words& w) {
    if (!document(c)) return;
    expect_text(c, "story", story_text(c.editor().lab.story(*c.editor().document)), w[2]);
}
void expect_surface(ScriptContext& c, const Words& w) {
    const Document* const d = document(c);
    if (!d) return;
    const std::optional<std::int64_t> face = parse_int(w[2]);
    if (!face || *face < 0 || static_cast<std::size_t>(*face) >= d->face_count())
        return c.fail(fmt::format("expected a face 0..{}, found \"{}\"", d->face_count() - 1, w[2]));
    expect_text(c, "surface", type_name(*d, d->surface_of(static_cast<FaceId>(*face))), w[3]);
}
void expect_count(ScriptContext& c, const Words& w) {
    const Document* const d = document(c);
    if (!d) return;
    const std::optional<SurfaceId> type = find_surface(d->level(), w[2]);
    if (!type) return c.fail("no surface type \"" + w[2] + "\"");
    const auto& surfaces = d->resolved().surface;
    expect_number(c, "count of " + w[2],
                  static_cast<std::size_t>(std::count(surfaces.begin(), surfaces.end(), *type)), w[3]);
}
void expect_selected(ScriptContext& c, const Words& w) {
    if (const Document* d = document(c)) expect_number(c, "selected", d->selection().size(), w[2]);
}
void expect_history(ScriptContext& c, const Words& w) {
    if (const Document* d = document(c)) expect_number(c, "history", d->history_cursor(), w[2]);
}
void expect_brush(ScriptContext& c, const Words& w) {
    if (const Document* d = document(c))
        expect_text(c, "brush", c.editor().brush ? type_name(*d, *c.editor().brush) : "unset", w[2]);
}
void expect_tool(ScriptContext& c, const Words& w) {
    static constexpr const char* names[] = {"select", "paint", "fill", "probe", "props"};
    static_assert(std::size(names) == tool_count);
    expect_text(c, "tool", names[static_cast<std::size_t>(c.editor().tool)], w[2]);
}
void expect_setting(ScriptContext& c, const Words& w) {
    const Document* const d = document(c);
    if (!d) return;
    MovementSettings wanted = d->level().movement;
    if (const Status status = set_setting(wanted, w[2]); !status) return c.fail(status.error().text());
    const SettingInfo* const info = find_setting(std::string_view(w[2]).substr(0, w[2].find('=')));
    if (info && !(wanted == d->level().movement))
        c.unmet("expected setting " + w[2] + ", found " + setting_text(d->level().movement, *info));
}

void expect_hidden(ScriptContext& c, const Words& w) {
    if (const Document* const d = document(c)) expect_number(c, "hidden", d->hidden().size(), w[2]);
}
void expect_saved(ScriptContext& c, const Words& w) {
    if (const Document* const d = document(c)) expect_number(c, "saved", d->saved_selections().size(), w[2]);
}
void expect_props(ScriptContext& c, const Words& w) {
    if (const Document* const d = document(c)) expect_number(c, "props", d->level().props.size(), w[2]);
}
void expect_cameras(ScriptContext& c, const Words& w) {
    if (const Document* const d = document(c)) expect_number(c, "cameras", d->level().cameras.size(), w[2]);
}
void expect_panes(ScriptContext& c, const Words& w) {
    expect_number(c, "panes", c.editor().panes.count, w[2]);
}
void expect_changed(ScriptContext& c, const Words& w) {
    expect_state(c, "changed_on_disk", c.editor().session.changed.has_value(), w[2]);
}
void expect_recoverable(ScriptContext& c, const Words& w) {
    expect_number(c, "recoverable", c.editor().session.recoverable.size(), w[2]);
}
void expect_view(ScriptContext& c, const Words& w) {
    expect_text(c, "view", c.editor().view.name(), w[2]);
}

struct Expectation {
    const char *name, *arguments, *meaning;
    std::size_t words;
    void (*check)(ScriptContext&, const Words&);
};
constexpr Expectation expectations[] = {
    {"status", "\"pattern\"", "The status line's last message matches (`*` and `?`)", 3, expect_status},
    {"message", "\"pattern\"", "The open message, \"title: text\", matches; \"\" if none is open", 3,
     expect_message},
    {"title", "\"pattern\"", "The window's title matches", 3, expect_title},
    {"widget", "\"Path\"", "The widget exists", 3, expect_widget},
    {"no_widget", "\"Path\"", "The widget does not exist", 3, expect_no_widget},
    {"enabled", "\"Path\" yes|no", "The widget is enabled", 4, expect_enabled},
    {"checked", "\"Path\" yes|no", "The widget is checked", 4, expect_checked},
    {"dirty", "yes|no", "The document differs from its file", 3, expect_dirty},
    {"changed_on_disk", "yes|no", "Another program changed the files, and the answer is awaited", 3,
     expect_changed},
    {"recoverable", "n", "So many autosaves are offered", 3, expect_recoverable},
    {"playing", "yes|no", "The playtest is running", 3, expect_playing},
    {"grounded", "yes|no", "The player is grounded", 3, expect_grounded},
    {"tape", "n", "The lab's tape has n ticks (`*` and `?`)", 3, expect_tape},
    {"tick", "n", "The lab's cursor is at this tick", 3, expect_tick},
    {"ghosts", "n", "The lab has n runs of the tape", 3, expect_ghosts},
    {"parts", "RUN yes|no",
     "The lab's run of that number (1: present settings) diverges from the recorded run", 4, expect_parts},
    {"repeats", "yes|no", "The run ends with the tape's hash", 3, expect_repeats},
    {"story", "\"pattern\"", "The story of the lab's tick matches", 3, expect_story},
    {"surface", "FACE NAME", "The face has this type", 4, expect_surface},
    {"count", "NAME n", "n faces have this type (likewise: selected, hidden, cameras, views, steps)", 4,
     expect_count},
    {"selected", "n", "So many faces are selected", 3, expect_selected},
    {"hidden", "n", "So many faces are hidden", 3, expect_hidden},
    {"saved", "n", "n selections are saved", 3, expect_saved},
    {"cameras", "n", "The level has so many cameras", 3, expect_cameras},
    {"props", "n", "The level has so many props", 3, expect_props},
    {"panes", "n", "So many views are shown", 3, expect_panes},
    {"view", "NAME", "The view is Perspective, Orthographic, Top, Bottom, Front, Back, Right or Left", 3,
     expect_view},
    {"history", "n", "So many steps can be undone", 3, expect_history},
    {"brush", "NAME", "The brush has this type, or is `unset`", 3, expect_brush},
    {"tool", "NAME", "select, paint, fill or probe", 3, expect_tool},
    {"setting", "name=value", "A movement setting has this value", 3, expect_setting},
};

}  // namespace

void verb_expect(ScriptContext& context, const Words& words) {
    std::string names;
    for (const Expectation& expectation : expectations) {
        names += std::string(names.empty() ? "" : ", ") + expectation.name;
        if (words[1] != expectation.name) continue;
        if (words.size() != expectation.words)
            return context.fail(
                fmt::format("expected: expect {} {}", expectation.name, expectation.arguments));
        return expectation.check(context, words);
    }
    context.fail("cannot expect \"" + words[1] + "\"; there are: " + names);
}

std::string expectations_markdown() {
    std::string text = "| `expect` | arguments | holds when |\n|---|---|---|\n";
    for (const Expectation& expectation : expectations) {
        std::string arguments = expectation.arguments;
        for (std::size_t at = 0; (at = arguments.find('|', at)) != std::string::npos; at += 2)
            arguments.insert(at, 1, '\\');
        text += fmt::format("| `{}` | `{}` | {} |\n", expectation.name, arguments, expectation.meaning);
    }
    return text;
}

}  // namespace slipface
