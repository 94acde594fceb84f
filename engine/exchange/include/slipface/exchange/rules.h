// Surface types from what other tools know about materials.
#pragma once

#include "slipface/level/level.h"

namespace slipface {

struct ImportedRules {
    std::vector<SurfaceType> types;  // that the rules need; those the level has already stay as they are
    std::vector<MaterialRule> rules;
    Warnings warnings;  // what has no meaning here
};

// Rules from a file, by its ending:
//   .shader  Quake 3 shaders: `surfaceparm slick` is ice, `ladder` is ladder, `nonsolid`, `water` and `fog`
//            are nonsolid, `lava` and `slime` are hazard. Each shader gives a rule for its whole name and one
//            for the last part.
//   .bsp     Quake 3 maps: the same by the flags of each texture (SURF_SLICK 0x2, SURF_LADDER 0x8,
//            SURF_NONSOLID 0x4000 unless the texture is solid or playerclip, CONTENTS_LAVA 8, CONTENTS_SLIME
//            16, CONTENTS_WATER 32, CONTENTS_FOG 64).
//   .json    another level file: its rules, and the types that they name.
//   .txt     lines "PATTERN TYPE"; '#' begins a comment.
// The last rule that matches counts, as everywhere. Errors name file and line or place.
Result<ImportedRules> read_rules(const std::filesystem::path& path);

// Adds types and rules that the level does not have yet; how many of each came in. Fails where the level
// would have too many types.
struct AddedRules {
    std::size_t types = 0, rules = 0;
};
Result<AddedRules> add_rules(Level& level, const ImportedRules& imported);

}  // namespace slipface
