// An open level and its history. Every change goes through here, so that every change can be undone.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
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
using Edit = std::variant<FaceEdit, SelectionEdit, MovementEdit, SurfacesEdit, RulesEdit, SpawnEdit, CamerasEdit>;

// What undo takes back at once: a stroke, a slider drag, a command.
struct HistoryStep {
    std::string name;  // "Paint ice", as menus show it
    std::vector<Edit> edits;
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

    // Counts up at every change of what is shown; face_revision only when a face's type or a type changed.
    std::uint64_t revision() const { return revision_; }
    std::uint64_t face_revision() const { return face_revision_; }

    // Differs from the file on disk. Selecting does not count.
    bool dirty() const;
    Status save();
    Status save_as(const std::filesystem::path& level_file);  // the level file's name; the OBJ stays where it is

    // Changes. Each is one step of history, unless a transaction is open; one that changes nothing leaves no step.
    void paint(std::span<const FaceId> faces, std::optional<SurfaceId> surface);  // nothing: unset
    void select(std::vector<FaceId> faces);
    void set_movement(const MovementSettings& movement, std::string step_name);
    void set_surfaces(std::vector<SurfaceType> surfaces, std::string step_name);  // ids of kept types must not move
    void set_rules(std::vector<MaterialRule> rules);
    void set_spawn(Spawn spawn);
    void set_cameras(std::vector<CameraBookmark> cameras);

    // Gathers what follows into one step until commit(). Nested begins join the outer one. cancel() takes all of it back.
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

  private:
    Document() = default;
    void apply(const Edit& edit, bool forward);
    void record(std::string step_name, Edit edit);
    void resolve_again();

    Level level_;
    ResolvedSurfaces resolved_;
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
    std::uint64_t revision_ = 1, face_revision_ = 1;
};

// Begins on construction; takes everything back on destruction unless committed.
class Transaction {
  public:
    Transaction(Document& document, std::string name) : document_(&document) { document.begin(std::move(name)); }
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
