// An open level and its history. All changes go through this class, so that all can be undone.
#pragma once

#include <algorithm>
#include <array>
#include <exception>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "document/level_base.h"
#include "slipface/level/find_start.h"
#include "slipface/level/level_file.h"
#include "slipface/movement/step.h"

namespace slipface {

// One reversible change. It holds values, never pointers, so that undo never uses a stale object.
struct FaceEdit {
    struct Face {
        FaceId face;
        std::optional<SurfaceId> before, after;
    };
    std::vector<Face> faces;
};
struct SelectionEdit {
    std::vector<FaceId> before, after;  // ascending
};
struct HiddenEdit {
    std::vector<FaceId> before, after;  // ascending
};
template <class T>
struct ValueEdit {
    T before, after;
};
using MovementEdit = ValueEdit<MovementSettings>;
using SurfacesEdit = ValueEdit<std::vector<SurfaceType>>;
using RulesEdit = ValueEdit<std::vector<MaterialRule>>;
using SpawnsEdit = ValueEdit<std::vector<Spawn>>;
struct FallLimit {
    std::optional<double> height;
    friend bool operator==(const FallLimit&, const FallLimit&) = default;
};
using FallLimitEdit = ValueEdit<FallLimit>;
using CamerasEdit = ValueEdit<std::vector<CameraBookmark>>;
using GoalsEdit = ValueEdit<std::vector<Goal>>;
using OrphansEdit = ValueEdit<std::vector<Orphan>>;
// What reading the geometry file again replaces.
struct Geometry {
    LevelMesh mesh;
    ImportTransform import_transform;
    ImportSummary import_summary;
    FileStamp stamp;
    std::vector<std::optional<SurfaceId>> overrides;
    std::vector<Orphan> orphans;
    std::vector<FaceId> selection, hidden;
    std::vector<SavedSelection> saved_selections;
    std::vector<FaceId> guessed;
    Warnings warnings;
    MatchSummary match;
    SecondReading second;
    PlacedProps placed;
    friend bool operator==(const Geometry& a, const Geometry& b) { return a.mesh == b.mesh; }
};
using GeometryEdit = ValueEdit<Geometry>;
// Some props, and what refers to the faces of all, whose numbers change with the props.
struct PropsState {
    std::vector<Prop> props;
    std::vector<Platform> platforms;
    std::vector<std::optional<SurfaceId>> paint;  // Level::overrides beyond the level's own faces
    std::vector<FaceId> selection, hidden, guessed;
    std::vector<SavedSelection> saved_selections;
    friend bool operator==(const PropsState&, const PropsState&) = default;
};
// Only the props that differ, so that a step of a level of many props is small.
struct PropsEdit {
    std::size_t first = 0;  // in the list: of those before, and of those after
    PropsState before, after;
};
using GuessedEdit = ValueEdit<std::vector<FaceId>>;  // ascending
using SavedSelectionsEdit = ValueEdit<std::vector<SavedSelection>>;
using LevelEdit = ValueEdit<std::shared_ptr<const Level>>;  // everything except the mesh: a recovery
using Edit = std::variant<FaceEdit, SelectionEdit, HiddenEdit, GuessedEdit, SavedSelectionsEdit, MovementEdit,
                          SurfacesEdit, RulesEdit, SpawnsEdit, FallLimitEdit, CamerasEdit, GoalsEdit,
                          OrphansEdit, GeometryEdit, PropsEdit, LevelEdit>;

// Properties of faces that are used often, computed once per mesh.
struct FaceFacts {
    std::vector<Vec3f> normal;  // [face] unit, or zero without area
    std::vector<float> area;    // [face] square metres
    bool some_without_area = false;
};

// A part of the geometry in which tools look for connected faces: the level's own faces, or those of a prop.
struct FacePart {
    MeshPtr mesh;
    FaceNeighbours neighbours;
    FaceFacts facts;
    FaceId first = 0;  // the level's number of its face 0
    TriangleId first_triangle = 0;
};

// A ray for Document::pick_faces.
struct PickRay {
    Vec3 origin, direction;
};

// One unit of undo: a stroke, a slider drag, a command.
struct HistoryStep {
    std::string name;         // "Paint ice", as menus show it
    std::vector<Edit> edits;  // at most one of each kind, so their order does not matter
    bool keeps_file = false;  // the level file is the same with and without it

    bool changes_file() const;  // false: it changes only the selection
    std::size_t bytes() const;  // that it holds, about
};

class Document {
  public:
    // Opens an OBJ or a level file. `warnings()` describes what was repaired or dropped. May run in any
    // thread; another thread watches and cancels it through `progress`.
    static Result<std::unique_ptr<Document>> open(const std::filesystem::path& path,
                                                  Progress* progress = nullptr);

    const Level& level() const { return level_; }
    // All faces in one mesh, and what belongs to it. With many props this takes a second and much memory at
    // the first call after a change of them: what runs in every frame or stroke uses face_count(), bounds(),
    // surface_of() and part_with().
    const Mesh& mesh() const { return *level_.mesh; }
    const FaceNeighbours& neighbours() const { return whole_part().neighbours; }
    const FaceFacts& facts() const { return whole_part().facts; }
    std::size_t face_count() const { return level_.mesh.face_count(); }
    Aabb bounds() const { return level_.mesh.bounds(); }
    // The part that has `face`, which must be below face_count(). Valid until the next call.
    const FacePart& part_with(FaceId face) const;
    // Of a face below face_count().
    SurfaceId surface_of(FaceId face) const { return in(resolved_, face, &ResolvedSurfaces::surface); }
    SurfaceSource source_of(FaceId face) const { return in(resolved_, face, &ResolvedSurfaces::source); }
    std::optional<SurfaceId> paint_of(FaceId face) const {
        return face < level_.overrides.size() ? level_.overrides[face] : std::nullopt;
    }
    const SurfaceParts& resolved_parts() const { return resolved_; }
    ResolvedSurfaces resolved() const { return joined(resolved_); }  // of all faces
    const CollisionWorld& collision() const { return collision_; }
    const Warnings& warnings() const { return warnings_; }
    const MatchSummary& match() const { return match_; }
    std::span<const FaceId> guessed() const { return level_.guessed; }  // Level::guessed, ascending
    void accept_guessed(std::span<const FaceId> faces);                 // they leave guessed()
    // Another reading of the paint that fits as well; empty once all of its painted faces are accepted or
    // painted. take_second_reading() paints it, as one step that also accepts it.
    const SecondReading& second_reading() const;
    void take_second_reading();
    MovementScene scene() const { return {collision_, level_.surfaces}; }
    std::span<const FaceId> selection() const { return selection_; }  // ascending
    std::span<const FaceId> hidden() const { return level_.hidden; }  // ascending; neither drawn nor picked
    bool is_hidden(FaceId face) const { return face < hidden_flags_.size() && hidden_flags_[face] != 0; }
    std::span<const SavedSelection> saved_selections() const { return level_.selections; }
    // The type that the face would have without its override.
    SurfaceId unpainted(FaceId face) const { return in(unpainted_, face, &ResolvedSurfaces::surface); }
    SurfaceSource unpainted_source(FaceId face) const {
        return in(unpainted_, face, &ResolvedSurfaces::source);
    }

    std::size_t face_count_of(SurfaceId surface) const { return surface_counts_[surface]; }
    // Square metres.
    double area_of(SurfaceId surface) const { return std::max(0.0, surface_areas_[surface]); }

    // Ray queries. All find non-solid faces and never hidden ones; with `front_only` only faces seen from the
    // front. They leave the document unchanged, but only one query may run at a time. pick: the nearest face
    // that the ray hits. pick_through: all faces along the ray, each once, nearest first. pick_faces: the
    // first face that each ray hits, ascending, each once.
    std::optional<RayHit> pick(const Vec3& origin, const Vec3& direction, bool front_only);
    std::vector<FaceId> pick_through(const Vec3& origin, const Vec3& direction, bool front_only);
    std::vector<FaceId> pick_faces(std::span<const PickRay> rays, bool front_only);

    // Two documents never have the same revision. revision() grows at every change of what is shown;
    // face_revision() only when a face's type or a type changed.
    std::uint64_t revision() const { return revision_; }
    std::uint64_t face_revision() const { return face_revision_; }

    // True if it differs from the file on disk. The selection does not count.
    bool dirty() const;
    // The level file when it was read or written last: the unsaved changes add to it.
    const LevelBase& base() const { return base_; }
    Status save();
    // `level_file` is the level file's name; the OBJ file stays where it is.
    Status save_as(const std::filesystem::path& level_file);

    // True if the geometry file differs from what was read: another program has written it.
    bool changed_on_disk() const { return mesh_changed_on_disk(level_); }
    // Reads the geometry file again and finds the painted faces in it again, as one step of history.
    // Afterwards match() says how many were found and how; the paint of the others becomes orphans. On an
    // error nothing changes. Not allowed during a transaction. It has two halves, so that the slow one can
    // run in another thread while the document is shown: read_again() only reads the document.
    Status reload(Progress* progress = nullptr);
    Result<LoadedLevel> read_again(Progress* progress = nullptr) const {
        return reload_mesh(level_, progress);
    }
    Status take_geometry(LoadedLevel loaded, std::string step_name);
    // Whether all annotations are found exactly in the geometry that was read again.
    bool annotations_stay(const LoadedLevel& loaded) const;
    // Reads the geometry with another scale or up axis; painted faces keep their types.
    Status set_import_transform(const ImportTransform& transform, Progress* progress = nullptr);

    // Moves the painted types into the material names of the OBJ file (name_materials), saves the level file
    // and reads the geometry again, as one step. Undo restores the paint but not the OBJ file; a backup file
    // holds its old text. Returns a sentence about what was done.
    Result<std::string> name_materials();

    // Paints `faces` with the type of an orphan and removes the orphan, as one step. Fails if the orphan or
    // its type does not exist, or if `faces` is empty.
    Status attach_orphan(std::size_t orphan, std::span<const FaceId> faces);
    void drop_orphan(std::size_t orphan);  // deletes it: one step
    // Another program wrote the level file, whose text is `now`. saved: it holds this state. unsaved: it
    // holds another, to which this one adds. reworded: it says the same as before.
    void mark_saved(LevelBase now);
    void mark_unsaved(LevelBase now);
    void mark_reworded(LevelBase now) { base_ = std::move(now); }

    // Changes. Each is one step of history unless a transaction is open. A change without effect adds no
    // step.
    std::size_t paint(std::span<const FaceId> faces, std::optional<SurfaceId> surface);
    void select(std::vector<FaceId> faces, std::string step_name = {});  // hidden faces are left out
    void hide(std::vector<FaceId> faces, std::string step_name);         // replaces the hidden set
    // Ignored if there are more than max_saved_selections, because the file could not be read again.
    void set_saved_selections(std::vector<SavedSelection> selections, std::string step_name);
    void set_movement(const MovementSettings& movement, std::string step_name);
    // The types that stay must have the same ids. Ignored if the table is empty, too long, or too short for
    // the painted faces.
    void set_surfaces(std::vector<SurfaceType> surfaces, std::string step_name);
    // Rules and orphans that name the type are renamed with it. Ignored if rename_problem() gives a reason.
    void rename_surface(SurfaceId surface, const std::string& name);
    // Why the type cannot have that name; empty: it can.
    std::string rename_problem(SurfaceId surface, std::string_view name) const;
    // Later ids move down by one. Ignored if removal_problem() gives a reason.
    void remove_surface(SurfaceId surface);
    std::string removal_problem(SurfaceId surface) const;
    void set_rules(std::vector<MaterialRule> rules, std::string step_name = "Change material rules");
    // Changes position and yaw of the main spawn; its name stays.
    void set_spawn(const Spawn& spawn);
    // Replaces all spawns, the main one first. Ignored if spawns_problem() gives a reason.
    void set_spawns(std::vector<Spawn> spawns, std::string step_name);
    void set_fall_limit(std::optional<double> height);  // nothing: the default; ignored if not within 1e9 m
    void set_cameras(std::vector<CameraBookmark> cameras, std::string step_name = "Change cameras");
    void set_goals(std::vector<Goal> goals, std::string step_name);
    // Replaces all props. `from[i]`: the present prop that prop i is, or is a copy of, so that paint and
    // hidden faces follow it; no_id: it is new. Platforms follow a prop that has another name, and turn about
    // the same point of one that moved. Ignored if props_problem() gives a reason. prop_warnings() says which
    // meshes are missing.
    void set_props(std::vector<Prop> props, std::span<const std::uint32_t> from, std::string step_name);
    void set_platforms(std::vector<Platform> platforms, std::string step_name);
    const Warnings& prop_warnings() const { return prop_warnings_; }  // of the last change of the props
    // Replaces everything that the level adds to the OBJ's mesh with that of `level`, which must have this
    // document's. The file names stay, and terrain is read from its file if it is another. Selects `selected`
    // (ascending), if given. Ignored during a transaction.
    void restore(Level level, std::string step_name, std::optional<std::vector<FaceId>> selected = {});
    // A copy of the current state that shares the mesh, for a thread that saves or examines it.
    Level snapshot() const { return level_; }

    // Combines all changes until commit() into one step. A nested begin() joins the outer one, whose name is
    // used. cancel() reverts everything since the outermost begin() and, like commit(), ends one begin().
    // Both do nothing without a begin().
    void begin(std::string name);
    void commit();
    void cancel();
    bool in_transaction() const { return depth_ > 0; }

    // undo and redo do nothing during a transaction or at the end of the list. Beyond max_history_bytes the
    // oldest steps are forgotten; the last one never is.
    static constexpr std::size_t max_history_bytes = std::size_t{256} << 20;
    bool can_undo() const { return depth_ == 0 && cursor_ > 0; }
    bool can_redo() const { return depth_ == 0 && cursor_ < history_.size(); }
    void undo();
    void redo();
    std::span<const HistoryStep> history() const { return history_; }
    std::size_t history_cursor() const { return cursor_; }  // steps [0, cursor) are done
    // How many steps the file has; nothing: the saved state is no longer in the history.
    std::optional<std::size_t> saved_cursor() const { return saved_cursor_; }
    void go_to(std::size_t cursor);  // undoes or redoes up to that step
    // After an exception: cancels an open transaction and undoes the steps after `mark`, history_mark()
    // before the action. (A change that throws leaves the document as it was; but an action may consist of
    // several.)
    void roll_back(std::size_t mark);
    std::size_t history_mark() const { return forgotten_ + cursor_; }

  private:
    // What a set of edits changed, so that only that is computed again.
    struct Touched {
        std::vector<FaceId> faces;
        bool hidden = false;
        bool types = false;  // a name, the number of types, or a rule
        bool parameters = false;
        bool geometry = false;
        bool props = false;  // and the own faces are the same
    };
    // The faces of one prop by type.
    struct PropFaces {
        std::string mesh, type;  // of the prop
        Vec3 scale = Vec3::Zero();
        bool painted = false;
        struct Sum {
            std::size_t faces = 0;
            double area = 0.0;
        };
        std::vector<std::pair<SurfaceId, Sum>> sums;
    };

    Document();
    void apply(const Edit& edit, bool forward, Touched& touched);
    void apply(const HistoryStep& step, bool forward);
    void refresh(const Touched& touched);
    Status rebuild_geometry();  // the collision world and the neighbours
    void mark_hidden();
    void resolve_again();
    void resolve_props();  // the types of their faces, and the instances in the collision world
    void repaint(std::span<const FaceId> faces);
    PropFaces count_prop(std::size_t prop);
    void count(const PropFaces& prop, bool in);
    const FacePart& whole_part() const;
    template <class T>
    T in(const SurfaceParts& parts, FaceId face, std::vector<T> ResolvedSurfaces::*list) const {
        if (face < parts.own.surface.size()) return (parts.own.*list)[face];
        const std::uint32_t prop = level_.placed.prop_of(face);
        return ((*parts.props[prop]).*list)[face - level_.placed.first_face[prop]];
    }
    void apply_overrides();          // to the type of every face
    void resolve_face(FaceId face);  // one of the level's own, as in the next
    void count_face(FaceId face, bool in);
    template <class ValueOf>
    void change(ValueEdit<ValueOf> edit, std::string step_name);
    PropsState props_state() const;  // without the props
    void take(const PropsState& state);
    void perform(std::string step_name, Edit edit);
    void record(HistoryStep step);
    void push(HistoryStep step);
    void forget_oldest();

    Level level_;
    SurfaceParts unpainted_;  // as if there were no overrides
    SurfaceParts resolved_;
    std::vector<PropFaces> prop_faces_;  // [prop]
    std::map<MeshPtr, std::vector<Vec3>>
        prop_area_vectors_;  // [mesh of props][face] its normal times its area
    std::array<std::size_t, max_surface_types + 1> surface_counts_{};
    std::array<double, max_surface_types + 1> surface_areas_{};
    CollisionWorld collision_;
    FacePart own_part_;
    mutable std::unique_ptr<FacePart> whole_part_;  // null: not asked for since the last change
    mutable FacePart prop_part_;                    // the last that part_with() made
    mutable const void* prop_part_of_ = nullptr;    // LevelMesh::id()
    Warnings warnings_, prop_warnings_;
    MatchSummary match_;
    SecondReading second_;
    mutable bool second_is_open_ = false;  // in the revision `second_known_`
    mutable std::optional<std::uint64_t> second_known_;
    std::vector<FaceId> selection_;
    std::vector<std::uint8_t> hidden_flags_;  // [face]; of level_.hidden
    std::vector<HistoryStep> history_;
    std::size_t cursor_ = 0, forgotten_ = 0;       // steps
    std::optional<std::size_t> saved_cursor_ = 0;  // nothing: the saved state left the history
    HistoryStep open_step_;
    int depth_ = 0;
    std::uint64_t revision_, face_revision_;
    LevelBase base_;
};

// Reverts or repeats an edit in the list of props. Does nothing where that was not repeated or not reverted.
void put_props(const PropsEdit& edit, bool forward, std::vector<Prop>& props);
// The same edit as `earlier` and then `later`, after which the props are `now`.
void merge_into(PropsEdit& earlier, PropsEdit&& later, std::vector<Prop> now);

// For set_props(): each prop is still itself.
std::vector<std::uint32_t> every_prop(const Level& level);

// begin() on construction, cancel() on destruction unless committed. A cancel() that throws again leaves it
// to roll_back().
class Transaction {
  public:
    Transaction(Document& document, std::string name) : document_(&document) {
        document.begin(std::move(name));
    }
    ~Transaction() {
        try {
            if (document_) document_->cancel();
        } catch (const std::exception&) {
        }
    }
    Transaction(const Transaction&) = delete;
    Transaction& operator=(const Transaction&) = delete;
    void commit() { std::exchange(document_, nullptr)->commit(); }

  private:
    Document* document_;
};

}  // namespace slipface
