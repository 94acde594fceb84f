// Two changes of one level joined.
#pragma once

#include <string>
#include <vector>

#include "slipface/level/level_file.h"

namespace slipface {

enum class MergeSide { mine, theirs };

struct MergedLevels {
    Level level;
    std::vector<FaceId> conflicts;  // ascending: faces that both painted, each with another type
    // What else both changed, each in another way: "Movement setting Maximum slope", "Camera door".
    std::vector<std::string> other_conflicts;
};

// What `base` became in `mine` and in `theirs`, in one level: what only one of them changed is as it made
// it, face by face and name by name; where both changed the same thing, `winner` decides. All three must have
// the same geometry without props. Where the lists of props differ, the paint on props goes with the list.
// Error: more types than a level may have.
Result<MergedLevels> merge_levels(const Level& base, const Level& mine, const Level& theirs,
                                  MergeSide winner);

// The level that the text of a level file makes of the geometry of `on`; without a text one without
// annotations. `location` names the text in errors.
Result<Level> annotated(const std::string* text, const std::string& location, const Level& on);

}  // namespace slipface
