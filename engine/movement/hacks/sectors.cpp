// Problem: far from the origin floating point numbers are coarse, and the player jitters and sticks.
// Hack (lecture, "Maximize floating-point precision"): the world is divided into sectors, each with its own
// local coordinates; a player who moves into another sector is given coordinates of that sector.
//
// The scene is given in the coordinates of one sector, its home. Where that sector lies in the world, and how
// far out, enters no calculation, so a level runs there exactly as it does at the origin.
#include <cmath>

#include "slipface/movement/step.h"

namespace slipface {

Vec3 position_in_scene(const MovementScene& scene, const PlayerState& state) {
    const Sectors& sectors = scene.sectors;
    if (!(sectors.size > 0.0)) return state.position;
    Vec3 position = state.position;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const double steps =
            static_cast<double>(state.sector[axis]) - static_cast<double>(sectors.home[axis]);
        position[static_cast<Eigen::Index>(axis)] += steps * sectors.size;
    }
    return position;
}

void put_in_scene(const MovementScene& scene, const Vec3& position, PlayerState& state) {
    const Sectors& sectors = scene.sectors;
    state.position = position;
    state.sector = {0, 0, 0};
    if (!(sectors.size > 0.0)) return;
    constexpr double farthest = 1e9;  // sectors; keeps the index an integer
    for (std::size_t axis = 0; axis < 3; ++axis) {
        double& part = state.position[static_cast<Eigen::Index>(axis)];
        double steps = std::round(part / sectors.size);
        if (!(std::abs(steps) <= farthest)) steps = 0.0;
        part -= steps * sectors.size;
        state.sector[axis] = static_cast<std::int32_t>(static_cast<double>(sectors.home[axis]) + steps);
    }
}

}  // namespace slipface
