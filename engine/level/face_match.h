// Finds painted faces again after the geometry changed.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "part_motion.h"
#include "slipface/level/level_file.h"

namespace slipface {

// One painted face as the level file holds it.
struct StoredOverride {
    FaceKey key;
    std::string type;
    std::string location;  // in the file, for warnings
    bool painted = true;
};

// Distance up to which a corner near `position` counts as unmoved: the rounding of a tool that writes six
// decimals and rotates the axes twice, for floats of this size.
double position_tolerance(const Vec3& position);

// Distance from its plane up to which a face lies in it.
double in_plane(const FaceKey& key);

// The key of each of `faces`, with `copy` filled in. `faces` may be a part of the mesh's faces.
std::vector<FaceKey> face_keys(const Mesh& mesh, const std::vector<FaceId>& faces);

// The painted faces of `level` and then its orphans, as in a level file, with empty locations.
// `parts`: filled in, with as many members of `of` as there are painted faces.
std::vector<StoredOverride> stored_overrides(const Level& level, PaintParts& parts);

struct MatchedOverrides {
    std::vector<std::optional<SurfaceId>> overrides;  // [face]
    std::vector<Orphan> orphans;
    std::vector<FaceId>
        guessed;  // found by plane or nearest, or with doubts about their part; or guesses before; ascending
    MatchSummary summary;
    SecondReading second;
    Warnings warnings;
};

// Finds the faces of stored overrides. First the motion of each part in `parts` is found and undone: an
// override is then searched for where its part went, and nothing is guessed for a lost part. Each stage
// handles all overrides that are still without a face before the next stage starts:
// 1. exact: the same loop hash at the same centroid; else the same centroid and normal and nearly the same
//    area, first as far as rounding moved the part's other corners, then farther. A corner that the face had
//    twice may be gone. The same material is preferred, then the same corners. FaceKey::copy distinguishes
//    faces with the same corners. A face is a guess if another one, of another type, fits as well.
// 2. by plane: a new face has the type of the old faces of its material that cover more than half of it, seen
//    along its normal; they lie in its plane, or nearly if it is tilted. If there is no such type, old faces
//    of other materials count as well, where some of its material are among them.
// 3. nearest: the face of the same material with the nearest centroid, at most the old face's size away. Its
//    normal differs by less than 26 degrees, its area by less than a factor of 4, and the line through the
//    old centre along the old normal hits it (or the face only moved along that normal). Before stage 2: a
//    face that was extruded, or of which one corner moved.
// A face found for one type is never given to another. An override without a face, or with an unknown type,
// becomes an orphan.
MatchedOverrides match_overrides(const Mesh& mesh, SurfaceTable surfaces,
                                 const std::vector<StoredOverride>& stored, const PaintParts& parts = {});
// The same in the level's own faces; if some are not exactly there, in those of its props, too.
MatchedOverrides match_overrides(const Level& level, const std::vector<StoredOverride>& stored,
                                 const PaintParts& parts);
// [of `faces`] whether it is one of `set`; both ascending.
std::vector<bool> which_of(std::span<const FaceId> faces, std::span<const FaceId> set);

// The mesh of the level's own faces if it has all of `faces` (ascending), else the whole one. The keys of the
// faces are the same in both.
const Mesh& mesh_with(const Level& level, std::span<const FaceId> faces);

// The keys of a level's hidden faces (first) and of its selections (in their order), as in a level file.
using FaceKeySets = std::vector<std::vector<FaceKey>>;
FaceKeySets stored_face_keys(const Level& level);

// Finds the faces of each set again, by the stages of match_overrides(), and stores them in level.hidden and
// level.selections, which already have their names. A face may be in several sets. Keys without a face are
// dropped: unlike paint they are quickly selected anew. Returns a warning for each set that lost faces.
Warnings match_stored_faces(Level& level, const FaceKeySets& sets);

}  // namespace slipface
