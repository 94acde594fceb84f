#include "bsp/bsp_entities.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "bsp/bsp_file.h"
#include "obj/obj_text.h"
#include "slipface/base/text.h"

namespace slipface {
namespace {

constexpr std::size_t max_entities = 100'000;
constexpr double origin_above_feet = 24.0;  // units; the public Quake III source, game/bg_public.h: MINS_Z
constexpr double pi = 3.141592653589793;

// Reads a quoted text from `at` on and moves `at` past it. Returns false if there is none.
bool take_quoted(std::string_view text, std::size_t& at, std::string_view& out) {
    const std::size_t begin = text.find_first_not_of(" \t\r\n", at);
    if (begin == std::string_view::npos || text[begin] != '"') return false;
    const std::size_t end = text.find('"', begin + 1);
    if (end == std::string_view::npos) return false;
    out = text.substr(begin + 1, end - begin - 1);
    at = end + 1;
    return true;
}

// Only entities of players: info_player_intermission is a camera.
bool is_spawn(std::string_view class_name) {
    if (class_name == "info_player_intermission") return false;
    return class_name.starts_with("info_player_") || class_name == "team_CTF_redplayer" ||
           class_name == "team_CTF_blueplayer" || class_name == "team_CTF_redspawn" ||
           class_name == "team_CTF_bluespawn";
}

}  // namespace

std::string_view BspEntity::value(std::string_view key) const {
    const auto found =
        std::find_if(values.begin(), values.end(), [&](const auto& one) { return one.first == key; });
    return found == values.end() ? std::string_view() : found->second;
}

Vec3 BspEntity::origin() const {
    std::string_view text = value("origin");
    Vec3 origin = Vec3::Zero();
    for (double& coordinate : origin) {
        const auto number = read_number(take_word(text));
        if (!number || !(std::abs(*number) <= bsp::largest_coordinate)) return Vec3::Zero();
        coordinate = *number;
    }
    return origin;
}

std::vector<BspEntity> bsp_entities(std::string_view text) {
    text = text.substr(0, text.find('\0'));
    std::vector<BspEntity> entities;
    std::size_t at = 0;
    while (entities.size() < max_entities) {
        at = text.find('{', at);
        if (at == std::string_view::npos) break;
        ++at;
        BspEntity entity;
        std::string_view key, value;
        while (take_quoted(text, at, key) && take_quoted(text, at, value))
            entity.values.emplace_back(key, value);
        entities.push_back(std::move(entity));
    }
    return entities;
}

std::vector<FoundSpawn> bsp_spawns(const std::vector<BspEntity>& entities) {
    std::vector<FoundSpawn> spawns;
    std::map<std::string_view, int> number;
    for (const BspEntity& entity : entities) {
        if (!is_spawn(entity.class_name()) || entity.value("origin").empty()) continue;
        FoundSpawn spawn;
        spawn.name = fmt::format("{} {}", entity.class_name(), ++number[entity.class_name()]);
        spawn.feet = entity.origin() - Vec3(0, 0, origin_above_feet);
        // Quake's 0 degrees look along +X, a quarter turn clockwise from -Z.
        const auto angle = read_number(entity.value("angle"));
        const double degrees = angle && std::abs(*angle) <= 1e6 ? std::remainder(*angle, 360.0) : 0.0;
        spawn.yaw = std::remainder(degrees - 90.0, 360.0) * pi / 180.0;
        spawns.push_back(std::move(spawn));
    }
    return spawns;
}

}  // namespace slipface
