// What a character meets of a scene, and which other characters.
#pragma once

#include "slipface/collision/filter.h"

namespace slipface {

// A scene without one is seen whole, and costs nothing. Groups are bits that a game gives a meaning: enemies'
// doors, the second player's bridge.
//
//   const SceneFilter ghost{.mask = ~doors};
//   MovementScene seen = scene;
//   seen.filter = &ghost;  // for step(), put_player(), slide_move() and every other query of a scene
struct SceneFilter {
    std::uint32_t mask = ~std::uint32_t{0};    // what has one of these groups is met, faces and characters
    std::uint32_t groups = ~std::uint32_t{0};  // of the character itself, for the masks of others
    std::bitset<256> ignored{};                // [SurfaceId] true: faces of the type are not met
    // As QueryFilter::ask, with the platform or no_id, and the triangle's number in that world.
    bool (*ask)(void* user, std::uint32_t platform, TriangleId triangle) = nullptr;
    void* user = nullptr;
};

// Two characters meet if each is in a group that the other one meets; null: in all, and meets all.
inline bool meet(const SceneFilter* a, const SceneFilter* b) {
    const SceneFilter everything;
    const SceneFilter &first = a != nullptr ? *a : everything, &second = b != nullptr ? *b : everything;
    return (first.mask & second.groups) != 0 && (second.mask & first.groups) != 0;
}

}  // namespace slipface
