#include "slipface/mesh/import.h"

#include <exception>
#include <utility>

#include "import_obj.h"
#include "import_scene.h"
#include "obj_text.h"
#include "slipface/base/files.h"
#include "slipface/base/text.h"
#include "slipface/mesh/build.h"
#include "warning_list.h"

namespace slipface {
namespace {

Result<PolygonSoup> read_soup(const std::filesystem::path& path, WarningList& warnings) {
    std::string extension = to_lower(path.extension().string());
    if (extension.starts_with('.')) extension.erase(0, 1);
    if (extension != "obj" && !scene_extension(extension)) {
        return Error{path.string(),
                     fmt::format("is no level; expected a file named *.obj, found the ending {}",
                                 in_quotes(extension))};
    }
    auto bytes = read_file(path);
    if (!bytes) return bytes.error();
    if (extension == "obj") return import_obj(path, std::move(*bytes), warnings);
    if (bytes->empty()) return Error{path.string(), "is empty"};
    std::string().swap(*bytes);
    return import_scene(path, warnings);
}

Result<ImportedMesh> read_mesh(const std::filesystem::path& path, std::size_t max_warnings) {
    WarningList warnings(max_warnings);
    auto soup = read_soup(path, warnings);
    if (!soup) return soup.error();
    auto mesh = build_mesh(std::move(*soup));
    if (!mesh) return Error{path.string(), mesh.error().message};
    return ImportedMesh{.mesh = std::move(*mesh), .warnings = warnings.take(path.string())};
}

}  // namespace

Result<ImportedMesh> import_mesh(const std::filesystem::path& path, std::size_t max_warnings) {
    try {
        return read_mesh(path, max_warnings);
    } catch (const std::bad_alloc&) {
        return Error{path.string(), "needs more memory than there is"};
    } catch (const std::exception& exception) {
        return Error{path.string(), exception.what()};
    }
}

}  // namespace slipface
