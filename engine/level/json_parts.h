// Platforms, terrain and sectors in the level file.
//
//   "platforms": [{"name": "lift", "group": "lift", "path": [{"offset": [0, 0, 0], "speed": 2, "pause": 1},
//   ...],
//                  "repeat": "ping-pong", "spin": {"axis": [0, 1, 0], "pivot": [0, 0, 0], "rate": 1},
//                  "phase": 0}]
//   "props": [{"name": "crate", "mesh": "props/crate.obj", "position": [0, 0, 0], "rotation": [0, 0, 0],
//              "scale": [1, 1, 1], "texture": "dark.png", "type": "ice"}]   (the last five: *)
//   "heightfield": {"file": "terrain.png", "origin": [0, 0, 0], "size": [100, 100], "low": 0, "high": 10}
//   "sectors": {"size": 1024, "placement": [1000000, 0, 0]}
#pragma once

#include <vector>

#include "json_reader.h"
#include "slipface/level/level.h"

namespace slipface {

// Adds the objects inside to `parts`: points of the path, spin.
Platform read_platform(const JsonNode& node, std::vector<JsonNode>& parts);
Prop read_prop(const JsonNode& node);
HeightfieldSource read_heightfield(const JsonNode& node);
SectorLayout read_sectors(const JsonNode& node);

Json vector_json(const Vec3& vector);
// path_point_json() and spin_json() write the objects inside, to which unknown members are added.
Json platform_json(const Platform& platform);
Json path_point_json(const PathPoint& point);
Json spin_json(const Platform& platform);
Json prop_json(const Prop& prop);
Json heightfield_json(const HeightfieldSource& source);
Json sectors_json(const SectorLayout& sectors);

}  // namespace slipface
