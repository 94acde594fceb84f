// The changes of each face between two states of a level.
#pragma once

#include <string>
#include <vector>

#include "slipface/level/level.h"

namespace slipface {

struct FaceChange {
    enum class Kind {
        none,
        surface,     // another surface type
        parameters,  // the same type with other parameters
        moved,
        flipped,   // the same corners in the opposite order
        material,  // of another name, colour or texture
        texture,   // other texture coordinates
        removed,
        added
    } kind = Kind::none;
    FaceId before = no_id, after = no_id;  // no_id: does not exist
    double moved = 0.0;                    // metres, of the corner that moved most
    std::string text;                      // of the kind, without the face: "changed ice to default"

    bool affects_movement() const { return kind != Kind::material && kind != Kind::texture; }
};

struct LevelChanges {
    std::vector<FaceChange> list;
    std::vector<std::uint32_t> of_before, of_after;  // [face] index into list; no_id: unchanged
    std::vector<FaceId> partner;                     // [face before] the same face after; no_id: removed

    const FaceChange* before(FaceId face) const { return at(of_before, face); }
    const FaceChange* after(FaceId face) const { return at(of_after, face); }

  private:
    const FaceChange* at(const std::vector<std::uint32_t>& index, FaceId face) const {
        return face < index.size() && index[face] != no_id ? &list[index[face]] : nullptr;
    }
};

// Pairs faces by their corners; the remaining ones by group, number of corners and order.
LevelChanges compare_levels(const Level& before, const Level& after);

// A surface type whose parameters differ, or that is there on one side only.
struct TypeChange {
    std::string name;
    std::string text;  // "climbable was yes, is no"
};
std::vector<TypeChange> type_changes(const Level& before, const Level& after);

// "face 88 of `roof`"; "face 88" where the group has no name.
std::string face_label(const Mesh& mesh, FaceId face);
std::string group_label(const Mesh& mesh, FaceId face);  // "`roof`", or "the level"

}  // namespace slipface
