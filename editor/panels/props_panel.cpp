// The level's props.
#include <fmt/format.h>

#include "panels/named_rows.h"
#include "panels/panels.h"
#include "panels/property_rows.h"
#include "tools/commands/icons.h"
#include "tools/props/props.h"
#include "widgets/imgui_compat.h"
#include "widgets/ui.h"

namespace slipface {
namespace {

constexpr double prop_degrees = 57.29577951308232;

// A combo box of names; `none` stands for the empty one.
bool name_combo(const char* label, std::string& name, const std::vector<std::string>& names, const char* none,
                const char* tooltip) {
    std::vector<std::string> all;
    if (none != nullptr) all.emplace_back();
    all.insert(all.end(), names.begin(), names.end());
    if (std::ranges::find(all, name) == all.end()) all.push_back(name);
    std::vector<const char*> labels;
    for (const std::string& one : all)
        labels.push_back(one.empty() ? none : one.c_str());
    int index = static_cast<int>(std::ranges::find(all, name) - all.begin());
    ImGui::SetNextItemWidth(-1.0f);
    if (!ui::combo((std::string("##") + label).c_str(), &index, labels.data(),
                   static_cast<int>(labels.size()), tooltip))
        return false;
    name = all[static_cast<std::size_t>(index)];
    return true;
}

void prop_file_row(Editor& editor) {
    PropTool& tool = editor.props;
    if (tool.files_of != editor.document.get()) {
        tool.files = find_prop_files(editor.document->level());
        tool.files_of = editor.document.get();
    }
    if (!begin_property_rows("place", label_width_of("Place"))) return;
    property_row("Place", "The mesh that a click in the view places; with nothing, a click chooses a prop");
    if (name_combo("Place", tool.file, tool.files, "nothing", nullptr)) editor.tool = Tool::props;
    end_property_rows();
    if (tool.files.empty()) ui::muted_text("No geometry files in the folder of the level");
}

void prop_handle_row(Editor& editor) {
    PropTool& tool = editor.props;
    static constexpr std::pair<const char*, PropHandles> all[] = {
        {"Move", PropHandles::move}, {"Rotate", PropHandles::rotate}, {"Scale", PropHandles::scale}};
    for (const auto& [label, handles] : all) {
        const bool on = editor.tool == Tool::props && tool.handles == handles;
        if (handles != PropHandles::move) ui::flow(ui::button_width(label));
        ImGui::PushStyleColor(ImGuiCol_Button,
                              ImGui::GetStyleColorVec4(on ? ImGuiCol_ButtonActive : ImGuiCol_Button));
        if (ui::button(label, "Handles at the chosen prop, in the view")) {
            tool.handles = handles;
            editor.tool = Tool::props;
        }
        ImGui::PopStyleColor();
    }
    ui::flow(ui::button_width("Snap") + ImGui::GetFrameHeight());
    ui::checkbox("Snap", &tool.snap, "Snap to 0.25 m, 15\u00b0, 0.1\u00d7. Hold Shift for free");
}

struct PropTarget {
    Editor& editor;
    std::size_t prop;
    const Prop& now() const { return editor.document->level().props[prop]; }
    void put(const Prop& to, const char* what) const {
        const std::string step = std::string("Change ") + what + " of " + now().name;
        live_edit(editor, step);
        change_prop(editor, prop, to, step);
    }
};

void prop_vector_row(const PropTarget& target, const char* label, Vec3 Prop::*member, double shown,
                     const char* format, float speed, const char* tooltip) {
    property_row(label, tooltip);
    Vec3 value = target.now().*member * shown;
    ImGui::SetNextItemWidth(-1.0f);
    if (!ui::drag_vec3((std::string("##") + label).c_str(), value.data(), speed, format, nullptr)) return;
    Prop to = target.now();
    to.*member = value / shown;
    target.put(to, label);
}

void prop_look_rows(const PropTarget& target) {
    const Level& level = target.editor.document->level();
    Prop to = target.now();
    property_row("Mesh", "The file whose geometry it has");
    if (name_combo("Mesh", to.mesh, target.editor.props.files, nullptr, nullptr)) target.put(to, "mesh");
    to = target.now();
    property_row("Texture", "An image for all its faces, relative to the level's folder; empty: its own");
    ImGui::SetNextItemWidth(-1.0f);
    if (ui::input_text("##Texture", &to.texture, "its own")) target.put(to, "texture");
    to = target.now();
    std::vector<std::string> types;
    for (const SurfaceType& type : level.surfaces)
        types.push_back(type.name);
    property_row("Type", "The surface type of all its faces; painted faces keep theirs");
    if (name_combo("Type", to.type, types, "by material", nullptr)) target.put(to, "type");
}

// The clips of its mesh, and the motion of its texture. Shown in Play; collision sees the mesh at rest.
void prop_animation_rows(const PropTarget& target) {
    Prop to = target.now();
    Animation& animation = to.animation;
    const PropMesh* const file = find_prop_mesh(target.editor.document->level(), to.mesh);
    if (file != nullptr && file->mesh && file->mesh->rig) {
        std::vector<std::string> clips;
        for (const Clip& clip : file->mesh->rig->clips)
            clips.push_back(clip.name);
        property_row("Clip", "What its mesh plays; the player meets it at rest");
        if (name_combo("Clip", animation.clip, clips, "at rest", nullptr)) target.put(to, "clip");
        if (!animation.clip.empty()) {
            property_row("Clip speed", "Times the clip's own; below 0 it plays backwards");
            if (number_slider("Clip speed", &animation.speed, -4.0, 4.0, "", nullptr))
                target.put(to, "clip speed");
            property_row("Phase", "How far it is ahead of others with this clip");
            if (number_slider("Phase", &animation.phase_s, 0.0, 10.0, "s", nullptr)) target.put(to, "phase");
        }
    }
    property_row("Scroll across", "Its texture moves over the faces: widths per second");
    if (number_slider("Scroll across", &animation.scroll.x(), -4.0, 4.0, "/s", nullptr))
        target.put(to, "scroll");
    property_row("Scroll up", "Its texture moves over the faces: heights per second");
    if (number_slider("Scroll up", &animation.scroll.y(), -4.0, 4.0, "/s", nullptr)) target.put(to, "scroll");
    property_row("Pictures", "Side by side in its texture, shown one after the other");
    double columns = animation.columns, rows = animation.rows;
    if (number_slider("Pictures", &columns, 1.0, 16.0, "", nullptr, true)) {
        animation.columns = static_cast<int>(columns);
        target.put(to, "pictures");
    }
    property_row("Rows of pictures", "Below each other, the upper ones first");
    if (number_slider("Rows of pictures", &rows, 1.0, 16.0, "", nullptr, true)) {
        animation.rows = static_cast<int>(rows);
        target.put(to, "rows of pictures");
    }
    if (animation.columns * animation.rows == 1) return;
    property_row("Picture rate", "Pictures per second");
    if (number_slider("Picture rate", &animation.pictures_per_s, -60.0, 60.0, "/s", nullptr))
        target.put(to, "picture rate");
}

void prop_motion_rows(const PropTarget& target) {
    Editor& editor = target.editor;
    PropMotion motion = prop_motion(editor.document->level(), target.now());
    const PropMotion before = motion;
    property_row("Path", "Far end of its path, from here, in metres. 0 0 0: stands still");
    ImGui::SetNextItemWidth(-1.0f);
    bool changed = ui::drag_vec3("##Path", motion.way.data(), 0.05f, "%.2f", nullptr);
    if (!motion.way.isZero(0.0)) {
        property_row("Speed", "Along the way");
        changed = number_slider("Speed", &motion.speed, 0.1, 20.0, "m/s", nullptr) || changed;
    }
    double turn = motion.turn * prop_degrees;
    property_row("Spin", "It turns about its own vertical axis");
    if (number_slider("Spin", &turn, -360.0, 360.0, "\u00b0/s", nullptr)) {
        motion.turn = turn / prop_degrees;
        changed = true;
    }
    if (!changed || (motion.way == before.way && motion.speed == before.speed && motion.turn == before.turn))
        return;
    live_edit(editor, "Move " + target.now().name + " by itself");
    set_prop_motion(editor, target.prop, motion);
}

void chosen_prop_rows(Editor& editor, std::size_t prop) {
    const PropTarget target{editor, prop};
    ImGui::Spacing();
    const ui::Scope scope("Chosen");
    ui::heading(target.now().name.c_str());
    if (begin_property_rows("chosen", label_width_of("Position"))) {
        prop_vector_row(target, "Position", &Prop::position, 1.0, "%.2f", 0.05f, "Metres");
        prop_vector_row(target, "Rotation", &Prop::rotation, prop_degrees, "%.1f", 1.0f,
                        "Degrees, about z, then x, then y");
        prop_vector_row(target, "Scale", &Prop::scale, 1.0, "%.3f", 0.01f,
                        "Along its own axes; a negative one mirrors it");
        prop_look_rows(target);
        prop_motion_rows(target);
        end_property_rows();
    }
    const PropMesh* const mesh = find_prop_mesh(editor.document->level(), target.now().mesh);
    if (mesh != nullptr && !mesh->mesh) ui::muted_text(("Missing: " + mesh->problem).c_str());
    if (ui::button("Duplicate", "Place another one beside it (Ctrl+D)")) return duplicate_prop(editor, prop);
    ui::flow(ui::button_width("Paint"));
    if (ui::button("Paint", "Give all its faces the brush's type"))
        return paint_prop(editor, prop, editor.brush);
    ui::flow(ui::button_width("Delete"));
    if (ui::button("Delete", "Remove it (Shift+Delete)")) return remove_prop(editor, prop);
    ui::heading("Animation");
    if (!begin_property_rows("animation", label_width_of("Rows of pictures"))) return;
    prop_animation_rows(target);
    end_property_rows();
}

// A list that scrolls by itself, so that the fields below stay where they are.
void prop_list(Editor& editor, const std::vector<Prop>& props, std::optional<std::size_t> chosen) {
    constexpr std::size_t max_rows = 200, shown_rows = 8;
    const float row_height = ImGui::GetFrameHeightWithSpacing();
    const auto rows = static_cast<float>(std::min(props.size(), shown_rows));
    ImGui::BeginChild("list", {0.0f, rows * row_height});
    for (std::size_t i = 0; i < std::min(props.size(), max_rows); ++i) {
        NamedRow row;
        row.name = props[i].name;
        row.detail = props[i].type.empty() ? props[i].mesh : props[i].type;
        row.tooltip = "Choose it and select its faces; a double click renames it";
        row.replace_tooltip = "Move it to the face in the middle of the view";
        row.chosen = chosen == i;
        const NamedRowResult did = named_row(
            i, row, [&](const std::string& name) { return prop_name_problem(*editor.document, i, name); });
        if (!did.renamed.empty()) {
            Prop to = props[i];
            to.name = did.renamed;
            change_prop(editor, i, to, "Rename " + props[i].name);
        }
        if (did.replace) move_prop_in_view(editor, i);
        if (did.remove) remove_prop(editor, i);
        if (did.replace || did.remove || !did.renamed.empty()) break;
        if (did.chosen) choose_prop(editor, i);
    }
    ui::end(ImGui::EndChild);
    if (props.size() > max_rows)
        ui::muted_text(fmt::format("and {} more: click them in the view", props.size() - max_rows).c_str());
}

}  // namespace

void props_panel(Editor& editor) {
    settle_live_edit(editor);
    if (!editor.document) return;
    const ui::Scope scope("Props");
    prop_file_row(editor);
    prop_handle_row(editor);
    ImGui::Spacing();
    const std::vector<Prop> props = editor.document->level().props;
    if (props.empty()) ui::muted_text("None: choose a mesh above and click in the view");
    const std::optional<std::size_t> chosen = chosen_prop(editor);
    if (!props.empty()) prop_list(editor, props, chosen);
    if (const auto now = chosen_prop(editor)) chosen_prop_rows(editor, *now);
}

}  // namespace slipface
