// Finding painted faces again.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "slipface/level/level_file.h"

namespace slipface {

// One painted face as the level file holds it.
struct StoredOverride {
    FaceKey key;
    std::string type;
    std::string location;  // where it stands in the file
};

// How far a face's corners may lie from where they were and still be the same: what a tool that writes six
// decimals and turns the axes twice does to floats of this size.
double position_tolerance(const Vec3& position);

// For each face its key with `copy` filled in; the faces need not be all of the mesh's.
std::vector<FaceKey> face_keys(const Mesh& mesh, const std::vector<FaceId>& faces);

// The painted faces of `level` and its orphans, as a level file would hold them, without places.
std::vector<StoredOverride> stored_overrides(const Level& level);

struct MatchedOverrides {
    std::vector<std::optional<SurfaceId>> overrides;  // [face]
    std::vector<Orphan> orphans;
    std::vector<FaceId> guessed;  // not found exactly, ascending
    MatchSummary summary;
    Warnings warnings;
};

// Stages, each over all stored overrides before the next begins, and each only for what is still without a
// face:
// 1. exact: the same loop hash at the same centroid; else the same centroid, normal and area within what
// rounding to six
//    decimals does. The same material is preferred. Faces with the same corners are told apart by
//    FaceKey::copy.
// 2. by plane: faces of the same material in the same plane that are a part of the old face (smaller, centre
// near, together not
//    larger) or that contain its centre (the old face was merged, or its outline moved).
//    Long faces whose parts lie far from their centre: connected faces that together have the old area and
//    the old mean of corners.
// 3. nearest: the face of the same material, turned by less than 25 degrees, that the old centre meets along
// its normal first,
//    at most the old face's size away.
// Faces taken by one type are never given to another. What finds nothing, or has an unknown type, becomes an
// orphan.
MatchedOverrides match_overrides(const Mesh& mesh, SurfaceTable surfaces,
                                 const std::vector<StoredOverride>& stored);

// The hidden faces of a level (first) and its selections (in their order), as a level file holds them.
using FaceKeySets = std::vector<std::vector<FaceKey>>;
FaceKeySets stored_face_keys(const Level& level);

// Finds the faces of each set again, by the stages of match_overrides, and puts them into level.hidden and
// level.selections, whose names are there already. A face may be in several sets. What finds no face is
// dropped: unlike paint it is quickly chosen anew. Returns a warning for each set that lost faces.
Warnings match_stored_faces(Level& level, const FaceKeySets& sets);

}  // namespace slipface
