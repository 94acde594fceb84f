#include "panels/hack_card.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <span>
#include <string_view>

#include "panels/property_rows.h"
#include "slipface/scenes/demo.h"
#include "slipface/sim/formula.h"
#include "tools/commands/icons.h"
#include "tools/lab/lab_actions.h"
#include "widgets/imgui_compat.h"
#include "widgets/theme.h"
#include "widgets/ui.h"

namespace slipface {
namespace {

// The run under the present settings, or null.
const TapeRun* live_run(const Editor& editor) {
    if (!editor.lab.has_tape() || editor.playtest) return nullptr;
    return &editor.lab.runs()[1].run;
}

void effect_rows(Editor& editor, const SettingInfo& info) {
    const std::optional<std::size_t> row = hack_row(info.name);
    if (!row) return;
    const TapeRun* run = live_run(editor);
    if (!run) {
        ui::muted_text("Walk the level to see in how many ticks this hack acted.");
        return;
    }
    ImGui::Text("Acted in %u of %zu ticks", run->acted_count(*row), run->samples().size());
    if (run->acted_count(*row) == 0) return;
    if (ui::button("Next tick it acted in", "Move the cursor there")) {
        Lab& lab = editor.lab;
        const auto samples = run->samples();
        for (std::size_t i = 1; i <= samples.size(); ++i) {
            const std::size_t tick = (lab.cursor() + i) % samples.size();
            if (!((samples[tick].acted >> *row) & 1)) continue;
            lab.motion = LabMotion::paused;
            lab.explain(1);
            lab.seek(tick);
            editor.layout.show(PanelId::why);
            break;
        }
    }
    ImGui::SameLine();
    if (is_switch(info) &&
        ui::button("Ghost without it", "Run the tape with this switch inverted, as another ghost")) {
        MovementSettings settings = editor.document->level().movement;
        if (set_setting(settings, info, 1.0 - get_setting(settings, info))) editor.lab.pin(settings);
        editor.layout.show(PanelId::ghosts);
    }
}

// What a hack did in a tick: the numbers of its formula, and the sentence of the story.
struct Explained {
    std::size_t tick = 0;
    std::vector<FormulaNumber> numbers;
    std::string sentence;
};
std::optional<Explained> explain(const SettingInfo& info, const FormulaInfo& formula, const TickTrace& trace,
                                 const StoryNames& names) {
    Explained explained{trace.tick, formula_numbers(formula, trace, names), {}};
    if (explained.numbers.empty()) return std::nullopt;
    for (const StoryLine& line : describe(trace, names))
        if (line.hack == &info && line.tone != StoryTone::refused && explained.sentence.empty())
            explained.sentence = line.text;
    return explained;
}

// A demo with both of its runs, built when its card is opened for the first time.
struct BuiltDemo {
    Demo demo;
    TapeRun runs[2];  // off, on
    std::optional<Explained> explained = std::nullopt;
};
const BuiltDemo& built_demo(const DemoInfo& info) {
    static std::map<std::string_view, std::unique_ptr<BuiltDemo>> built;
    std::unique_ptr<BuiltDemo>& entry = built[info.name];
    if (entry) return *entry;
    Demo demo = make_demo(info);
    const Vec3 start = demo.tape.start.value_or(demo.level.spawn);
    TapeRun off = TapeRun::under(std::make_shared<const Tape>(demo.off_tape), demo.off, start);
    TapeRun on = TapeRun::under(std::make_shared<const Tape>(demo.tape), demo.on, start);
    entry.reset(new BuiltDemo{std::move(demo), {std::move(off), std::move(on)}});
    for (std::size_t i = 0; i < 2; ++i) {
        Result<LevelScene> scene =
            LevelScene::build(entry->demo.level, i == 0 ? entry->demo.off : entry->demo.on);
        if (!scene) continue;
        const TickScene ticks(*scene);
        entry->runs[i].advance(ticks, TapeRun::max_ticks);
        const FormulaInfo* const formula = formula_of(info);
        if (i == 0 || formula == nullptr) continue;
        if (const std::optional<TickTrace> trace = telling_tick(
                entry->runs[i], ticks, info.hack, entry->demo.off, step_of(entry->demo.off_tape)))
            entry->explained =
                explain(*find_setting(info.hack), *formula, *trace, StoryNames(entry->demo.level));
    }
    return *entry;
}

// The path of the run, with the player at intervals.
ImageRequest demo_image(const DemoInfo& info, bool on) {
    const BuiltDemo& built = built_demo(info);
    ImageRequest request;
    request.level = &built.demo.level;
    request.camera.eye = built.demo.camera.eye;
    request.camera.target = built.demo.camera.target;
    request.camera.fov_y = built.demo.camera.fov_y;
    const TapeRun& run = built.runs[on ? 1 : 0];
    const Color trail = on ? Color{0.45f, 0.86f, 0.60f, 1.0f} : Color{0.98f, 0.47f, 0.42f, 1.0f};
    const auto samples = run.samples();
    Vec3 previous = run.start();
    for (const TickSample& sample : samples) {
        if (!sample.respawned && sample.position != previous)
            request.overlay.line(previous, sample.position, trail, 3.0f, true);
        previous = sample.position;
    }
    constexpr std::size_t ghosts = 5;
    for (std::size_t i = 0; i < ghosts && !samples.empty(); ++i) {
        const TickSample& sample = samples[(samples.size() - 1) * i / (ghosts - 1)];
        const Vec3 radii = body_radii(run.settings(), {.crouched = sample.crouched});
        Color fill = trail;
        fill.alpha = i + 1 == ghosts ? 0.45f : 0.10f;
        Color outline = trail;
        outline.alpha = i + 1 == ghosts ? 1.0f : 0.5f;
        request.overlay.ellipsoid(sample.position, radii, fill, outline);
    }
    return request;
}

// The formula and what its symbols are: in the tick at the cursor where the hack acts there, else in the
// demo's.
void formula_rows(Editor& editor, const SettingInfo& info, const DemoInfo* demo) {
    const FormulaInfo* formula = demo != nullptr ? formula_of(*demo) : find_formula(info.name);
    if (formula == nullptr) return;
    ImGui::Spacing();
    ImGui::PushTextWrapPos(0.0f);
    ImGui::TextColored(ui::palette().accent, "%s", formula->text);
    ImGui::PopTextWrapPos();
    std::optional<Explained> explained;
    if (live_run(editor) != nullptr && editor.lab.ticks() > 0 && editor.lab.complete())
        explained =
            explain(info, *formula, editor.lab.trace(*editor.document), StoryNames(editor.document->level()));
    const bool live = explained.has_value();
    if (!live && demo != nullptr) explained = built_demo(*demo).explained;
    if (!explained) return;
    for (const FormulaNumber& number : explained->numbers) {
        const std::string text = number.symbol + " = " + number.text;
        if (&number != &explained->numbers.front())
            ui::flow(ImGui::CalcTextSize(text.c_str()).x, 1.2f * ImGui::GetFontSize());
        ImGui::TextUnformatted(text.c_str());
    }
    ui::muted_text(fmt::format("{} tick {}{}{}", live ? "At the cursor," : "In the demo,", explained->tick,
                               explained->sentence.empty() ? "" : ": ", explained->sentence)
                       .c_str());
}

void images(Editor& editor, FrameContext& frame, const DemoInfo& info) {
    const float em = ImGui::GetFontSize();
    const float gap = 0.6f * em;
    const float width = std::floor(0.5f * (ImGui::GetContentRegionAvail().x - gap));
    const ImVec2 size{width, std::floor(width * 9.0f / 16.0f)};
    if (frame.images) {
        const float density = ImGui::GetIO().DisplayFramebufferScale.x;
        const ImVec2 at = ImGui::GetCursorScreenPos();
        for (const bool on : {false, true}) {
            const std::string key = std::string("demo ") + info.name + (on ? " on" : " off");
            const unsigned texture = frame.images->image(key, static_cast<int>(std::lround(size.x * density)),
                                                         static_cast<int>(std::lround(size.y * density)),
                                                         [&] { return demo_image(info, on); });
            const ImVec2 min{at.x + (on ? width + gap : 0.0f), at.y};
            ImDrawList& list = *ImGui::GetWindowDrawList();
            list.AddImageRounded(ui::texture_id(texture), min, {min.x + size.x, min.y + size.y}, {0, 1},
                                 {1, 0}, 0xffffffffu, 5.0f * ui::scale());
            const char* const word = on ? "On" : "Off";
            const ImVec2 text = ImGui::CalcTextSize(word);
            list.AddRectFilled({min.x + 0.4f * em, min.y + 0.4f * em},
                               {min.x + 1.2f * em + text.x, min.y + 0.8f * em + text.y},
                               ui::packed(ui::with_alpha(ui::palette().window, 0.82f)), 4.0f * ui::scale());
            list.AddText({min.x + 0.8f * em, min.y + 0.6f * em},
                         ui::packed(on ? ui::palette().good : ui::palette().bad), word);
        }
        ImGui::Dummy({2.0f * width + gap, size.y});
    }
    if (ui::button("Open demo", "Open this scene with its tape, and a ghost with the switch off")) {
        ImGui::CloseCurrentPopup();
        open_demo(editor, info);
    }
}

// The demo to show next: its place in demo_table(), which has the order of the lecture.
int order_buttons(int shown) {
    const std::span<const DemoInfo> order = demo_table();
    const int last = static_cast<int>(order.size()) - 1;
    const auto title = [&](int i) { return order[static_cast<std::size_t>(i)].title; };
    ImGui::Spacing();
    ImGui::Separator();
    int next = shown;
    if (ui::button("Previous", shown > 0 ? title(shown - 1) : nullptr, shown > 0)) next = shown - 1;
    ImGui::SameLine();
    if (ui::button("Next", shown < last ? title(shown + 1) : nullptr, shown < last)) next = shown + 1;
    const std::string where = fmt::format("{} of {}{}{}", shown + 1, last + 1, shown < last ? ", next: " : "",
                                          shown < last ? title(shown + 1) : "");
    ui::flow(ImGui::CalcTextSize(where.c_str()).x);
    ui::muted_text(where.c_str());
    return next;
}

// What goes wrong and what cures it first; then how, and the lecture's own names.
void card(Editor& editor, FrameContext& frame, const SettingInfo& info, const DemoInfo* demo) {
    ui::heading(demo != nullptr ? demo->title : info.label);
    if (demo != nullptr) {
        ImGui::TextWrapped("%s", demo->problem);
        ImGui::TextWrapped("%s", demo->cure);
    }
    const FormulaInfo* formula = demo != nullptr ? formula_of(*demo) : find_formula(info.name);
    if (formula != nullptr && *formula->lecture != '\0')
        ui::muted_text(fmt::format("The lecture: {}", formula->lecture).c_str());
    if (demo != nullptr)
        ui::muted_text(fmt::format("The setting {}. Off: {}.", info.label, off_of(*demo)).c_str());
    else
        ImGui::TextWrapped("%s", meaning_of(info).c_str());
    formula_rows(editor, info, demo);
    if (demo != nullptr) {
        ImGui::Spacing();
        images(editor, frame, *demo);
        ui::muted_text(exercise_of(*demo).c_str());
    }
    ImGui::Spacing();
    effect_rows(editor, info);
}

}  // namespace

void hack_cell(Editor& editor, FrameContext& frame, const SettingInfo& info) {
    const float em = ImGui::GetFontSize();
    const std::optional<std::size_t> row = hack_row(info.name);
    if (const TapeRun* run = live_run(editor); run && row) {
        const std::string text = fmt::format("{}", run->acted_count(*row));  // the tooltip has the total
        const float width = ImGui::CalcTextSize(text.c_str()).x;
        const float room = std::min(2.6f * em, ImGui::GetContentRegionAvail().x - 1.6f * em);
        ImGui::SetCursorPosX(ImGui::GetCursorPosX() + std::max(0.0f, room - width));
        ImGui::AlignTextToFramePadding();
        ImGui::TextColored(run->acted_count(*row) > 0 ? ui::palette().text : ui::palette().muted, "%s",
                           text.c_str());
        ui::tooltip(
            fmt::format("Acted in {} of {} ticks of the tape", run->acted_count(*row), run->samples().size())
                .c_str());
        ImGui::SameLine(0, 0.2f * em);
    }
    const ui::Scope scope(info.label);
    ImGui::PushStyleColor(ImGuiCol_Button, ImVec4(0, 0, 0, 0));
    ImGui::PushStyleColor(ImGuiCol_Text, ui::palette().muted);
    if (ImGui::Button(icons::why, {1.4f * em, 0.0f})) ImGui::OpenPopup("card");
    ImGui::PopStyleColor(2);
    ui::record_last_item("About");
    ui::tooltip("What it does, and where it acted");
    ImGui::SetNextWindowSize({30.0f * em, 0.0f});
    if (!ImGui::BeginPopup("card")) return;
    const ui::Scope in_card("Card");
    // "Next" turns the card to another hack, until it is closed.
    int& turned_to = *ImGui::GetStateStorage()->GetIntRef(ImGui::GetID("turned to"), -1);
    if (ImGui::IsWindowAppearing()) turned_to = -1;
    const std::span<const DemoInfo> order = demo_table();
    const auto own = std::find_if(order.begin(), order.end(), [&](const DemoInfo& demo) {
        return info.name == std::string_view(demo.hack) && !plays_lecture(demo);
    });
    if (turned_to < 0 && own != order.end()) turned_to = static_cast<int>(own - order.begin());
    const DemoInfo* demo = turned_to < 0 ? nullptr : &order[static_cast<std::size_t>(turned_to)];
    card(editor, frame, demo == nullptr ? info : *find_setting(demo->hack), demo);
    if (demo != nullptr) turned_to = order_buttons(turned_to);
    ui::end(ImGui::EndPopup);
}

void card_panel(Editor& editor, FrameContext& frame) {
    const ui::Scope scope("Card");
    const DemoInfo* const demo = shown_demo(editor);
    if (demo != nullptr)
        card(editor, frame, *find_setting(demo->hack), demo);
    else
        ui::muted_text("Lab > Demos opens a demo, and this is its card");
    const int shown = demo != nullptr ? static_cast<int>(demo - demo_table().data()) : -1;
    if (const int next = order_buttons(shown); next != shown)
        open_demo(editor, demo_table()[static_cast<std::size_t>(next)]);
}

}  // namespace slipface
