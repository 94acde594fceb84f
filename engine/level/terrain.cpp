// Terrain from an image.
#include <fmt/format.h>

#include "slipface/base/named_file.h"
#include "slipface/level/level_file.h"

namespace slipface {

namespace {

constexpr int max_terrain_side = 4097;  // samples: 16 million heights

}  // namespace

Heightfield make_heightfield(const HeightfieldSource& source, const GreyImage& image) {
    Heightfield field{.columns = image.width,
                      .rows = image.height,
                      .heights = {},
                      .origin = source.origin,
                      .size = source.size};
    field.heights.reserve(image.values.size());
    for (const std::uint16_t value : image.values) {
        const double fraction = static_cast<double>(value) / 65535.0;
        field.heights.push_back(source.origin.y() + source.low + (source.high - source.low) * fraction);
    }
    return field;
}

Status load_terrain(Level& level) {
    level.terrain.reset();
    if (!level.heightfield) return {};
    const NamedFile file = named_file(level.heightfield->file, level.file_path.parent_path());
    if (!file) return file.error();
    const std::filesystem::path& path = file.path;
    const Result<GreyImage> image = load_grey_image(path, max_terrain_side);
    if (!image) return image.error();
    if (image->width < 2 || image->height < 2) {
        return Error{path.string(), fmt::format("is {} x {} pixels; terrain needs at least 2 x 2",
                                                image->width, image->height)};
    }
    level.terrain = std::make_shared<const Heightfield>(make_heightfield(*level.heightfield, *image));
    return {};
}

}  // namespace slipface
