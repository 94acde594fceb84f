#include "app/script.h"

#include <fmt/format.h>

#include <chrono>
#include <cstdio>
#include <thread>

#include "app/script_context.h"
#include "slipface/base/counted.h"
#include "slipface/base/files.h"
#include "slipface/base/text.h"
#include "tools/lab/audit_job.h"
#include "tools/lab/link.h"
#include "tools/lab/reach_job.h"
#include "tools/review/review.h"

namespace slipface {
namespace {

constexpr std::uint64_t max_script_bytes = 4u << 20;
constexpr int max_waited_frames = 36000;  // ten minutes

void click_at(ScriptContext& context, ImVec2 at, int button, bool twice = false) {
    OffscreenHost& host = context.host;
    host.move_mouse(at);
    host.frame();
    for (int i = 0; i < (twice ? 2 : 1); ++i) {
        host.mouse_button(button, true);
        host.frame();
        host.mouse_button(button, false);
        host.frame();
    }
    host.frame();
}

void click_widget(ScriptContext& context, const std::string& path, int button, bool twice = false) {
    const std::optional<ui::WidgetRect> widget = find_widget(context, path);
    if (!widget) return;
    if (!widget->enabled) return context.fail("widget \"" + path + "\" is disabled");
    click_at(context, widget->centre(), button, twice);
}

void verb_click(ScriptContext& context, const Words& words) {
    click_widget(context, words[1], 0);
}
void verb_double_click(ScriptContext& context, const Words& words) {
    click_widget(context, words[1], 0, true);
}
void verb_right_click(ScriptContext& context, const Words& words) {
    click_widget(context, words[1], 1);
}

void verb_menu(ScriptContext& context, const Words& words) {
    std::string path = "Menu";
    for (const std::string_view part : split(words[1], '/')) {
        path += "/" + std::string(part);
        click_widget(context, path, 0);
        if (context.failure != ScriptFailure::none) return;
        context.host.frame();
    }
}

void verb_hover(ScriptContext& context, const Words& words) {
    const std::optional<ui::WidgetRect> widget = find_widget(context, words[1]);
    if (!widget) return;
    context.host.move_mouse(widget->centre());
    context.host.frame();
    context.host.frame();
}

void verb_type(ScriptContext& context, const Words& words) {
    context.host.type(words[1]);
    context.host.frame();
    context.host.frame();
}

void verb_key(ScriptContext& context, const Words& words) {
    const Shortcut key = parse_shortcut(words[1]);
    if (key.key.empty()) return context.fail("expected a key such as Ctrl+S, found \"" + words[1] + "\"");
    context.host.press_key(key);
}

void verb_drag(ScriptContext& context, const Words& words) {
    const std::optional<ui::WidgetRect> widget = find_widget(context, words[1]);
    const std::optional<double> dx = number(context, words[2]), dy = number(context, words[3]);
    if (!widget || !dx || !dy) return;
    OffscreenHost& host = context.host;
    const ImVec2 from = widget->centre();
    host.move_mouse(from);
    host.frame();
    host.mouse_button(0, true);
    host.frame();
    constexpr int steps = 8;
    for (int i = 1; i <= steps; ++i) {
        host.move_mouse(
            {from.x + static_cast<float>(*dx * i / steps), from.y + static_cast<float>(*dy * i / steps)});
        host.frame();
    }
    host.mouse_button(0, false);
    host.frame();
    host.frame();
}

void verb_command(ScriptContext& context, const Words& words) {
    const Command* const command = find_command(words[1]);
    if (!command) {
        std::string near;
        const std::string_view family = std::string_view(words[1]).substr(0, words[1].find('.'));
        for (const Command& other : commands())
            if (std::string_view(other.id).starts_with(family))
                near += std::string(near.empty() ? "" : ", ") + other.id;
        return context.fail("no command \"" + words[1] + "\"" + (near.empty() ? "" : "; near: " + near));
    }
    if (!run_command(context.editor(), words[1]))
        return context.fail("command " + words[1] + " is not enabled now");
    context.host.frame();
    context.host.frame();
}

void verb_set(ScriptContext& context, const Words& words) {
    Editor& editor = context.editor();
    if (!editor.document) return context.fail("nothing is open");
    MovementSettings movement = editor.document->level().movement;
    if (const Status status = set_setting(movement, words[1]); !status)
        return context.fail(status.error().text());
    editor.document->set_movement(movement, "Set " + words[1].substr(0, words[1].find('=')));
    context.host.frame();
}

void verb_open(ScriptContext& context, const Words& words) {
    open_level(context.editor(), script_path(context, words[1]));
    context.host.frame();
    context.host.frame();
}

void verb_review(ScriptContext& context, const Words& words) {
    open_review(context.editor(), script_path(context, words[1]));
    context.host.frame();
    context.host.frame();
}

void verb_drop(ScriptContext& context, const Words& words) {
    context.host.app().drop_file(script_path(context, words[1]));
    context.host.frame();
    context.host.frame();
}

void verb_wheel(ScriptContext& context, const Words& words) {
    const std::optional<double> notches = number(context, words[1]);
    if (!notches) return;
    context.host.wheel(static_cast<float>(*notches));
    context.host.frame();
    context.host.frame();
}

void verb_wait(ScriptContext& context, const Words& words) {
    const std::optional<std::int64_t> frames = parse_int(words[1]);
    if (!frames || *frames < 0 || *frames > max_waited_frames)
        return context.fail("expected 0 to 36000 frames, found \"" + words[1] + "\"");
    for (std::int64_t i = 0; i < *frames; ++i)
        context.host.frame();
}

// Runs, audits and searches work frame by frame or in threads.
void verb_finish(ScriptContext& context, const Words&) {
    constexpr int max_frames = 20000;
    for (int i = 0; i < max_frames; ++i) {
        context.host.frame();
        const Editor& editor = context.editor();
        const bool auditing = (editor.audit && editor.audit->running()) || reach_runs(editor);
        if (!auditing && (!editor.lab.has_tape() || editor.lab.complete())) {
            context.host.frame();  // takes the result
            context.host.frame();  // shows it
            return;
        }
        if (auditing) std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    context.fail("the audit or the search did not end");
}

void verb_screenshot(ScriptContext& context, const Words& words) {
    context.host.settle();
    if (const Status status = save_png(script_path(context, words[1]), context.host.screenshot()); !status)
        context.fail(status.error().text());
}

void verb_autosave(ScriptContext& context, const Words&) {
    if (const Status status = context.host.autosave(); !status) context.fail(status.error().text());
    context.host.frame();
}

void verb_crash(ScriptContext& context, const Words&) {
    context.host.crash();
    context.host.frame();
    context.host.frame();
}

void verb_say(ScriptContext& context, const Words& words) {
    context.host.frame();
    fmt::print("{}\n", words[1]);
    std::fflush(stdout);
}

void verb_park(ScriptContext& context, const Words&) {
    context.host.park_mouse();
    context.host.frame();
    context.host.frame();
}

constexpr ScriptVerb verbs[] = {
    {"click", "\"Path\"", "Clicks the widget with this path, such as \"Toolbar/Paint\"", 1, 1, verb_click},
    {"double_click", "\"Path\"", "Clicks it twice", 1, 1, verb_double_click},
    {"right_click", "\"Path\"", "Clicks it with the right button", 1, 1, verb_right_click},
    {"menu", "\"Menu/Item\"", "Opens a menu and clicks an item, such as \"File/Save\"", 1, 1, verb_menu},
    {"hover", "\"Path\"", "Moves the mouse over a widget", 1, 1, verb_hover},
    {"drag", "\"Path\" dx dy", "Drags from a widget's centre by dx, dy pixels", 3, 3, verb_drag},
    {"type", "\"text\"", "Types into the text box that has the focus", 1, 1, verb_type},
    {"key", "Ctrl+S", "Presses a key with its modifiers, by the key's label", 1, 1, verb_key},
    {"command", "file.save", "Runs a command by its id (docs/commands.md)", 1, 1, verb_command},
    {"set", "name=value", "Sets a movement setting as one step of history (docs/settings.md)", 1, 1,
     verb_set},
    {"viewport", "click|hover|drag POINT [POINT] [left|middle|right] [ctrl] [shift] [alt]",
     "Uses the mouse in the view; a POINT is x y in pixels of the view, or @x,y,z in the level", 2, 9,
     verb_viewport},
    {"wheel", "n", "Turns the wheel by n notches at the mouse position", 1, 1, verb_wheel},
    {"hold", "W [A] [Space] frames", "Holds movement keys down for n frames", 2, 8, verb_hold},
    {"look", "dx dy", "Moves the mouse by dx, dy pixels while playing", 2, 2, verb_look},
    {"camera", "eye x,y,z target x,y,z | frame | bookmark NAME | save NAME | delete NAME | rename NAME NEW",
     "Places the camera, or changes the level's cameras", 1, 4, verb_camera},
    {"only", "PANEL [SIZE] | view | all",
     "Shows one panel beside the view, as wide or high as wanted, and nothing else; the view alone; "
     "everything "
     "again",
     1, 2, verb_only},
    {"pane", "n", "Activates this view, 1 to 4", 1, 1, verb_pane},
    {"select",
     "faces 3,5-9 [add|remove] | type NAME | save NAME | recall NAME | delete NAME | rename NAME NEW",
     "Selects faces by number or type, or saves selections", 2, 3, verb_select},
    {"replace", "TYPE NEW|unset",
     "Changes all faces of one type to another; only inside the selection if there is one", 2, 2,
     verb_replace},
    {"prop",
     "place FILE x,y,z [NAME] | set NAME MEMBER VALUE | file FILE|none | choose|duplicate|delete NAME",
     "Places and changes props; rotations are in degrees; `file` is what a click with the tool places", 2, 4,
     verb_prop},
    {"open", "PATH", "Opens a level without questions", 1, 1, verb_open},
    {"review", "PATH", "Opens a snapshot report for review (docs/snapshots.md)", 1, 1, verb_review},
    {"preset", "open|save PATH", "Reads the movement settings from a preset file, or writes them to one", 2,
     2, verb_preset},
    {"run", "open|add|import PATH",
     "Opens a tape, adds one as a ghost, or imports positions that another controller recorded", 2, 2,
     verb_run},
    {"export", "obj|gltf|game PATH", "Writes the level for other programs, as File > Export does", 2, 2,
     verb_export},
    {"drop", "PATH", "Drops a file onto the window", 1, 1, verb_drop},
    {"wait", "n", "Lets n frames pass, each 1/60 s", 1, 1, verb_wait},
    {"autosave", "", "Writes the next autosave now", 0, 0, verb_autosave},
    {"crash", "", "Ends as in a crash, leaving autosaves, and starts again", 0, 0, verb_crash},
    {"say", "\"text\"", "Prints a line to standard output", 1, 1, verb_say},
    {"finish", "", "Lets frames pass until the lab's runs are complete and no audit or search runs", 0, 0,
     verb_finish},
    {"park_mouse", "", "Moves the mouse out of the window", 0, 0, verb_park},
    {"screenshot", "PATH", "Writes a PNG of the window once it no longer changes", 1, 1, verb_screenshot},
    {"expect", "WHAT ...", "Fails the script unless a condition holds; see below", 1, 4, verb_expect},
};

std::string all_verbs() {
    std::string list;
    for (const ScriptVerb& verb : verbs)
        list += std::string(list.empty() ? "" : ", ") + verb.name;
    return list;
}

void run_line(ScriptContext& context, const ScriptLine& line) {
    for (const ScriptVerb& verb : verbs) {
        if (line.words[0] != verb.name) continue;
        const std::size_t arguments = line.words.size() - 1;
        if (arguments < verb.least || arguments > verb.maximum)
            return context.fail(fmt::format("found {} after {}, expected: {} {}", counted(arguments, "word"),
                                            verb.name, verb.name, verb.arguments));
        return verb.run(context, line.words);
    }
    context.fail("no verb \"" + line.words[0] + "\"; there are: " + all_verbs());
}

bool expects_message(const ScriptLine& line) {
    return line.words.size() > 1 && line.words[0] == "expect" && line.words[1] == "message";
}

// A script that could not write a file has failed, unless it expects the message.
void fail_at_refused_write(ScriptContext& context) {
    const std::optional<MessageDialog>& message = context.editor().message;
    if (message && message->of_refused_write) context.fail(message->title + ": " + message->text);
}

}  // namespace

std::span<const ScriptVerb> script_verbs() {
    return verbs;
}

std::string script_verbs_markdown() {
    std::string text =
        "# Scripts\n\n"
        "**What it is.** A text that uses the editor as a person does, without a window: for tests, images "
        "and films.\n\n"
        "**How you use it.** `slipface edit LEVEL --headless --script FILE --screenshot OUT.png`. One verb a "
        "line; `#` begins a comment; words with spaces stand in double quotes. Widgets are named by their "
        "path; an error lists the nearest ones.\n\n"
        "**What it costs.** A second or two for each script. A line that cannot write what it should, such "
        "as "
        "a save on a full disk, ends it with exit code 2, unless the next line is `expect message`.\n\n"
        "| verb | arguments | what it does |\n|---|---|---|\n";
    for (const ScriptVerb& verb : verbs) {
        std::string arguments = verb.arguments;
        for (std::size_t at = 0; (at = arguments.find('|', at)) != std::string::npos; at += 2)
            arguments.insert(at, 1, '\\');
        text += fmt::format("| `{}` | {}{}{} | {} |\n", verb.name, arguments.empty() ? "" : "`", arguments,
                            arguments.empty() ? "" : "`", verb.meaning);
    }
    text += "\n## What can be expected\n\n" + expectations_markdown();
    text +=
        "\n## Links\n\n"
        "What stands behind the `#` of the address of Slipface as a page (docs/web.md) opens a view: "
        "`#level=easy&reach=15&only=reach`. `slipface edit` takes the same in place of a level.\n\n"
        "| part | value | what it shows |\n|---|---|---|\n";
    for (const LinkPart& part : link_parts())
        text += fmt::format("| `{}=` | {} | {} |\n", part.name, part.value, part.meaning);
    return text;
}

Result<std::vector<ScriptLine>> parse_script(std::string_view text, const std::string& location) {
    std::vector<ScriptLine> lines;
    int number = 0;
    for (const std::string_view raw : split(text, '\n')) {
        ++number;
        ScriptLine line{number, {}};
        std::size_t i = 0;
        while (i < raw.size()) {
            const char c = raw[i];
            if (c == ' ' || c == '\t' || c == '\r') {
                ++i;
            } else if (c == '#') {
                break;
            } else if (c == '"') {
                std::string word;
                for (++i; i < raw.size() && raw[i] != '"'; ++i) {
                    if (raw[i] == '\\' && i + 1 < raw.size()) ++i;
                    word += raw[i];
                }
                if (i >= raw.size())
                    return Error{fmt::format("{}:{}", location, number), "a quoted word has no closing '\"'"};
                ++i;
                line.words.push_back(std::move(word));
            } else {
                const std::size_t end = std::min(raw.find_first_of(" \t\r", i), raw.size());
                line.words.emplace_back(raw.substr(i, end - i));
                i = end;
            }
        }
        if (!line.words.empty()) lines.push_back(std::move(line));
    }
    return lines;
}

ScriptResult run_script(OffscreenHost& host, std::string_view text, const std::string& location,
                        const std::filesystem::path& folder, const std::function<void()>& after_line) {
    ScriptResult result;
    const Result<std::vector<ScriptLine>> lines = parse_script(text, location);
    if (!lines) return {ScriptFailure::bad_input, lines.error(), 0};
    bool expected = false;  // the open message was, by a line `expect message`
    for (std::size_t i = 0; i < lines->size(); ++i) {
        const ScriptLine& line = (*lines)[i];
        ScriptContext context{host, folder, ScriptFailure::none, {}};
        run_line(context, line);
        expected = host.editor().message && (expected || expects_message(line));
        if (!expected && (i + 1 == lines->size() || !expects_message((*lines)[i + 1])))
            fail_at_refused_write(context);
        if (context.failure != ScriptFailure::none) {
            result.failure = context.failure;
            result.error = {fmt::format("{}:{}", location, line.number), context.message};
            return result;
        }
        ++result.lines_done;
        if (after_line) after_line();
    }
    host.settle();
    return result;
}

ScriptResult run_script_file(OffscreenHost& host, const std::filesystem::path& file,
                             const std::function<void()>& after_line) {
    const Result<std::string> text = read_file(file, max_script_bytes);
    if (!text) return {ScriptFailure::bad_input, text.error(), 0};
    std::error_code error;
    return run_script(host, *text, file.filename().string(), std::filesystem::current_path(error),
                      after_line);
}

}  // namespace slipface
