#include "obj/import_obj.h"

#include "obj/material_library.h"
#include "obj/obj_reader.h"
#include "obj/obj_text.h"

namespace slipface {
namespace {

void add_materials(const std::filesystem::path& path, ObjPolygons& polygons, WarningList& warnings) {
    MaterialsByName known;
    const bool any_library =
        load_libraries(path, polygons.libraries, known, polygons.soup.other_files, warnings);
    std::vector<Material>& materials = polygons.soup.materials;
    materials.reserve(polygons.materials.size());
    for (const NameOnLine& used : polygons.materials) {
        const auto found = known.find(used.name);
        materials.push_back(found != known.end() ? found->second : named_material(used.name));
        if (found == known.end() && any_library && !used.name.empty()) {
            warnings.add(
                fmt::format("{}:{}", path.string(), used.line),
                fmt::format("material {} is in no material library: grey is used", in_quotes(used.name)));
        }
    }
}

}  // namespace

Result<PolygonSoup> import_obj(const std::filesystem::path& path, std::string text, WarningList& warnings,
                               Progress* progress) {
    auto polygons = read_obj(std::move(text), path.string(), warnings, progress);
    if (cancelled(progress)) return cancelled_error(path);
    if (!polygons) return polygons.error();
    add_materials(path, *polygons, warnings);
    return std::move(polygons->soup);
}

}  // namespace slipface
