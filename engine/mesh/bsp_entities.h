// The entities of a Quake 3 map: its spawns, and where its moving parts stand.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "slipface/mesh/import.h"

namespace slipface {

struct BspEntity {
    std::vector<std::pair<std::string_view, std::string_view>> values;  // views of the lump
    std::string_view value(std::string_view key) const;                 // empty where there is none
    std::string_view class_name() const { return value("classname"); }
    Vec3 origin() const;  // the map's coordinates; zero where there is none
};

// Reads blocks of `{ "key" "value" ... }`. What is no such block ends the list: a map is playable without
// entities.
std::vector<BspEntity> bsp_entities(std::string_view text);

// Where players enter: info_player_* and the team games' own. In the map's coordinates (+Z up, units); `yaw`
// is already as FoundSpawn has it.
std::vector<FoundSpawn> bsp_spawns(const std::vector<BspEntity>& entities);

}  // namespace slipface
