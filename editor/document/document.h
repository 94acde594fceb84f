// An open level and its history. Every change goes through here, so that every change can be undone.
#pragma once

#include <algorithm>
#include <array>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "slipface/level/find_start.h"
#include "slipface/level/level_file.h"
#include "slipface/movement/step.h"

namespace slipface {

// One reversible change. Values, never pointers: undoing cannot meet a stale object.
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
using OrphansEdit = ValueEdit<std::vector<Orphan>>;
// What a new look at the geometry's file replaces at once.
struct Geometry {
    MeshPtr mesh;
    ImportTransform import_transform;
    ImportSummary import_summary;
    FileStamp stamp;
    std::vector<std::optional<SurfaceId>> overrides;
    std::vector<Orphan> orphans;
    std::vector<FaceId> selection, hidden;
    std::vector<SavedSelection> saved_selections;
    Warnings warnings;
    MatchSummary match;
    std::vector<FaceId> guessed;
    friend bool operator==(const Geometry& a, const Geometry& b) { return a.mesh == b.mesh; }
};
using GeometryEdit = ValueEdit<Geometry>;
using SavedSelectionsEdit = ValueEdit<std::vector<SavedSelection>>;
using LevelEdit = ValueEdit<std::shared_ptr<const Level>>;  // everything on the same mesh: a recovery
using Edit =
    std::variant<FaceEdit, SelectionEdit, HiddenEdit, SavedSelectionsEdit, MovementEdit, SurfacesEdit,
                 RulesEdit, SpawnsEdit, FallLimitEdit, CamerasEdit, OrphansEdit, GeometryEdit, LevelEdit>;

// What is asked of faces again and again, worked out once.
struct FaceFacts {
    std::vector<Vec3f> normal;  // [face] unit, or zero without area
    std::vector<float> area;    // [face] square metres
};

// A ray for Document::pick_faces.
struct PickRay {
    Vec3 origin, direction;
};

// What undo takes back at once: a stroke, a slider drag, a command.
struct HistoryStep {
    std::string name;         // "Paint ice", as menus show it
    std::vector<Edit> edits;  // at most one of each kind, so their order does not matter
    bool keeps_file = false;  // the level file says the same with and without it

    bool changes_file() const;  // false: it only selects
};

class Document {
  public:
    // Opens an OBJ or a level file. `warnings()` tells what was repaired or dropped.
    // May run on a thread of its own; another watches and cancels through `progress`.
    static Result<std::unique_ptr<Document>> open(const std::filesystem::path& path,
                                                  Progress* progress = nullptr);

    const Level& level() const { return level_; }
    const Mesh& mesh() const { return *level_.mesh; }
    const ResolvedSurfaces& resolved() const { return resolved_; }
    const CollisionWorld& collision() const { return collision_; }
    const FaceNeighbours& neighbours() const { return neighbours_; }
    const Warnings& warnings() const { return warnings_; }
    const MatchSummary& match() const { return match_; }
    // Faces that got their paint by plane or by nearest when the level was read, and were not accepted since.
    std::span<const FaceId> guessed() const { return guessed_; }  // ascending
    void accept_guessed();                                        // they are right: no step of history
    MovementScene scene() const { return {collision_, level_.surfaces}; }
    const FaceFacts& facts() const { return facts_; }
    std::span<const FaceId> selection() const { return selection_; }  // ascending
    std::span<const FaceId> hidden() const { return level_.hidden; }  // ascending; neither drawn nor picked
    bool is_hidden(FaceId face) const { return !level_.hidden.empty() && hidden_flags_[face] != 0; }
    std::span<const SavedSelection> saved_selections() const { return level_.selections; }
    SurfaceId unpainted(FaceId face) const {
        return unpainted_.surface[face];
    }  // what unsetting it would give
    SurfaceSource unpainted_source(FaceId face) const { return unpainted_.source[face]; }

    std::size_t face_count_of(SurfaceId surface) const { return surface_counts_[surface]; }
    double area_of(SurfaceId surface) const {
        return std::max(0.0, surface_areas_[surface]);
    }  // square metres

    // The nearest face that the ray meets, non-solid ones too, hidden ones never; with `front_only`, seen
    // from the front. Nothing changes for an observer, but no other query may run meanwhile. The same holds
    // for the others: every face along the ray, nearest first, each once; and the faces that any of the rays
    // meets first, ascending.
    std::optional<RayHit> pick(const Vec3& origin, const Vec3& direction, bool front_only);
    std::vector<FaceId> pick_through(const Vec3& origin, const Vec3& direction, bool front_only);
    std::vector<FaceId> pick_faces(std::span<const PickRay> rays, bool front_only);

    // Never the same for two documents. Counts up at every change of what is shown; face_revision only when a
    // face's type or a type changed.
    std::uint64_t revision() const { return revision_; }
    std::uint64_t face_revision() const { return face_revision_; }

    // Differs from the file on disk. Selecting does not count.
    bool dirty() const;
    Status save();
    Status save_as(
        const std::filesystem::path& level_file);  // the level file's name; the OBJ stays where it is

    // The geometry's file is not what was read: another program has written it.
    bool changed_on_disk() const { return mesh_changed_on_disk(level_); }
    // Reads the geometry again and finds the painted faces again, as one step of history; match() then says
    // how many were found and how, and what found no face is an orphan. Nothing changes on an error. Not
    // during a transaction. In two halves, so that the slow one can run on a thread of its own while the
    // document stays on the screen: read_again() only reads the document.
    Status reload(Progress* progress = nullptr);
    Result<LoadedLevel> read_again(Progress* progress = nullptr) const {
        return reload_mesh(level_, progress);
    }
    Status take_geometry(LoadedLevel loaded, std::string step_name);
    // Takes the file's coordinates otherwise; painted faces keep their types.
    Status set_import_transform(const ImportTransform& transform, Progress* progress = nullptr);

    // Moves the painted types into the material names of the OBJ file (bake_level), saves the level file and
    // takes the geometry anew, as one step. Undo brings the paint back, not the file: the backup does. Says
    // what was done.
    Result<std::string> bake();

    // Paints `faces` with the type of an orphan, which is one no more: one step. Refuses an orphan that is
    // not there, one whose type is not there, and no faces.
    Status attach_orphan(std::size_t orphan, std::span<const FaceId> faces);
    void drop_orphan(std::size_t orphan);  // gives it up: one step
    void mark_saved();  // the file is known to hold this state, because it was read from there

    // Changes. Each is one step of history, unless a transaction is open; one that changes nothing leaves no
    // step.
    // Nothing: unset. Returns how many faces changed.
    std::size_t paint(std::span<const FaceId> faces, std::optional<SurfaceId> surface);
    void select(std::vector<FaceId> faces, std::string step_name = {});  // the hidden ones are left out
    void hide(std::vector<FaceId> faces, std::string step_name);         // exactly these are hidden then
    // More than max_saved_selections are ignored: the file could not be read again.
    void set_saved_selections(std::vector<SavedSelection> selections, std::string step_name);
    void set_movement(const MovementSettings& movement, std::string step_name);
    // Ids of kept types must not move. A table that is empty, too long, or too short for the painted faces is
    // ignored.
    void set_surfaces(std::vector<SurfaceType> surfaces, std::string step_name);
    // Rules and orphans that name the type follow. Ignored when rename_problem() says why not.
    void rename_surface(SurfaceId surface, const std::string& name);
    std::string rename_problem(SurfaceId surface,
                               std::string_view name) const;  // empty: it may have that name
    void remove_surface(
        SurfaceId surface);  // later types move down by one; ignored while removal_problem() has a reason
    std::string removal_problem(SurfaceId surface) const;
    void set_rules(std::vector<MaterialRule> rules);
    // The main spawn's place; it keeps its name.
    void set_spawn(const Spawn& spawn);
    // All of them, the main one first. Ignored while spawns_problem() has a reason.
    void set_spawns(std::vector<Spawn> spawns, std::string step_name);
    void set_fall_limit(std::optional<double> height);  // nothing: the usual one
    void set_cameras(std::vector<CameraBookmark> cameras, std::string step_name = "Change cameras");
    // Takes over all that `level` adds to the mesh, which must be this document's. The files' names stay.
    // Ignored during a transaction.
    // `guessed`: of its painted faces, those whose paint was guessed.
    void restore(Level level, std::string step_name, std::vector<FaceId> guessed = {});
    // As it is now, for a thread that saves or examines it; it shares the mesh.
    Level snapshot() const { return level_; }

    // Gathers what follows into one step until commit(). Nested begins join the outer one, whose name counts.
    // cancel() takes back everything since the outermost begin; like commit() it ends one begin. Both do
    // nothing without a begin.
    void begin(std::string name);
    void commit();
    void cancel();
    bool in_transaction() const { return depth_ > 0; }

    // undo and redo do nothing during a transaction or at the end of the list.
    bool can_undo() const { return depth_ == 0 && cursor_ > 0; }
    bool can_redo() const { return depth_ == 0 && cursor_ < history_.size(); }
    void undo();
    void redo();
    std::span<const HistoryStep> history() const { return history_; }
    std::size_t history_cursor() const { return cursor_; }  // steps [0, cursor) are done
    std::optional<std::size_t> saved_cursor() const {
        return saved_cursor_;
    }                                // the file has these steps; nothing: none has
    void go_to(std::size_t cursor);  // undoes or redoes until it is there

  private:
    // What applying edits touched, so that only that is worked out again.
    struct Touched {
        std::vector<FaceId> faces;
        bool hidden = false;
        bool types = false;  // a name, the number of types, or a rule
        bool parameters = false;
        bool geometry = false;
    };

    Document();
    void apply(const Edit& edit, bool forward, Touched& touched);
    void apply(const HistoryStep& step, bool forward);
    void refresh(const Touched& touched);
    Status rebuild_geometry();  // the collision world and the neighbours of the mesh
    void resolve_again();
    void resolve_face(FaceId face);
    void count_face(FaceId face, bool in);
    template <class ValueOf>
    void change(ValueEdit<ValueOf> edit, std::string step_name);
    void perform(std::string step_name, Edit edit);
    void push(HistoryStep step);

    Level level_;
    ResolvedSurfaces unpainted_;  // as if there were no overrides
    ResolvedSurfaces resolved_;
    std::array<std::size_t, max_surface_types + 1> surface_counts_{};
    std::array<double, max_surface_types + 1> surface_areas_{};
    CollisionWorld collision_;
    FaceNeighbours neighbours_;
    Warnings warnings_;
    MatchSummary match_;
    FaceFacts facts_;
    std::vector<FaceId> selection_, guessed_;
    std::vector<std::uint8_t> hidden_flags_;  // [face]; of level_.hidden
    std::vector<HistoryStep> history_;
    std::size_t cursor_ = 0;
    std::optional<std::size_t> saved_cursor_ = 0;  // nothing: the saved state left the history
    HistoryStep open_step_;
    int depth_ = 0;
    std::uint64_t revision_, face_revision_;
};

// Begins on construction; takes everything back on destruction unless committed.
class Transaction {
  public:
    Transaction(Document& document, std::string name) : document_(&document) {
        document.begin(std::move(name));
    }
    ~Transaction() {
        if (document_) document_->cancel();
    }
    Transaction(const Transaction&) = delete;
    Transaction& operator=(const Transaction&) = delete;
    void commit() {
        document_->commit();
        document_ = nullptr;
    }

  private:
    Document* document_;
};

}  // namespace slipface
