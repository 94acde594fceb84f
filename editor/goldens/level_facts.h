// What a level is by meaning, for images and movement: two readings give equal facts if and only if nothing
// that a snapshot may show has changed.
//
//   { "version": 2, "kind": "level",
//     "members": { ... },     the level file's, lists of named things as objects by name
//     "objects": { NAME: faces }, "meshes": { FILE: { NAME: faces } }, "materials": { NAME: ... },
//     "pictures": { FILE: hash of its pixels }, "terrain": heights, "light_fits": true,
//     "warnings": [ ... ],
//     "order": { "props": [["crate"], ...], ... } }     orders of the file; alone they mean nothing
#pragma once

#include "goldens/numbers_json.h"
#include "slipface/level/level.h"

namespace slipface {

Numbers level_facts(const Level& level, const Warnings& warnings);

// The heights in the facts' "terrain"; empty: it has none, or they were not stored.
std::vector<double> terrain_heights(const Numbers& terrain);

}  // namespace slipface
