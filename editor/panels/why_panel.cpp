// Why the tick at the cursor went as it did: its story line by line, and what a switch would have changed.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "panels/lab_track.h"
#include "panels/property_rows.h"
#include "tools/icons.h"
#include "tools/lab_actions.h"
#include "widgets/theme.h"
#include "widgets/ui.h"

namespace slipface {
namespace {

ImVec4 tone_color(StoryTone tone) {
    const ui::Palette& p = ui::palette();
    switch (tone) {
        case StoryTone::acted:
            return p.accent;
        case StoryTone::refused:
            return p.muted;
        case StoryTone::trouble:
            return p.bad;
        case StoryTone::plain:
            break;
    }
    return p.text;
}

void wrapped(const ImVec4& color, const std::string& text) {
    ImGui::PushStyleColor(ImGuiCol_Text, color);
    ImGui::TextUnformatted(wrap_words(text, ImGui::GetContentRegionAvail().x).c_str());
    ImGui::PopStyleColor();
}

// The one thing to read first: what took the speed away, and where.
void headline(Editor& editor, const std::vector<StoryLine>& story, const TickTrace& trace) {
    const std::optional<std::size_t> told = telling_line(story, trace.records);
    if (!told) {
        wrapped(ui::palette().muted, "Nothing slowed the player down in this tick");
        return;
    }
    const StoryLine& line = story[*told];
    ImGui::PushFont(ui::fonts().semibold);
    wrapped(line.tone == StoryTone::trouble ? ui::palette().bad : ui::palette().text,
            line.title + ": " + line.text);
    ImGui::PopFont();
    // The sweep above it names triangle and feature.
    for (std::size_t i = *told; i-- > 0;) {
        if (story[i].triangle == no_id) continue;
        wrapped(ui::palette().text, story[i].title + " " + story[i].text);
        break;
    }
    if (ui::button("Look there", "Move the camera to the place and light up the record"))
        look_at_story_line(editor, *told);
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
    constexpr std::size_t most = 5;
    Lab& lab = editor.lab;
    ui::heading("What a switch would change");
    const std::vector<SwitchEffect>& effects = lab.switches(*editor.document);
    if (effects.empty()) {
        ui::muted_text(fmt::format("No switch changes the next {} ticks", Lab::switch_ticks).c_str());
        return;
    }
    const ui::Scope scope("Switch");
    std::optional<std::size_t> ghost, set;
    for (std::size_t i = 0; i < std::min(most, effects.size()); ++i) {
        const SwitchEffect& effect = effects[i];
        ImGui::PushID(static_cast<int>(i));
        const std::string name =
            std::string(effect.info->label) + " " + effect.setting.substr(effect.setting.find('=') + 1);
        const bool better = effect.further_m > 0.005 || effect.grounded_gained > 0;
        const ui::Scope row(effect.setting);
        ImGui::AlignTextToFramePadding();
        ImGui::TextColored(better ? ui::palette().good : ui::palette().text, "%s", name.c_str());
        ui::tooltip(effect.info->meaning);
        const float buttons = ImGui::CalcTextSize("GhostSet").x + 4.0f * ImGui::GetStyle().FramePadding.x +
                              ImGui::GetStyle().ItemSpacing.x;
        ImGui::SameLine();
        ImGui::SetCursorPosX(ImGui::GetCursorPosX() +
                             std::max(0.0f, ImGui::GetContentRegionAvail().x - buttons));
        if (ui::button("Ghost", "Run the whole tape with this switch as one more ghost")) ghost = i;
        ImGui::SameLine();
        if (ui::button("Set", "Throw the switch in this level")) set = i;
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
        ImGui::PushID(static_cast<int>(i));
        const float indent = static_cast<float>(line.depth) * em + 0.6f * em;
        const ImVec2 at = ImGui::GetCursorScreenPos();
        const float width = ImGui::GetContentRegionAvail().x;
        const float wrap = std::max(4.0f * em, width - indent);
        const ImVec2 title = ImGui::CalcTextSize(line.title.c_str());
        const std::string words = wrap_words(line.text, wrap);
        const ImVec2 text = ImGui::CalcTextSize(words.c_str());
        const float height = title.y + text.y + 0.5f * em;
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
            list.AddText(ui::fonts().semibold, em, {at.x + indent, at.y + 0.15f * em}, ui::packed(color),
                         line.title.c_str());
            list.AddText(
                {at.x + indent, at.y + 0.2f * em + title.y},
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
            "Walk the level, then pick a tick on the timeline: here stands what each sweep met, which rule "
            "turned "
            "the move, and what would have changed it.");
        return;
    }
    const Document& document = *editor.document;
    const LabRun& run = lab.runs()[lab.told()];
    std::string at = tick_text(lab, lab.cursor());
    at[0] = 'T';
    ImGui::TextColored(run_color(lab.told()), "%s", run.name.c_str());
    ImGui::SameLine();
    ImGui::TextColored(ui::palette().muted, "%s", at.c_str());
    const TickTrace trace = lab.trace(document);
    const std::vector<StoryLine> story = lab.story(document);
    if (trace.records.empty() && story.size() < 2) {
        ui::muted_text("This tick is not worked out yet");
        return;
    }
    headline(editor, story, trace);
    switches(editor);
    ui::heading("Story");
    story_lines(editor, story);
    if (ui::button("Copy story", "Put these lines on the clipboard")) run_command(editor, "lab.copy_story");
}

}  // namespace slipface
