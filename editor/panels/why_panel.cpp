// The story of the tick at the cursor, line by line, and what each switch would have changed.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>

#include "panels/lab_track.h"
#include "panels/property_rows.h"
#include "tools/commands/icons.h"
#include "tools/lab/lab_actions.h"
#include "tools/lab/why.h"
#include "widgets/theme.h"
#include "widgets/ui.h"

namespace slipface {
namespace {

ImVec4 tone_color(StoryTone tone) {
    const ui::Palette& p = ui::palette();
    switch (tone) {
        case StoryTone::acted: return p.accent;
        case StoryTone::refused: return p.muted;
        case StoryTone::trouble: return p.bad;
        case StoryTone::plain: break;
    }
    return p.text;
}

void wrapped(const ImVec4& color, const std::string& text) {
    ImGui::PushStyleColor(ImGuiCol_Text, color);
    ImGui::TextUnformatted(wrap_words(text, ImGui::GetContentRegionAvail().x).c_str());
    ImGui::PopStyleColor();
}

const char* cure_icon(const Cure& cure) {
    return cure.passes ? icons::check : icons::why;
}

const char* use_tip(const Cure& cure) {
    return cure.mesh ? "Move the camera to what is to be repaired in the modelling tool"
                     : "Apply this change to the level as one step of history";
}

// The most important line: what stopped the player, and the button that cures it.
void headline(Editor& editor, const Stop* stop) {
    const ui::Palette& p = ui::palette();
    if (stop == nullptr) {
        wrapped(p.muted, "Nothing stopped you in this tick");
        return;
    }
    ui::push_font(ui::fonts().semibold);
    wrapped(p.text, stop->headline);
    ImGui::PopFont();
    const std::vector<Cure>* cures = cures_at_cursor(editor);
    if (cures == nullptr) {
        wrapped(p.muted, "Searching for a cure\u2026");
    } else if (!cures->empty() && cures->front().passes) {
        const Cure& best = cures->front();
        const ui::Scope scope("Headline");
        const std::string label = best.text + "###Cure";
        if (ui::button(label.c_str(), use_tip(best))) return use_cure(editor, Cure(best));
        ImGui::SameLine();
    }
    if (ui::button("Look there", "Move the camera there")) go_to_stop(editor, *stop);
    ui::flow(ui::button_width("Read more"));
    symptom_button(editor, stop->symptom);
}

// A row of a list: when, and what. True if it was clicked.
bool moment(std::size_t row, double time_s, const std::string& text, bool here) {
    const float em = ImGui::GetFontSize();
    ImGui::PushID(static_cast<int>(row));
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float time_width = 3.8f * em;
    const std::string words =
        wrap_words(text, std::max(4.0f * em, ImGui::GetContentRegionAvail().x - time_width));
    const float height = ImGui::CalcTextSize(words.c_str()).y + 0.3f * em;
    const bool clicked = ImGui::Selectable("##moment", here, 0, {0, height});
    ui::record_last_item(std::to_string(row), true, here);
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const std::string time = fmt::format("{:.2f} s", time_s);
    list.AddText({at.x + 0.2f * em, at.y + 0.15f * em}, ui::packed(ui::palette().muted), time.c_str());
    list.AddText({at.x + time_width, at.y + 0.15f * em}, ui::packed(ui::palette().text), words.c_str());
    ImGui::PopID();
    return clicked;
}

// A list that stays short: beyond a few rows it scrolls by itself, and the row at the cursor is in view. The
// index of the row that was clicked.
template <class Moments, class Text>
std::optional<std::size_t> moments(const char* name, const Lab& lab, const Moments& rows, const Text& text) {
    constexpr std::size_t most = 6;
    const ui::Scope scope(name);
    const std::size_t cursor = lab.cursor();
    const bool scrolls = rows.size() > most;
    if (scrolls) {
        const float height = 1.6f * static_cast<float>(most) * ImGui::GetTextLineHeightWithSpacing();
        ImGui::BeginChild(name, {0, height}, false, ImGuiWindowFlags_NoSavedSettings);
    }
    int& shown = *ImGui::GetStateStorage()->GetIntRef(ImGui::GetID(name), -1);
    std::optional<std::size_t> clicked;
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const bool here = cursor >= rows[i].first && cursor <= rows[i].last;
        if (moment(i, static_cast<double>(rows[i].first) * lab.tape().dt, text(rows[i]), here)) clicked = i;
        if (scrolls && here && shown != static_cast<int>(cursor)) ImGui::SetScrollHereY(0.3f);
    }
    shown = static_cast<int>(cursor);
    if (scrolls) ui::end(ImGui::EndChild);
    return clicked;
}

// All stops of the run; a click goes there.
void stops_list(Editor& editor, const std::vector<Stop>& stops) {
    ui::heading(fmt::format("Stops in this run ({})", stops.size()).c_str());
    if (stops.empty()) {
        ui::muted_text("Nothing stopped the player");
        return;
    }
    const auto clicked = moments("Stops", editor.lab, stops, [](const Stop& stop) { return stop.headline; });
    if (clicked) go_to_stop(editor, stops[*clicked]);
}

// What else happened; a click goes there.
void events_list(Editor& editor, const std::vector<RunEvent>& events) {
    if (events.empty()) return;
    ui::heading(fmt::format("What else happened ({})", events.size()).c_str());
    std::map<std::string_view, std::size_t> counts;
    for (const RunEvent& event : events)
        ++counts[event.word];
    {
        const ui::Scope scope("Filter");
        ui::Chips chips;
        for (const auto& [word, count] : counts) {
            const auto hidden = editor.why.hidden_words.find(word);
            const bool shown = hidden == editor.why.hidden_words.end();
            if (!chips.chip(sentence_case(std::string(word)).c_str(), count, shown)) continue;
            shown ? (void)editor.why.hidden_words.emplace(word) : (void)editor.why.hidden_words.erase(hidden);
        }
    }
    std::vector<RunEvent> shown;
    std::ranges::copy_if(events, std::back_inserter(shown),
                         [&](const RunEvent& event) { return is_shown(editor.why, event); });
    const auto clicked =
        moments("Events", editor.lab, shown, [](const RunEvent& event) { return event.text; });
    if (!clicked) return;
    editor.lab.motion = LabMotion::paused;
    editor.lab.seek(shown[*clicked].first);
}

// What disturbed the other controller's player, and whether Slipface's mover passes there.
void imported_list(Editor& editor) {
    if (!editor.imported.run) return;
    ui::heading(("Run of another controller: " + editor.imported.name).c_str());
    const std::vector<RecordedFault>* const faults = imported_faults(editor);
    if (faults == nullptr) return ui::muted_text("Looking for what disturbed it\u2026");
    if (faults->empty()) return ui::muted_text("Nothing disturbed its player");
    const auto clicked = moments("Imported", editor.lab, *faults, [](const RecordedFault& fault) {
        return sentence_case(fault.text) + ". " + compared_text(fault);
    });
    if (clicked) go_to_fault(editor, RecordedFault((*faults)[*clicked]));
}

// What each rule did to the velocity in this tick, as bars of one scale.
void velocity_bars(const TickTrace& trace, const StoryNames& names) {
    const std::vector<VelocityChange> changes = velocity_changes(trace, names);
    const ui::Palette& p = ui::palette();
    const double before = motion_velocity(trace.before).norm(),
                 after = motion_velocity(trace.after.stepped).norm();
    ui::heading(fmt::format("Velocity: {:.2f} to {:.2f} m/s", before, after).c_str());
    double most = 1e-3;
    for (const VelocityChange& change : changes)
        most = std::max(most, change.change.norm());
    const float em = ImGui::GetFontSize();
    const Vec3 wish(trace.input.wish.x(), 0.0, trace.input.wish.y());
    const Vec3 way = wish.isZero(0.0) ? trace.before.velocity : wish;
    for (const VelocityChange& change : changes) {
        const double size = change.change.norm(), along = change.change.dot(way);
        wrapped(p.text, fmt::format("{:.2f} m/s  {}", size, change.text));
        const ImVec2 at = ImGui::GetCursorScreenPos();
        const float width = ImGui::GetContentRegionAvail().x * static_cast<float>(size / most);
        const bool aside = std::abs(along) < 1e-6;
        ImGui::GetWindowDrawList()->AddRectFilled({at.x, at.y - 0.1f * em}, {at.x + width, at.y + 0.05f * em},
                                                  ui::packed(aside         ? p.muted
                                                             : along < 0.0 ? p.bad
                                                                           : p.good));
        ImGui::Dummy({0.0f, 0.15f * em});
    }
}

void cures_list(Editor& editor, const std::vector<Cure>& cures) {
    ui::heading("What would have helped");
    if (cures.empty()) {
        ui::muted_text("No switch, number, surface type or repair that was tried lets the player pass");
        return;
    }
    const ui::Palette& p = ui::palette();
    const ui::Scope scope("Cures");
    const float padding = 4.0f * ImGui::GetStyle().FramePadding.x + ImGui::GetStyle().ItemSpacing.x;
    std::optional<std::size_t> ghost, used;
    for (std::size_t i = 0; i < cures.size(); ++i) {
        const Cure& cure = cures[i];
        ImGui::PushID(static_cast<int>(i));
        const ui::Scope row(std::to_string(i));
        const bool runs = !cure.settings.empty() && cure.faces.empty();
        const float buttons = ImGui::CalcTextSize((cure.button + (runs ? "Ghost" : "")).c_str()).x +
                              (runs ? padding : 0.5f * padding);
        const float left = ImGui::GetCursorPosX();
        const float width = ImGui::GetContentRegionAvail().x;
        ImGui::AlignTextToFramePadding();
        ImGui::PushStyleColor(ImGuiCol_Text, cure.passes ? p.good : p.text);
        ImGui::TextUnformatted(
            wrap_words(fmt::format("{}  {}", cure_icon(cure), cure.text), width - buttons - padding).c_str());
        ImGui::PopStyleColor();
        ImGui::SameLine();
        ImGui::SetCursorPosX(left + std::max(0.0f, width - buttons));
        if (runs) {
            if (ui::button("Ghost", "Run the whole tape with this change as one more ghost")) ghost = i;
            ImGui::SameLine();
        }
        if (ui::button(cure.button.c_str(), use_tip(cure))) used = i;
        std::string effect = fmt::format("{:.2f} m further", cure.gained_m);
        if (!cure.passes) effect += ", but still stopped";
        if (!cure.cost.empty()) effect += "; " + cure.cost;
        wrapped(p.muted, effect);
        ImGui::PopID();
    }
    if (ghost) {
        MovementSettings settings = editor.lab.trace(*editor.document).settings;
        for (const std::string& setting : cures[*ghost].settings)
            (void)set_setting(settings, setting);
        editor.lab.pin(settings);
        editor.layout.show(PanelId::ghosts);
    }
    if (used) use_cure(editor, Cure(cures[*used]));
}

std::string effect_text(const SwitchEffect& effect) {
    std::string text;
    const auto add = [&](const std::string& part) { text += (text.empty() ? "" : ", ") + part; };
    if (std::abs(effect.further_m) >= 0.005)
        add(fmt::format("{:.2f} m {}", std::abs(effect.further_m),
                        effect.further_m > 0 ? "further" : "less far"));
    if (std::abs(effect.speed_gained) >= 0.05)
        add(fmt::format("{:.2f} m/s at the end ({:+.2f})", effect.end_speed, effect.speed_gained));
    if (effect.grounded_gained != 0) add(fmt::format("{:+d} ticks on the ground", effect.grounded_gained));
    if (text.empty()) text = fmt::format("ends {:.1f} mm away", effect.apart_m * 1000.0);
    return text;
}

void switches(Editor& editor) {
    constexpr std::size_t maximum = 5;
    Lab& lab = editor.lab;
    ui::heading("What a switch would change");
    const std::vector<SwitchEffect>& effects = lab.switches(*editor.document);
    if (effects.empty()) {
        ui::muted_text(fmt::format("No switch changes the next {} ticks", Lab::switch_ticks).c_str());
        return;
    }
    const ui::Scope scope("Switch");
    std::optional<std::size_t> ghost, set;
    for (std::size_t i = 0; i < std::min(maximum, effects.size()); ++i) {
        const SwitchEffect& effect = effects[i];
        ImGui::PushID(static_cast<int>(i));
        const std::string name =
            std::string(effect.info->label) + " " + effect.setting.substr(effect.setting.find('=') + 1);
        const bool better = effect.further_m > 0.005 || effect.grounded_gained > 0;
        const ui::Scope row(effect.setting);
        ImGui::AlignTextToFramePadding();
        ImGui::TextColored(better ? ui::palette().good : ui::palette().text, "%s", name.c_str());
        ui::tooltip(meaning_of(*effect.info).c_str());
        const float buttons = ImGui::CalcTextSize("GhostSet").x + 4.0f * ImGui::GetStyle().FramePadding.x +
                              ImGui::GetStyle().ItemSpacing.x;
        ImGui::SameLine();
        ImGui::SetCursorPosX(ImGui::GetCursorPosX() +
                             std::max(0.0f, ImGui::GetContentRegionAvail().x - buttons));
        if (ui::button("Ghost", "Run the whole tape with this switch as one more ghost")) ghost = i;
        ImGui::SameLine();
        if (ui::button("Set", "Change the switch in this level")) set = i;
        wrapped(ui::palette().muted, effect_text(effect));
        ImGui::PopID();
    }
    if (ghost) {
        MovementSettings settings = lab.trace(*editor.document).settings;
        if (set_setting(settings, effects[*ghost].setting)) lab.pin(settings);
        editor.layout.show(PanelId::ghosts);
    }
    if (set) apply_setting(editor, std::string(effects[*set].setting));
}

void story_lines(Editor& editor, const std::vector<StoryLine>& story) {
    const ui::Scope scope("Story");
    const float em = ImGui::GetFontSize();
    std::optional<std::size_t> clicked;
    for (std::size_t i = 0; i < story.size(); ++i) {
        const StoryLine& line = story[i];
        if (line.folded && !editor.lab.show_folded) continue;
        ImGui::PushID(static_cast<int>(i));
        const float indent = static_cast<float>(line.depth) * em + 0.6f * em;
        const ImVec2 at = ImGui::GetCursorScreenPos();
        const float width = ImGui::GetContentRegionAvail().x;
        const float wrap = std::max(4.0f * em, width - indent);
        const float title = line.title.empty() ? 0.0f : ImGui::CalcTextSize(line.title.c_str()).y;
        const std::string words = wrap_words(line.text, wrap);
        const ImVec2 text = ImGui::CalcTextSize(words.c_str());
        const float height = title + text.y + 0.4f * em;
        if (ImGui::InvisibleButton("line", {width, height})) clicked = i;
        ui::record_last_item(std::to_string(i), true, editor.lab.lit_line == i);
        if (ImGui::IsItemVisible()) {
            ImDrawList& list = *ImGui::GetWindowDrawList();
            const bool lit = editor.lab.lit_line == i;
            if (lit || ImGui::IsItemHovered())
                list.AddRectFilled(
                    at, {at.x + width, at.y + height},
                    ui::packed(lit ? ui::with_alpha(ui::palette().accent, 0.18f) : ui::palette().hovered),
                    4.0f);
            const ImVec4 color = tone_color(line.tone);
            list.AddRectFilled({at.x + indent - 0.5f * em, at.y + 0.2f * em},
                               {at.x + indent - 0.35f * em, at.y + height - 0.2f * em}, ui::packed(color));
            list.AddText(ui::fonts().semibold.face, em, {at.x + indent, at.y + 0.15f * em},
                         ui::packed(ui::palette().muted), line.title.c_str());
            list.AddText(
                {at.x + indent, at.y + 0.2f * em + title},
                ui::packed(line.tone == StoryTone::refused ? ui::palette().muted : ui::palette().text),
                words.c_str());
        }
        ImGui::PopID();
    }
    if (clicked) look_at_story_line(editor, *clicked);
}

}  // namespace

void why_panel(Editor& editor) {
    if (!editor.document) return;
    const ui::Scope scope("Why");
    Lab& lab = editor.lab;
    if (!lab.has_tape() || editor.playtest) {
        ui::muted_text(
            "Walk the level. This panel then shows what stopped you and what would have let you pass.");
        return;
    }
    const Document& document = *editor.document;
    const LabRun& run = lab.runs()[lab.explained()];
    std::string at = tick_text(lab, lab.cursor());
    at[0] = 'T';
    ImGui::TextColored(run_color(lab.explained()), "%s", run.name.c_str());
    ImGui::SameLine();
    ImGui::TextColored(ui::palette().muted, "%s", at.c_str());
    const TickTrace trace = lab.trace(document);
    const std::vector<StoryLine> story = lab.story(document);
    if (trace.records.empty() && story.size() < 2) {
        ui::muted_text("This tick is not computed yet");
        return;
    }
    imported_list(editor);
    if (const RunFindings* const found = findings(editor)) {
        headline(editor, stop_at_cursor(editor));
        stops_list(editor, found->stops);
    } else {
        wrapped(ui::palette().muted, "Looking for what stopped you\u2026");
    }
    const Stop* const stop = stop_at_cursor(editor);
    if (stop == nullptr) {
        switches(editor);
    } else if (const std::vector<Cure>* cures = cures_at_cursor(editor)) {
        cures_list(editor, std::vector<Cure>(*cures));
    }
    ui::heading("This tick");
    story_lines(editor, story);
    const auto folded =
        std::count_if(story.begin(), story.end(), [](const StoryLine& l) { return l.folded; });
    if (folded > 0) {
        ui::checkbox("Show what happens in every tick", &lab.show_folded,
                     "Also show resting on the ground and hacks that had nothing to do");
    }
    if (ui::button("Copy story", "Put these lines on the clipboard")) run_command(editor, "lab.copy_story");
    velocity_bars(trace, document.level());
    if (const RunFindings* const found = findings(editor)) events_list(editor, found->events);
}

}  // namespace slipface
