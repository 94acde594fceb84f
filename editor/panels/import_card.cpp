// The card beside the view about how the geometry's file was read: size, scale, axis, spawn, open edges.
#include <fmt/format.h>

#include <array>
#include <cmath>

#include "panels/panels.h"
#include "slipface/base/counted.h"
#include "slipface/level/find_start.h"
#include "tools/commands/icons.h"
#include "tools/playtest/spawns.h"
#include "widgets/imgui_compat.h"
#include "widgets/theme.h"
#include "widgets/ui.h"

namespace slipface {
namespace {

struct Unit {
    const char* name;
    double scale;
};
constexpr double smallest_shown_m = 1e-6;  // below it is rounding, as of a flat floor that was turned
constexpr std::array<Unit, 6> units{{{"Metres", 1.0},
                                     {"Centimetres", 0.01},
                                     {"Millimetres", 0.001},
                                     {"Inches", 0.0254},
                                     {"Feet", 0.3048},
                                     {"Quake units", 1.0 / 32.0}}};

// Label at the left, and the cursor where the value begins.
void row(const char* label, float value_at) {
    ImGui::AlignTextToFramePadding();
    ImGui::TextColored(ui::palette().muted, "%s", label);
    ImGui::SameLine(value_at);
}

// An explanation of the control above.
void note(const std::string& text, float value_at) {
    ImGui::SetCursorPosX(value_at);
    ui::push_font(ui::fonts().small);
    ui::muted_text(text.c_str());
    ImGui::PopFont();
}

void reason(ImportSource source, const std::string& text, float value_at) {
    if (source == ImportSource::given) return note("Set by you", value_at);
    note(fmt::format("{}: {}", source == ImportSource::declared ? "Declared" : "Guessed", text), value_at);
}

// Says what is doubtful of the control above, and puts the cursor where a button may cure it.
void doubted(const char* text, float value_at) {
    ImGui::SetCursorPosX(value_at);
    ImGui::TextColored(ui::palette().accent, "%s %s", icons::warning, text);
    ImGui::SetCursorPosX(value_at);
}

void scale_rows(Editor& editor, float value_at) {
    const ImportSummary& summary = editor.document->level().import_summary;
    ImportTransform transform = editor.document->level().import_transform;
    std::array<const char*, units.size() + 1> names{};
    int index = static_cast<int>(units.size());
    for (std::size_t i = 0; i < units.size(); ++i) {
        names[i] = units[i].name;
        if (std::abs(summary.scale - units[i].scale) < 1e-9 * units[i].scale) index = static_cast<int>(i);
    }
    names.back() = "Another";
    const int count = static_cast<int>(units.size()) + (index == static_cast<int>(units.size()) ? 1 : 0);
    row("Unit", value_at);
    const bool chosen = ui::combo("##Unit", &index, names.data(), count, "Length of one unit of the file");
    row("Scale", value_at);
    ui::input_text("##Scale", &editor.import_card.scale_text, "metres per unit");
    const bool typed = ImGui::IsItemDeactivatedAfterEdit();
    ui::tooltip("Metres per unit of the file");
    reason(summary.scale_from, summary.scale_reason, value_at);
    if (chosen && index < static_cast<int>(units.size())) {
        transform.scale = units[static_cast<std::size_t>(index)].scale;
        change_import(editor, transform);
    } else if (typed) {
        change_import_scale(editor, std::string(editor.import_card.scale_text));
    }
}

void axis_rows(Editor& editor, float value_at) {
    const ImportSummary& summary = editor.document->level().import_summary;
    row("Up axis", value_at);
    constexpr std::array<const char*, std::size(up_axis_names)> names{"+Y", "+Z", "+X", "-Y", "-Z", "-X"};
    int index = static_cast<int>(summary.up);
    const bool chosen = ui::combo("##Up axis", &index, names.data(), static_cast<int>(names.size()),
                                  "The upward axis of the file");
    reason(summary.up_from, summary.up_reason, value_at);
    std::optional<UpAxis> up;
    if (chosen) up = static_cast<UpAxis>(index);
    if (const std::optional<UpDoubt>& doubt = editor.import_card.up_doubt) {
        doubted("Seems to lie on its side", value_at);
        if (ui::button("Turn upright", doubt->text().c_str())) up = doubt->better_up;
    }
    if (!up) return;
    ImportTransform transform = editor.document->level().import_transform;
    transform.up = up;
    change_import(editor, transform);
}

// Only where the faces are doubted or flipped: to flip others has no use.
void facing_rows(Editor& editor, float value_at) {
    ImportTransform transform = editor.document->level().import_transform;
    const std::optional<FacingDoubt>& doubt = editor.import_card.facing_doubt;
    if (!doubt && !transform.flip) return;
    row("Faces", value_at);
    ImGui::TextUnformatted(transform.flip ? "Flipped" : "As in the file");
    if (doubt) doubted("Seem to look the wrong way", value_at);
    const std::string tip = doubt ? doubt->text() : "Let the faces look as they do in the file";
    if (!doubt) ImGui::SetCursorPosX(value_at);
    if (!ui::button(transform.flip ? "Flip back" : "Flip", tip.c_str())) return;
    transform.flip = !transform.flip;
    change_import(editor, transform);
}

void size_rows(Editor& editor, float value_at) {
    const ImportSummary& summary = editor.document->level().import_summary;
    row("Size", value_at);
    const Vec3 size = (summary.size.array() < smallest_shown_m).select(0.0, summary.size);
    ImGui::TextUnformatted(fmt::format("{:.5g} x {:.5g} x {:.5g} m", size.x(), size.y(), size.z()).c_str());
    ui::tooltip("Width (x), height (y) and depth (z)");
    const std::optional<SizeDoubt> doubt = editor.import_card.size_doubt;
    if (!doubt) return;
    doubted(doubt->too_large ? "Too large for a player" : "Too small for a player", value_at);
    if (!ui::button("Rescale", fmt::format("With a scale of {:.6g} the level is {:.3g} m large",
                                           doubt->better_scale, doubt->better_extent)
                                   .c_str()))
        return;
    ImportTransform transform = editor.document->level().import_transform;
    transform.scale = doubt->better_scale;
    change_import(editor, transform);
}

void spawn_rows(Editor& editor, float value_at) {
    const Level& level = editor.document->level();
    row("Spawn", value_at);
    if (has_spawn(level))
        ImGui::TextUnformatted(
            fmt::format("{:.2f}, {:.2f}, {:.2f}", level.spawn.x(), level.spawn.y(), level.spawn.z()).c_str());
    else
        ImGui::TextUnformatted("None in the file");
    ui::tooltip(
        "Where Play begins: without a spawn at the origin, or on open floor near the middle. P puts it on "
        "the face under the mouse");
    ImGui::SetCursorPosX(value_at);
    if (ui::button("Open floor", "Put it on the best open floor near the level's middle"))
        put_spawn_on_open_floor(editor);
    ImGui::SameLine();
    if (ui::button("In view", "Put it on a selected face, or on the one in the middle of the view"))
        put_spawn_in_view(editor);
}

}  // namespace

float import_card(Editor& editor, const ImVec2& min, const ImVec2& size) {
    if (!editor.import_card.shown || !editor.document || editor.playtest) return 0;
    refresh_import_card(editor);
    const float scale = ui::scale(), value_at = 112 * scale, width = 352 * scale, gap = 4 * scale;
    const bool beside = size.x - width >= 240 * scale;  // else it covers a part of the view
    const float margin = beside ? 0 : 14 * scale;
    ImGui::SetNextWindowPos({min.x + margin, min.y + margin});
    // A low view scrolls the card instead of letting it cover what lies below.
    const float highest = std::max(80 * scale, size.y - 2 * margin);
    ImGui::SetNextWindowSizeConstraints({width, beside ? highest : 0}, {width, highest});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {16 * scale, 12 * scale});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, beside ? 0 : 8 * scale);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, beside ? 0 : std::max(1.0f, scale));
    ImGui::PushStyleColor(ImGuiCol_WindowBg, beside ? ui::palette().panel : ui::palette().popup);
    ImGui::Begin("##import card", nullptr,
                 ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoCollapse |
                     ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
                     ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoFocusOnAppearing);
    ImGui::PopStyleColor();
    ImGui::PopStyleVar(3);
    const ui::Scope scope("Import");
    ui::push_font(ui::fonts().semibold);
    ImGui::TextUnformatted("How the file was read");
    ImGui::PopFont();
    size_rows(editor, value_at);
    scale_rows(editor, value_at);
    axis_rows(editor, value_at);
    facing_rows(editor, value_at);
    spawn_rows(editor, value_at);
    row("Open edges", value_at);
    ImGui::TextUnformatted(editor.import_card.open_edges == 0
                               ? "None: closed"
                               : fmt::format("{}", editor.import_card.open_edges).c_str());
    ui::tooltip("Edges of only one face: holes, and seams between overlapping parts");
    if (const std::size_t hidden = editor.document->hidden().size(); hidden > 0) {
        row("Hidden", value_at);
        ImGui::TextUnformatted(counted(hidden, "face that collides", "faces that collide").c_str());
        ui::tooltip("Faces that collide but are not drawn; Show all faces makes them visible");
    }
    if (!editor.import_card.problem.empty()) {
        ImGui::PushTextWrapPos(0.0f);
        ImGui::TextColored(ui::palette().bad, "%s", editor.import_card.problem.c_str());
        ImGui::PopTextWrapPos();
    }
    ImGui::Dummy({1, 2 * scale});
    const bool given = editor.document->level().import_transform != ImportTransform{};
    if (ui::button("Use the file's values", "Remove the scale, axis and facing set here", given))
        change_import(editor, {});
    ImGui::SameLine(ImGui::GetContentRegionMax().x - 100 * scale);  // left of the scroll bar, if there is one
    if (ui::primary_button("Done", true, {100 * scale, 0})) close_import_card(editor);
    ui::end(ImGui::End);
    return beside ? width + gap : 0;
}

}  // namespace slipface
