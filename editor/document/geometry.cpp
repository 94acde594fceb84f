// Reading the level's geometry again, and attaching orphans to faces.
#include <algorithm>
#include <optional>
#include <utility>

#include "document/document.h"
#include "document/faces.h"
#include "slipface/base/parallel.h"
#include "slipface/exchange/name_materials.h"

namespace slipface {

static FacePart part_of(const MeshPtr& mesh, FaceId first) {
    return {mesh, face_neighbours(*mesh), face_facts(*mesh), first, 0};
}

Status Document::rebuild_geometry() {
    std::optional<Result<CollisionWorld>> collision;
    FacePart part = own_part_.mesh == own_mesh(level_) ? std::move(own_part_) : FacePart();
    // Side by side, because much of either runs on one thread.
    parallel_for(2, 1, [&](std::size_t begin, std::size_t end) {
        if (begin == 0) collision.emplace(build_collision_world(level_));
        if (end == 2 && part.mesh == nullptr) part = part_of(own_mesh(level_), 0);
    });
    own_part_ = std::move(part);
    if (!*collision) return collision->error();
    collision_ = std::move(*collision).value();
    whole_part_.reset();
    mark_hidden();
    return {};
}

void Document::mark_hidden() {
    hidden_flags_.assign(level_.hidden.empty() ? 0 : level_.hidden.back() + 1, 0);
    for (const FaceId face : level_.hidden)
        hidden_flags_[face] = 1;
}

const FacePart& Document::whole_part() const {
    if (!has_instances(level_)) return own_part_;
    if (!whole_part_) whole_part_ = std::make_unique<FacePart>(part_of(level_.mesh, 0));
    return *whole_part_;
}

const FacePart& Document::part_with(FaceId face) const {
    const std::uint32_t prop = level_.placed.prop_of(face);
    if (prop == no_id) return own_part_;
    const FaceId first = level_.placed.first_face[prop];
    if (prop_part_of_ != level_.mesh.id() || prop_part_.first != first) {
        prop_part_ = part_of(prop_mesh(level_, prop), first);
        prop_part_.first_triangle = prop_first_triangle(level_, prop);
        prop_part_of_ = level_.mesh.id();
    }
    return prop_part_;
}

Status Document::reload(Progress* progress) {
    Result<LoadedLevel> loaded = read_again(progress);
    if (!loaded) return loaded.error();
    return take_geometry(std::move(loaded).value(), "Reload " + level_.mesh_path.filename().string());
}

Status Document::set_import_transform(const ImportTransform& transform, Progress* progress) {
    if (transform == level_.import_transform) return {};
    Result<LoadedLevel> loaded = reload_mesh(level_, transform, progress);
    if (!loaded) return loaded.error();
    std::vector<Spawn> moved = all_spawns(loaded->level);
    if (Status status = take_geometry(std::move(loaded).value(), "Change how the file is read"); !status)
        return status;
    if (moved == all_spawns(level_)) return {};
    // The spawns move in the same step.
    Edit edit = SpawnsEdit{all_spawns(level_), std::move(moved)};
    Touched touched;
    apply(edit, true, touched);
    refresh(touched);
    history_[cursor_ - 1].edits.push_back(std::move(edit));
    return {};
}

// Then reading the level file with the new geometry gives this state.
bool Document::annotations_stay(const LoadedLevel& after) const {
    const Level& before = level_;
    const auto painted = [](const Level& level) {
        return std::count_if(level.overrides.begin(), level.overrides.end(),
                             [](const auto& surface) { return surface.has_value(); });
    };
    const auto same_size = [](const SavedSelection& a, const SavedSelection& b) {
        return a.faces.size() == b.faces.size();
    };
    const MatchSummary& match = after.match;
    return match.by_plane + match.by_nearest == 0 && before.guessed.size() == after.level.guessed.size() &&
           before.import_transform == after.level.import_transform &&
           painted(before) == painted(after.level) && before.orphans.size() == after.level.orphans.size() &&
           before.hidden.size() == after.level.hidden.size() &&
           std::equal(before.selections.begin(), before.selections.end(), after.level.selections.begin(),
                      after.level.selections.end(), same_size);
}

Status Document::take_geometry(LoadedLevel loaded, std::string step_name) {
    if (in_transaction()) return Error{level_.mesh_path.string(), "cannot be read again during a change"};
    Geometry before{level_.mesh,
                    level_.import_transform,
                    level_.import_summary,
                    level_.mesh_stamp,
                    level_.overrides,
                    level_.orphans,
                    selection_,
                    level_.hidden,
                    level_.selections,
                    level_.guessed,
                    warnings_,
                    match_,
                    second_,
                    level_.placed};
    const bool stays = annotations_stay(loaded);
    // A selection is temporary: it stays only if the mesh is the same, and is never guessed.
    const bool same_faces =
        own_mesh(loaded.level)->face_first_corner == own_mesh(level_)->face_first_corner &&
        loaded.level.placed.first_face == level_.placed.first_face &&
        loaded.level.mesh_stamp == level_.mesh_stamp;
    Geometry after{std::move(loaded.level.mesh),
                   loaded.level.import_transform,
                   std::move(loaded.level.import_summary),
                   loaded.level.mesh_stamp,
                   std::move(loaded.level.overrides),
                   std::move(loaded.level.orphans),
                   same_faces ? selection_ : std::vector<FaceId>(),
                   std::move(loaded.level.hidden),
                   std::move(loaded.level.selections),
                   std::move(loaded.level.guessed),
                   std::move(loaded.warnings),
                   loaded.match,
                   std::move(loaded.second),
                   std::move(loaded.level.placed)};
    perform(std::move(step_name), GeometryEdit{std::move(before), std::move(after)});
    history_.back().keeps_file = stays;
    return {};
}

Result<std::string> Document::name_materials() {
    if (in_transaction())
        return Error{level_.mesh_path.string(), "cannot be written while a change is being made"};
    Result<NamedMaterials> named = slipface::name_materials(level_);
    if (!named) return named.error();
    std::string text = named->text();
    if (named->faces == 0) return text;
    if (Status status = take_geometry(std::move(named->after), "Write types into material names"); !status)
        return status.error();
    const Result<LevelBase> written = read_level_base(level_.file_path);
    mark_saved(written ? *written : LevelBase());
    return text;
}

Status Document::attach_orphan(std::size_t orphan, std::span<const FaceId> faces) {
    const std::string location = level_.file_path.string();
    if (orphan >= level_.orphans.size()) return Error{location, "there is no such orphan"};
    const std::string type = level_.orphans[orphan].type;
    const std::optional<SurfaceId> surface = find_surface(level_, type);
    if (!surface) return Error{location, "the orphan's type \"" + type + "\" does not exist: add it first"};
    if (faces.empty()) return Error{location, "no faces are selected to take the orphan's type"};
    Transaction transaction(*this, "Attach orphan");
    paint(faces, surface);
    drop_orphan(orphan);
    transaction.commit();
    return {};
}

void Document::drop_orphan(std::size_t orphan) {
    if (orphan >= level_.orphans.size()) return;
    std::vector<Orphan> orphans = level_.orphans;
    orphans.erase(orphans.begin() + static_cast<std::ptrdiff_t>(orphan));
    perform("Drop orphan", OrphansEdit{level_.orphans, std::move(orphans)});
}

}  // namespace slipface
