#include "found_in_file.h"

#include <algorithm>

namespace slipface {

SurfaceType found_surface_type(std::string_view name) {
    for (SurfaceType& preset : preset_surface_types())
        if (preset.name == name) return std::move(preset);
    SurfaceType type;
    type.name = name;
    type.color = {0.55F, 0.55F, 0.75F};
    type.hatch = Hatch::dots;
    type.solid = false;
    return type;
}

void add_found_types(Level& level, std::span<const FoundType> found) {
    for (const FoundType& one : found) {
        if (!find_surface(level, one.type)) {
            if (level.surfaces.size() == max_surface_types) continue;
            level.surfaces.push_back(found_surface_type(one.type));
        }
        const MaterialRule rule{one.material, one.type};
        if (std::find(level.rules.begin(), level.rules.end(), rule) == level.rules.end())
            level.rules.push_back(rule);
    }
}

}  // namespace slipface
