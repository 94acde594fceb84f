// The floors of a level in columns of a grid: where a body stands, how high the room above is, and whether
// the place lies inside a solid. Each triangle is looked at once, so that a large level takes a tenth of a
// second.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "slipface/movement/settings.h"
#include "slipface/movement/step.h"

namespace slipface {

struct FloorColumns {
    // Room above `top` for a body: nothing in the whole cell is higher, up to `ceiling`.
    struct Place {
        double top = 0.0, ceiling = 0.0;  // metres, the scene's coordinates
        double rise = 0.0;                // of the floor within the cell, metres
        bool floor = false;               // a player stands there
    };
    // A floor with room above it on the line through the middle of a cell.
    struct Standing {
        std::uint32_t cell = 0;
        double y = 0.0;
        bool front = false;  // of the face
        // The winding number just above, counted along the line from above and from below: equal in a level
        // of closed shells. 1 or more: inside of one whose faces look out. -1 or less: of one whose faces
        // look in.
        int from_above = 0, from_below = 0;
    };

    Vec2 origin = Vec2::Zero();  // x and z
    double cell = 1.0;           // edge, metres
    int columns = 0, rows = 0;
    double body = 0.0;                // height of the player, metres
    std::vector<Place> places;        // by cell, from below
    std::vector<std::size_t> first;   // [cell] its first place; one more at the end
    std::vector<Standing> standings;  // by cell, from below
    Aabb bounds;                      // of static geometry and terrain

    std::size_t cell_at(int column, int row) const {
        return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
               static_cast<std::size_t>(column);
    }
    std::array<double, 2> middle(std::size_t at) const {  // x and z
        const auto wide = static_cast<std::size_t>(columns);
        return {origin.x() + (static_cast<double>(at % wide) + 0.5) * cell,
                origin.y() + (static_cast<double>(at / wide) + 0.5) * cell};
    }
    std::span<const Place> places_in(std::size_t at) const {
        return std::span(places).subspan(first[at], first[at + 1] - first[at]);
    }
};

// Of the static geometry and the terrain. Cells are a little larger than the player's radius, and larger
// where there would be too many. Empty: no geometry, or bounds that are not finite.
FloorColumns floor_columns(const MovementScene& scene, const MovementSettings& settings);

}  // namespace slipface
