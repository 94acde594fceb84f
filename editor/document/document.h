// An open level and its history. Every change goes through here, so that every change can be undone.
#pragma once

#include <array>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

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
template <class T>
struct ValueEdit {
    T before, after;
};
struct Spawn {
    Vec3 position;
    double yaw;
    friend bool operator==(const Spawn&, const Spawn&) = default;
};
using MovementEdit = ValueEdit<MovementSettings>;
using SurfacesEdit = ValueEdit<std::vector<SurfaceType>>;
using RulesEdit = ValueEdit<std::vector<MaterialRule>>;
using SpawnEdit = ValueEdit<Spawn>;
using CamerasEdit = ValueEdit<std::vector<CameraBookmark>>;
using OrphansEdit = ValueEdit<std::vector<Orphan>>;
using Edit = std::variant<FaceEdit, SelectionEdit, MovementEdit, SurfacesEdit, RulesEdit, SpawnEdit,
                          CamerasEdit, OrphansEdit>;

// What undo takes back at once: a stroke, a slider drag, a command.
struct HistoryStep {
    std::string name;         // "Paint ice", as menus show it
    std::vector<Edit> edits;  // at most one of each kind, so their order does not matter

    bool changes_file() const;  // false: it only selects
};

class Document {
  public:
    // Opens an OBJ or a level file. `warnings()` tells what was repaired or dropped.
    static Result<std::unique_ptr<Document>> open(const std::filesystem::path& path);

    const Level& level() const { return level_; }
    const Mesh& mesh() const { return *level_.mesh; }
    const ResolvedSurfaces& resolved() const { return resolved_; }
    const CollisionWorld& collision() const { return collision_; }
    const FaceNeighbours& neighbours() const { return neighbours_; }
    const Warnings& warnings() const { return warnings_; }
    const MatchSummary& match() const { return match_; }
    MovementScene scene() const { return {collision_, level_.surfaces}; }
    std::span<const FaceId> selection() const { return selection_; }  // ascending

    std::size_t face_count_of(SurfaceId surface) const { return surface_counts_[surface]; }

    // The nearest face that the ray meets, non-solid ones too; with `front_only`, seen from the front.
    // Nothing changes for an observer, but no other query may run meanwhile.
    std::optional<RayHit> pick(const Vec3& origin, const Vec3& direction, bool front_only);

    // Never the same for two documents. Counts up at every change of what is shown; face_revision only when a
    // face's type or a type changed.
    std::uint64_t revision() const { return revision_; }
    std::uint64_t face_revision() const { return face_revision_; }

    // Differs from the file on disk. Selecting does not count.
    bool dirty() const;
    Status save();
    Status save_as(
        const std::filesystem::path& level_file);  // the level file's name; the OBJ stays where it is

    // Changes. Each is one step of history, unless a transaction is open; one that changes nothing leaves no
    // step.
    void paint(std::span<const FaceId> faces, std::optional<SurfaceId> surface);  // nothing: unset
    void select(std::vector<FaceId> faces);
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
    void set_spawn(Spawn spawn);
    void set_cameras(std::vector<CameraBookmark> cameras);

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
        bool types = false;  // a name, the number of types, or a rule
        bool parameters = false;
    };

    Document();
    Spawn spawn() const { return {level_.spawn, level_.spawn_yaw}; }
    void apply(const Edit& edit, bool forward, Touched& touched);
    void apply(const HistoryStep& step, bool forward);
    void refresh(const Touched& touched);
    void resolve_again();
    void resolve_face(FaceId face);
    template <class ValueOf>
    void change(ValueEdit<ValueOf> edit, std::string step_name);
    void perform(std::string step_name, Edit edit);
    void push(HistoryStep step);

    Level level_;
    ResolvedSurfaces unpainted_;  // as if there were no overrides
    ResolvedSurfaces resolved_;
    std::array<std::size_t, max_surface_types + 1> surface_counts_{};
    CollisionWorld collision_;
    FaceNeighbours neighbours_;
    Warnings warnings_;
    MatchSummary match_;
    std::vector<FaceId> selection_;
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
