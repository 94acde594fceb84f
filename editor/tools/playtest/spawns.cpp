#include "tools/playtest/spawns.h"

#include <algorithm>
#include <optional>

#include "slipface/level/find_start.h"
#include "tools/target.h"

namespace slipface {
namespace {

std::string free_spawn_name(const std::vector<Spawn>& spawns) {
    if (spawns.empty()) return Spawn{}.name;
    for (std::size_t number = spawns.size() + 1;; ++number) {
        std::string name = "Spawn " + std::to_string(number);
        const auto found =
            std::find_if(spawns.begin(), spawns.end(), [&](const Spawn& one) { return one.name == name; });
        if (found == spawns.end()) return name;
    }
}

}  // namespace

void add_spawn(Editor& editor) {
    const std::optional<FacePoint> target = target_or_say(editor);
    if (!target) return;
    std::vector<Spawn> spawns = all_spawns(editor.document->level());
    Spawn spawn = spawn_on(editor, *target);
    spawn.name = free_spawn_name(spawns);
    spawns.push_back(spawn);
    if (const std::string problem = spawns_problem(spawns); !problem.empty()) {
        editor.status = problem;
        return;
    }
    editor.document->set_spawns(std::move(spawns), "Add spawn " + spawn.name);
    editor.status = "Added " + spawn.name + " " + target->where;
}

void move_spawn(Editor& editor, std::size_t index) {
    std::vector<Spawn> spawns = all_spawns(editor.document->level());
    const std::optional<FacePoint> target = target_or_say(editor);
    if (index >= spawns.size() || !target) return;
    const Spawn to = spawn_on(editor, *target);
    spawns[index].position = to.position;
    spawns[index].yaw = to.yaw;
    const std::string name = spawns[index].name;
    editor.document->set_spawns(std::move(spawns), "Move spawn " + name);
    editor.status = "Moved " + name + " here";
}

void put_spawn_in_view(Editor& editor) {
    if (has_spawn(editor.document->level()))
        move_spawn(editor, 0);
    else
        add_spawn(editor);
}

void put_spawn_on_open_floor(Editor& editor) {
    const Level& level = editor.document->level();
    const TickScene scene = editor.lab.scene(*editor.document);
    const std::optional<Vec3> floor = find_open_floor(scene.at(0, 0.0), level.movement);
    if (!floor) {
        editor.status = "No floor of the level has room for the player";
        return;
    }
    editor.document->set_spawn({*floor - scene.offset(), level.spawn_yaw, level.spawn_name});
    editor.status = "The player begins on open floor";
}

void remove_spawn(Editor& editor, std::size_t index) {
    std::vector<Spawn> spawns = all_spawns(editor.document->level());
    if (index >= spawns.size()) return;
    const std::string name = spawns[index].name;
    spawns.erase(spawns.begin() + static_cast<std::ptrdiff_t>(index));
    editor.document->set_spawns(std::move(spawns), "Delete spawn " + name);
    editor.status = "Deleted " + name;
}

std::string spawn_name_problem(const Document& document, std::size_t index, const std::string& name) {
    std::vector<Spawn> spawns = all_spawns(document.level());
    if (index >= spawns.size()) return "There is no such spawn";
    spawns[index].name = name;
    return spawns_problem(spawns);
}

void rename_spawn(Editor& editor, std::size_t index, const std::string& name) {
    if (!spawn_name_problem(*editor.document, index, name).empty()) return;
    std::vector<Spawn> spawns = all_spawns(editor.document->level());
    const std::string old = std::exchange(spawns[index].name, name);
    editor.document->set_spawns(std::move(spawns), "Rename spawn " + old);
}

void make_main_spawn(Editor& editor, std::size_t index) {
    std::vector<Spawn> spawns = all_spawns(editor.document->level());
    if (index == 0 || index >= spawns.size()) return;
    const std::string name = spawns[index].name;
    std::rotate(spawns.begin(), spawns.begin() + static_cast<std::ptrdiff_t>(index),
                spawns.begin() + static_cast<std::ptrdiff_t>(index) + 1);
    editor.document->set_spawns(std::move(spawns), "Begin at spawn " + name);
    editor.status = "Play begins at " + name;
}

}  // namespace slipface
