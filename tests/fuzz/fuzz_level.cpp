// Any bytes as a level file: an error, or a level that is written and read again to the same text.
#include <cstdlib>
#include <string_view>

#include "slipface/level/level_file.h"
#include "slipface/mesh/build.h"

using namespace slipface;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const MeshPtr mesh = [] {
        PolygonSoup soup;
        soup.corner_position = {Vec3f(0, 0, 0), Vec3f(0, 0, 1), Vec3f(1, 0, 1), Vec3f(1, 0, 0),
                                Vec3f(0, 0, 0), Vec3f(0, 1, 0), Vec3f(0, 0, 1)};
        soup.face_first_corner = {0, 4, 7};
        auto built = build_mesh(std::move(soup));
        if (!built) std::abort();
        return *built;
    }();
    const auto loaded =
        level_from_json({reinterpret_cast<const char*>(data), size}, "level.slipface.json", mesh);
    if (!loaded) return 0;
    resolve_surfaces(loaded->level);
    const std::string once = level_to_json(loaded->level);
    const auto again = level_from_json(once, "level.slipface.json", mesh);
    if (!again || level_to_json(again->level) != once) std::abort();
    return 0;
}
