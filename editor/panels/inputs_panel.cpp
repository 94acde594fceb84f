// The lab's tape as text. What is typed is the tape as soon as it can be read.
#include <imgui.h>

#include "panels/panel_memory.h"
#include "panels/panels.h"
#include "widgets/theme.h"
#include "widgets/ui.h"

namespace slipface {
namespace {

constexpr std::size_t longest_text = 200'000;

struct Typed {
    std::shared_ptr<const Tape> tape;  // that the text was made from, or that was made from the text
    std::string text, problem;
    bool joins = false;  // what is typed next belongs to the same step of undo
};

Typed& typed() {
    static Typed state;
    return state;
}

}  // namespace

void forget_input_text() {
    typed() = {};
}

void inputs_panel(Editor& editor) {
    if (!editor.document) return;
    const ui::Scope scope("Inputs");
    Lab& lab = editor.lab;
    if (!lab.has_tape() || editor.playtest) {
        ui::muted_text("Walk the level or open a tape to read and change its inputs here.");
        return;
    }
    Typed& now = typed();
    if (now.tape != lab.shared_tape()) {
        now = {.tape = lab.shared_tape(), .text = tape_to_text(lab.tape()), .problem = {}};
    }
    if (now.text.size() > longest_text) {
        ui::muted_text(
            "This tape is too long to be typed in here. Save it and change the file: it is read again when "
            "it "
            "changes.");
        return;
    }
    ui::muted_text("Each line holds for so many ticks: 60 wish 0,-1 jump. Lines of # are ignored.");
    const float below = now.problem.empty() ? 0.0f : 3.2f * ImGui::GetTextLineHeightWithSpacing();
    const ImVec2 size{-1.0f, std::max(80.0f * ui::scale(), ImGui::GetContentRegionAvail().y - below)};
    const bool changed = ui::input_lines("##Text", &now.text, size);
    if (ImGui::IsItemActivated()) now.joins = false;
    if (changed) {
        Result<Tape> tape = parse_tape(now.text, "line");
        const Status status = tape ? lab.edit(*editor.document, std::move(*tape), now.joins) : tape.error();
        now.problem = status ? std::string() : status.error().text();
        now.joins = now.joins || status.ok();
        now.tape = lab.shared_tape();
    }
    if (now.problem.empty()) return;
    ImGui::PushStyleColor(ImGuiCol_Text, ui::palette().bad);
    ImGui::TextWrapped("%s", ("Not yet a tape: " + now.problem).c_str());
    ImGui::PopStyleColor();
}

}  // namespace slipface
