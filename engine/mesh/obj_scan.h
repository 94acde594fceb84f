#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "slipface/base/result.h"
#include "warning_list.h"

namespace slipface {

// A name and the line on which it was first used.
struct NameOnLine {
    std::string name;
    std::size_t line = 0;
};

// An OBJ file checked, and its polygons written out anew for a reader that need not be careful.
struct ObjScan {
    // Only `v x y z`, `vt u v` and `f`, with positive indices and either `v` or `v/vt` throughout. Every few
    // million corners a `usemtl`, so that no reader's mesh becomes too large for it.
    std::string clean;

    std::vector<std::uint32_t> face_first_corner;  // [face + 1], in the file's order
    std::vector<std::uint32_t> face_material;      // [face] index into materials
    std::vector<std::uint32_t> face_group;         // [face] index into groups
    std::vector<NameOnLine> materials;             // `usemtl` names, in the order in which faces use them
    std::vector<NameOnLine> groups;                // `o` and `g` names, whichever came last before a face
    std::vector<NameOnLine> libraries;             // the arguments of each `mtllib`
};

// Refuses what import_mesh() says it refuses; `place` is the file's name in messages.
Result<ObjScan> scan_obj(std::string text, const std::string& place, WarningList& warnings);

}  // namespace slipface
