// The lumps of a Quake 3 map, with bounds checked once.
#pragma once

#include <bit>
#include <cstdint>
#include <string>
#include <string_view>

#include "slipface/base/result.h"
#include "slipface/base/types.h"

namespace slipface {

inline std::uint32_t u32_at(std::string_view bytes, std::size_t at) {
    std::uint32_t value = 0;
    for (std::size_t i = 4; i-- > 0;)
        value = value << 8 | static_cast<unsigned char>(bytes[at + i]);
    return value;
}
inline std::int32_t i32_at(std::string_view bytes, std::size_t at) {
    return static_cast<std::int32_t>(u32_at(bytes, at));
}
inline float f32_at(std::string_view bytes, std::size_t at) {
    return std::bit_cast<float>(u32_at(bytes, at));
}
inline Vec3f vec3_at(std::string_view bytes, std::size_t at) {
    return {f32_at(bytes, at), f32_at(bytes, at + 4), f32_at(bytes, at + 8)};
}

// A range of records within a lump.
struct BspRange {
    std::size_t first = 0, count = 0;
    bool within(std::size_t size) const { return first <= size && count <= size - first; }
};
inline BspRange bsp_range_at(std::string_view record, std::size_t at) {
    return {u32_at(record, at), u32_at(record, at + 4)};
}

// The records of one kind.
struct BspLump {
    std::string_view bytes;
    std::size_t record = 1;
    std::size_t count() const { return bytes.size() / record; }
    std::string_view at(std::size_t i) const { return bytes.substr(i * record, record); }
};

struct BspFile {
    std::string_view entities;  // text
    BspLump textures{{}, 72};   // name, surface flags, contents
    BspLump planes{{}, 16};     // normal, distance
    BspLump nodes{{}, 36};      // plane, two children (below 0: leaf -1 - child), box
    BspLump leaves{{}, 48};     // cluster (below 0: solid or outside), area, box, faces, brushes
    BspLump models{{}, 40};     // box, faces, brushes; the first is the world
    BspLump brushes{{}, 12};    // sides, texture (whose contents are those of the brush)
    BspLump sides{{}, 8};       // plane, texture
    BspLump vertices{{}, 44};   // position, texture coordinates, lightmap coordinates, normal, colour
    BspLump indices{{}, 4};     // relative to the first vertex of the face
    BspLump faces{{}, 104};

    std::string_view texture_name(std::size_t texture) const {
        const std::string_view name = textures.at(texture).substr(0, 64);
        return name.substr(0, name.find('\0'));
    }
    std::uint32_t surface_flags(std::size_t texture) const { return u32_at(textures.at(texture), 64); }
    std::uint32_t contents(std::size_t texture) const { return u32_at(textures.at(texture), 68); }
};

namespace bsp {
// code/game/surfaceflags.h
inline constexpr std::uint32_t contents_solid = 0x1, contents_playerclip = 0x10000;
// These contents stop a player.
inline constexpr std::uint32_t contents_wall = contents_solid | contents_playerclip;
inline constexpr std::uint32_t surface_sky = 0x4, surface_nonsolid = 0x4000;
inline constexpr float largest_coordinate = 1e7F;  // units
}  // namespace bsp

// Finds the lumps. Errors: another version, lumps that do not fit into the file. Indices inside records are
// not checked. The result refers to `bytes`.
Result<BspFile> open_bsp(std::string_view bytes, const std::string& location);

}  // namespace slipface
