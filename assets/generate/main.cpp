// slipface_generate_levels OUT_FOLDER: writes the shipped levels and their textures, the same bytes at every
// run.
#include <fmt/format.h>

#include <exception>
#include <filesystem>

#include "easy.h"
#include "easy_level.h"
#include "obj_writer.h"
#include "slipface/base/files.h"
#include "slipface/image/image.h"
#include "textures.h"

namespace slipface::generate {
namespace {

Status write_textures(const std::filesystem::path& folder) {
    std::error_code failed;
    std::filesystem::create_directories(folder, failed);
    if (failed) return Error{folder.string(), failed.message()};
    for (const auto& textures :
         {stone_textures(), ornament_textures(), nature_textures(), surface_textures()}) {
        for (const Texture& texture : textures) {
            const Status status = save_png(folder / (texture.name + ".png"), texture.paint());
            if (!status.ok()) return status;
        }
    }
    return {};
}

Status write_easy(const std::filesystem::path& folder) {
    const Model model = make_easy();
    const std::filesystem::path obj = folder / "easy.obj";
    if (Status status = write_file_atomic(obj, obj_text(model, "easy", "easy.mtl")); !status.ok())
        return status;
    if (Status status = write_file_atomic(folder / "easy.mtl", mtl_text(model, "easy")); !status.ok())
        return status;
    std::size_t triangles = 0;
    for (const ModelFace& face : model.faces())
        triangles += face.vertices.size() - 2;
    fmt::print("easy: {} faces, {} triangles, {} vertices\n", model.faces().size(), triangles,
               model.positions().size());
    return write_easy_level(obj);
}

Status write_all(const std::filesystem::path& folder) {
    if (Status status = write_textures(folder / "textures"); !status.ok()) return status;
    return write_easy(folder);
}

}  // namespace
}  // namespace slipface::generate

int main(int argc, char** argv) {
    if (argc != 2) {
        fmt::print(stderr, "usage: slipface_generate_levels OUT_FOLDER\n");
        return 2;
    }
    try {
        const slipface::Status status = slipface::generate::write_all(argv[1]);
        if (status.ok()) return 0;
        fmt::print(stderr, "slipface_generate_levels: {}\n", status.error().text());
    } catch (const std::exception& error) {
        fmt::print(stderr, "slipface_generate_levels: {}\n", error.what());
    }
    return 1;
}
