// slipface_generate_levels OUT_FOLDER [--bake [NAME...]]: writes the shipped levels and their textures, the
// same bytes at every run. Baking light takes minutes and is done only when asked for.
// slipface_generate_levels --check-light FOLDER: bakes some faces of each level in FOLDER again and compares
// them with its light maps.
#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <filesystem>
#include <vector>

#include "obj_writer.h"
#include "recipes.h"
#include "slipface/base/files.h"
#include "slipface/image/image.h"
#include "slipface/level/level_file.h"
#include "slipface/level/preset.h"
#include "slipface/light/bake.h"
#include "slipface/mesh/import.h"
#include "textures.h"

namespace slipface::generate {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t texels_to_check = 400;  // a level

struct Arguments {
    fs::path folder;
    bool check_light = false;
    bool bake = false;
    std::vector<std::string> names;  // of the levels to bake; none: all
};

Status write_textures(const fs::path& folder) {
    std::error_code failed;
    fs::create_directories(folder, failed);
    if (failed) return Error{folder.string(), failed.message()};
    for (const auto& textures :
         {stone_textures(), ornament_textures(), nature_textures(), surface_textures(), wild_textures()}) {
        for (const Texture& texture : textures) {
            const Status status = save_png(folder / (texture.name + ".png"), texture.paint());
            if (!status.ok()) return status;
        }
    }
    return {};
}

Status write_level(const Recipe& recipe, const Arguments& arguments) {
    const Model model = recipe.make();
    const fs::path obj = arguments.folder / (recipe.name + ".obj");
    if (Status status = write_file_atomic(obj, obj_text(model, recipe.name, recipe.name + ".mtl"));
        !status.ok())
        return status;
    if (Status status =
            write_file_atomic(arguments.folder / (recipe.name + ".mtl"), mtl_text(model, recipe.name));
        !status.ok())
        return status;
    Result<ImportedMesh> imported = import_mesh(obj);
    if (!imported.ok()) return imported.error();
    if (!imported->warnings.empty()) return imported->warnings.front();
    const Result<Preset> preset = find_preset(recipe.preset);
    if (!preset.ok()) return preset.error();
    Level level;
    level.movement = preset->settings;
    level.mesh_path = obj;
    level.file_path = level_file_for(obj);
    level.mesh = imported->mesh;
    recipe.annotate(level);
    if (recipe.write_more != nullptr) {
        if (Status status = recipe.write_more(arguments.folder); !status.ok()) return status;
    }
    const Result<LightCharts> charts = light_charts(*level.mesh, level.light->texel_m);
    if (!charts.ok()) return charts.error();
    level.light->image = recipe.name + ".light.png";
    level.light->geometry = charts->geometry;
    fmt::print("{}: {} faces, {} triangles, light map {} x {}\n", recipe.name, level.mesh->face_count(),
               level.mesh->triangle_count(), charts->width, charts->height);
    const bool named = arguments.names.empty() || std::find(arguments.names.begin(), arguments.names.end(),
                                                            recipe.name) != arguments.names.end();
    return arguments.bake && named ? bake_level_light(level) : save_level(level);
}

// Bakes every n-th face of a level again.
Status check_light(const fs::path& obj) {
    const Result<LoadedLevel> loaded = load_level(obj);
    if (!loaded) return loaded.error();
    const fs::path image_path = obj.parent_path() / loaded->level.light->image;
    const Result<Image> image = load_image(image_path);
    if (!image) return image.error();
    const Result<LightBaker> baker = LightBaker::make(loaded->level);
    if (!baker) return baker.error();
    const LightCharts& charts = baker->charts();
    if (image->width != charts.width || image->height != charts.height)
        return Error{image_path.string(), "has not the size of the level's charts"};
    const std::size_t faces = charts.charts.size();
    std::size_t texels = 0;
    for (std::size_t n = 0; texels < texels_to_check && n < faces; ++n) {
        const std::size_t face = (n * 7919) % faces;
        const LightChart& chart = charts.charts[face];
        if (static_cast<std::size_t>(chart.width) * chart.height > texels_to_check / 4) continue;
        const std::vector<std::uint8_t> bytes = baker->bake_face(static_cast<FaceId>(face));
        for (std::size_t at = 0; 3 * at < bytes.size(); ++at, ++texels) {
            const std::uint8_t* pixel = image->pixel(chart.x + static_cast<int>(at % chart.width),
                                                     chart.y + static_cast<int>(at / chart.width));
            if (!std::equal(pixel, pixel + 3, &bytes[3 * at]))
                return Error{image_path.string(), fmt::format("face {} is not what the baker makes", face)};
        }
    }
    fmt::print("{}: {} texels are the same\n", image_path.filename().string(), texels);
    return {};
}

Status run(const Arguments& arguments) {
    if (!arguments.check_light) {
        if (Status status = write_textures(arguments.folder / "textures"); !status.ok()) return status;
    }
    for (const Recipe& recipe : recipes()) {
        Status status = arguments.check_light ? check_light(arguments.folder / (recipe.name + ".obj"))
                                              : write_level(recipe, arguments);
        if (!status.ok()) return status;
    }
    return {};
}

}  // namespace
}  // namespace slipface::generate

int main(int argc, char** argv) {
    try {
        slipface::generate::Arguments arguments;
        for (int i = 1; i < argc; ++i) {
            const std::string word = argv[i];
            if (word == "--bake") {
                arguments.bake = true;
            } else if (word == "--check-light") {
                arguments.check_light = true;
            } else if (arguments.folder.empty()) {
                arguments.folder = word;
            } else {
                arguments.names.push_back(word);
            }
        }
        if (arguments.folder.empty()) {
            fmt::print(stderr,
                       "usage: slipface_generate_levels [--check-light] OUT_FOLDER [--bake [NAME...]]\n");
            return 2;
        }
        const slipface::Status status = slipface::generate::run(arguments);
        if (status.ok()) return 0;
        fmt::print(stderr, "slipface_generate_levels: {}\n", status.error().text());
    } catch (const std::exception& error) {
        fmt::print(stderr, "slipface_generate_levels: {}\n", error.what());
    }
    return 1;
}
