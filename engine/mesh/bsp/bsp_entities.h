// The entities of a Quake 3 map: its spawns and moving parts.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "slipface/mesh/import.h"

namespace slipface {

struct BspEntity {
    std::vector<std::pair<std::string_view, std::string_view>> values;  // views into the lump
    std::string_view value(std::string_view key) const;                 // empty if there is none
    std::string_view class_name() const { return value("classname"); }
    Vec3 origin() const;  // coordinates of the map; zero if there is none
};

// Reads blocks of `{ "key" "value" ... }`, at most 100,000. Malformed text is skipped without an error: a map
// is playable without entities.
std::vector<BspEntity> bsp_entities(std::string_view text);

// The entities where players enter: info_player_* and those of team games. In coordinates of the map (+Z up,
// units); `yaw` is already that of FoundSpawn.
std::vector<FoundSpawn> bsp_spawns(const std::vector<BspEntity>& entities);

}  // namespace slipface
