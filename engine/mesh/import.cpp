#include "slipface/mesh/import.h"

#include <algorithm>
#include <exception>
#include <utility>

#include "import_bsp.h"
#include "import_obj.h"
#include "import_scene.h"
#include "obj_text.h"
#include "slipface/base/files.h"
#include "slipface/base/hash.h"
#include "slipface/base/text.h"
#include "slipface/mesh/build.h"
#include "warning_list.h"

namespace slipface {
namespace {

std::string extension_of(const std::filesystem::path& path) {
    std::string extension = to_lower(path.extension().string());
    if (extension.starts_with('.')) extension.erase(0, 1);
    return extension;
}

Result<ImportedObj> read_soup(const std::filesystem::path& path, std::string bytes, WarningList& warnings,
                              Progress* progress) {
    if (extension_of(path) == "obj") return import_obj(path, std::move(bytes), warnings, progress);
    if (bytes.empty()) return Error{path.string(), "is empty"};
    if (extension_of(path) == "bsp") {
        auto soup = import_bsp(bytes, path.string(), warnings);
        if (!soup) return soup.error();
        return ImportedObj{std::move(*soup), false};
    }
    std::string().swap(bytes);
    auto soup = import_scene(path, warnings, progress);
    if (!soup) return soup.error();
    return ImportedObj{std::move(*soup), true};
}

// Into metres, +Y up.
void transform(PolygonSoup& soup, const ImportTransform& how) {
    if (how == ImportTransform{}) return;
    const auto scale = static_cast<float>(how.scale);
    for (std::vector<Vec3f>* positions : {&soup.corner_position, &soup.vertex_position}) {
        for (Vec3f& p : *positions) {
            if (how.up == UpAxis::z) p = Vec3f(p.x(), p.z(), -p.y());
            p *= scale;
        }
    }
}

Result<ImportedMesh> read_mesh(const std::filesystem::path& path, const ImportOptions& options) {
    const auto known = mesh_extensions();
    if (std::find(known.begin(), known.end(), extension_of(path)) == known.end()) {
        return Error{path.string(),
                     fmt::format("is no level; expected a file named *.obj, found the ending {}",
                                 in_quotes(extension_of(path)))};
    }
    begin_stage(options.progress, "Reading the file", 0.0, 0.1);
    auto bytes = read_file(path);
    if (!bytes) return bytes.error();
    ImportedMesh imported{.mesh = {}, .warnings = {}, .stamp = file_stamp(*bytes)};

    WarningList warnings(options.max_warnings);
    begin_stage(options.progress, "Reading faces", 0.1, 0.8);
    auto read = read_soup(path, std::move(*bytes), warnings, options.progress);
    if (!read) return read.error();
    begin_stage(options.progress, "Cutting faces into triangles", 0.8, 1.0);
    transform(read->soup, options.transform);
    auto mesh = build_mesh(std::move(read->soup));
    if (!mesh) return Error{path.string(), mesh.error().message};
    if (cancelled(options.progress)) return cancelled_error(path);
    imported.mesh = std::move(*mesh);
    imported.through_assimp = read->through_assimp;
    imported.warnings = warnings.take(path.string());
    return imported;
}

}  // namespace

FileStamp file_stamp(std::string_view bytes) {
    return {.size = bytes.size(), .hash = hash_blocks(bytes.data(), bytes.size())};
}

Result<ImportedMesh> import_mesh(const std::filesystem::path& path, const ImportOptions& options) {
    try {
        return read_mesh(path, options);
    } catch (const std::bad_alloc&) {
        return Error{path.string(), "needs more memory than there is"};
    } catch (const std::exception& exception) {
        return Error{path.string(), exception.what()};
    }
}

Result<ImportedMesh> import_mesh(const std::filesystem::path& path, std::size_t max_warnings) {
    ImportOptions options;
    options.max_warnings = max_warnings;
    return import_mesh(path, options);
}

}  // namespace slipface
