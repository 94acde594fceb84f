// Surface types from the material properties that other tools use.
#pragma once

#include "slipface/level/level.h"

namespace slipface {

struct ImportedRules {
    std::vector<SurfaceType> types;  // used by the rules; add_rules() leaves those the level already has
    std::vector<MaterialRule> rules;
    Warnings warnings;  // about content without a meaning here
};

// Reads rules from a file. Its ending chooses the format:
//   .shader  Quake 3 shaders: `surfaceparm slick` is ice, `ladder` is ladder, `nonsolid`, `water` and `fog`
//            are nonsolid, `lava` and `slime` are hazard. Each shader gives a rule for its whole name and one
//            for the last part of the name.
//   .bsp     Quake 3 maps: the same by the flags of each texture (SURF_SLICK 0x2, SURF_LADDER 0x8,
//            SURF_NONSOLID 0x4000 unless the texture is solid or playerclip, CONTENTS_LAVA 8, CONTENTS_SLIME
//            16, CONTENTS_WATER 32, CONTENTS_FOG 64).
//   .json    another level file: its rules and the types that they name.
//   .txt     lines "PATTERN TYPE"; '#' begins a comment.
// Errors name the file and the line or the JSON path.
Result<ImportedRules> read_rules(const std::filesystem::path& path);

// Adds the types and rules that the level does not have yet, and returns how many of each were added. Errors:
// the level would have too many types; a rule names a type that the level does not have.
struct AddedRules {
    std::size_t types = 0, rules = 0;
};
Result<AddedRules> add_rules(Level& level, const ImportedRules& imported);

}  // namespace slipface
