// How the player gets from one part of a level to another: links for an engine's navigation mesh, each with
// the tape that proves it.
#pragma once

#include <array>
#include <string>

#include "slipface/reach/search.h"

namespace slipface {

// Walkable faces that touch, or whose rims lie no more than a step above each other and no farther apart
// than the player's radius. Terrain is a region, too. Faces of platforms are in none: they are ridden.
struct WalkRegions {
    struct Region {
        std::vector<FaceId> faces;  // ascending; none for terrain without faces
        double area_m2 = 0.0;       // of its faces
    };
    std::vector<Region> regions;         // by their first faces; last, terrain without faces
    std::vector<std::uint32_t> of_face;  // [face] index into regions, or no_id
    std::uint32_t of_terrain = no_id;    // likewise

    // Of a player who stands there; no_id in the air, on a ladder and on a platform.
    std::uint32_t of(const PlayerState& state) const;
};
WalkRegions walk_regions(const Level& level);

// What the player does between the regions. Of several, the last: who jumps onto a platform rides.
enum class LinkKind : std::uint8_t { walk, crawl, drop, jump, air_jump, wall_jump, dash, ledge, climb, ride };
inline constexpr std::array<const char*, 10> link_kind_names{
    "walk", "crawl", "drop", "jump", "air_jump", "wall_jump", "dash", "ledge", "climb", "ride"};

struct ReachLink {
    std::uint32_t from = no_id, to = no_id;  // regions
    LinkKind kind = LinkKind::walk;
    bool two_way = false;      // another link leads back
    FaceId from_face = no_id;  // stood on last; no_id: terrain
    FaceId to_face = no_id;    // stood on first
    // The player's lowest point, in the level's coordinates: last on `from`, first on `to`.
    Vec3 begin = Vec3::Zero(), end = Vec3::Zero();
    Vec3 velocity = Vec3::Zero();  // m/s, at `begin`
    double time_s = 0.0;           // from `begin` to `end`
    // From the search's start. After `begin_tick` ticks the player is at `begin`, after the last one at
    // `end`.
    Tape tape;
    std::size_t begin_tick = 0;
};

struct ReachLinks {
    WalkRegions regions;
    std::vector<ReachLink> links;  // by from, to and kind: of each the fastest that was found
};

// One link as JSON on one line; all of them with the regions; and as the off-mesh connections of a .gset file
// of RecastDemo.
std::string link_to_json(const ReachLink& link);
std::string links_to_json(const ReachSearch& search, const ReachLinks& links);
std::string links_to_gset(const ReachSearch& search, const ReachLinks& links);

}  // namespace slipface
