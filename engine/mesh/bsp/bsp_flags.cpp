#include "slipface/mesh/bsp_flags.h"

#include <algorithm>
#include <iterator>

#include "bsp/bsp_file.h"

namespace slipface {
namespace {

constexpr BspParameter parameters[] = {
    {"lava", 0, 0x8, "hazard"},
    {"slime", 0, 0x10, "hazard"},
    {"ladder", 0x8, 0, "ladder"},
    {"nonsolid", 0x4000, 0, "nonsolid"},
    {"slick", 0x2, 0, "ice"},
    {"nodamage", 0x1, 0, nullptr},
    {"noimpact", 0x10, 0, nullptr},
    {"nomarks", 0x20, 0, nullptr},
    {"flesh", 0x40, 0, nullptr},
    {"nodraw", 0x80, 0, nullptr},
    {"hint", 0x100, 0, nullptr},
    {"skip", 0x200, 0, nullptr},
    {"nolightmap", 0x400, 0, nullptr},
    {"pointlight", 0x800, 0, nullptr},
    {"metalsteps", 0x1000, 0, nullptr},
    {"nosteps", 0x2000, 0, nullptr},
    {"sky", 0x4, 0, nullptr},
    {"dust", 0x40000, 0, nullptr},
    {"trans", 0, 0x20000000, nullptr},
    {"detail", 0, 0x8000000, nullptr},
    {"structural", 0, 0x10000000, nullptr},
    {"playerclip", 0, 0x10000, nullptr},
    {"water", 0, 0x20, "nonsolid"},
    {"fog", 0, 0x40, "nonsolid"},
    {"origin", 0, 0x1000000, nullptr},
    {"areaportal", 0, 0x8000, nullptr},
    {"clusterportal", 0, 0x100000, nullptr},
    {"donotenter", 0, 0x200000, nullptr},
    {"botclip", 0, 0x400000, nullptr},
    {"nodrop", 0, 0x80000000, nullptr},
    {"monsterclip", 0, 0x20000, nullptr},
    {"alphashadow", 0, 0, nullptr},
    {"lightfilter", 0, 0, nullptr},
    {"nodlight", 0x20000, 0, nullptr},
};

}  // namespace

std::span<const BspParameter> bsp_parameters() {
    return parameters;
}

const char* bsp_surface_type(std::uint32_t surface_flags, std::uint32_t contents) {
    // `common/clip` is non-solid for shots but stops players.
    if ((contents & bsp::contents_wall) != 0) surface_flags &= ~bsp::surface_nonsolid;
    const auto* const found =
        std::find_if(std::begin(parameters), std::end(parameters), [&](const BspParameter& one) {
            return one.type != nullptr &&
                   ((one.surface_flag & surface_flags) != 0 || (one.contents_flag & contents) != 0);
        });
    return found == std::end(parameters) ? nullptr : found->type;
}

}  // namespace slipface
