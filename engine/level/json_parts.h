// Platforms, terrain and sectors in the level file.
//
//   "platforms": [{"name": "lift", "group": "lift", "path": [{"offset": [0, 0, 0], "speed": 2, "pause": 1},
//   ...],
//                  "repeat": "ping-pong", "spin": {"axis": [0, 1, 0], "pivot": [0, 0, 0], "rate": 1},
//                  "phase": 0}]
//   "heightfield": {"file": "terrain.png", "origin": [0, 0, 0], "size": [100, 100], "low": 0, "high": 10}
//   "sectors": {"size": 1024, "placement": [1000000, 0, 0]}
#pragma once

#include <set>
#include <string_view>

#include "json_reader.h"
#include "slipface/level/level.h"

namespace slipface {

inline const std::set<std::string_view> platform_keys{"name", "group", "path", "repeat", "spin", "phase"};
inline const std::set<std::string_view> path_keys{"offset", "speed", "pause"};
inline const std::set<std::string_view> spin_keys{"axis", "pivot", "rate"};
inline const std::set<std::string_view> heightfield_keys{"file", "origin", "size", "low", "high"};
inline const std::set<std::string_view> sectors_keys{"size", "placement"};

// Each stores its error in the reader; `path` names the value in the error.
Platform read_platform(JsonReader& reader, const Json& json, const std::string& path);
HeightfieldSource read_heightfield(JsonReader& reader, const Json& json, const std::string& path);
SectorLayout read_sectors(JsonReader& reader, const Json& json, const std::string& path);

Json vector_json(const Vec3& vector);
// path_point_json() and spin_json() write the objects inside, to which unknown members are added.
Json platform_json(const Platform& platform);
Json path_point_json(const PathPoint& point);
Json spin_json(const Platform& platform);
Json heightfield_json(const HeightfieldSource& source);
Json sectors_json(const SectorLayout& sectors);

}  // namespace slipface
