#include "bsp/import_bsp.h"

#include <algorithm>
#include <charconv>

#include "bsp/bsp_entities.h"
#include "bsp/bsp_faces.h"
#include "bsp/bsp_file.h"
#include "bsp/bsp_walls.h"
#include "slipface/mesh/bsp_flags.h"

namespace slipface {
namespace {

constexpr double metres_per_unit = 1.0 / 32.0;

// The world, and the moving parts that the entities use. A trigger reports touches but is not a wall.
std::vector<BspModel> models_of(const BspFile& file, const std::vector<BspEntity>& entities) {
    std::vector<BspModel> models;
    if (file.models.count() > 0) models.push_back({});
    for (const BspEntity& entity : entities) {
        const std::string_view name = entity.value("model");
        if (!name.starts_with('*') || entity.class_name().starts_with("trigger_")) continue;
        std::size_t number = 0;
        const auto read = std::from_chars(name.data() + 1, name.data() + name.size(), number);
        if (read.ec != std::errc() || number == 0 || number >= file.models.count()) continue;
        models.push_back({number, entity.origin()});
    }
    // A model used by several entities is where the first one has it.
    std::stable_sort(models.begin(), models.end(),
                     [](const BspModel& a, const BspModel& b) { return a.number < b.number; });
    models.erase(std::unique(models.begin(), models.end(),
                             [](const BspModel& a, const BspModel& b) { return a.number == b.number; }),
                 models.end());
    return models;
}

Result<std::vector<Vec3>> origins_of_faces(const BspFile& file, const std::vector<BspModel>& models,
                                           const std::string& location) {
    std::vector<Vec3> origins;
    for (const BspModel& model : models) {
        if (model.number == 0 || model.origin.isZero(0.0)) continue;
        const BspRange faces = bsp_range_at(file.models.at(model.number), 24);
        if (!faces.within(file.faces.count()))
            return Error{location, fmt::format("model {} refers to missing faces", model.number)};
        origins.resize(file.faces.count(), Vec3::Zero());
        std::fill_n(origins.begin() + static_cast<std::ptrdiff_t>(faces.first), faces.count, model.origin);
    }
    return origins;
}

std::vector<FoundType> types_of(const BspFile& file, const PolygonSoup& soup) {
    std::vector<FoundType> types;
    for (std::size_t i = 0; i < soup.materials.size(); ++i) {
        const char* type = bsp_surface_type(file.surface_flags(i), file.contents(i));
        if (type != nullptr && !soup.materials[i].name.empty())
            types.push_back({soup.materials[i].name, type});
    }
    return types;
}

}  // namespace

Result<ImportedSoup> import_bsp(std::string_view bytes, const std::string& location, WarningList& warnings,
                                Progress* progress) {
    const auto file = open_bsp(bytes, location);
    if (!file) return file.error();
    const std::vector<BspEntity> entities = bsp_entities(file->entities);
    const std::vector<BspModel> models = models_of(*file, entities);
    const auto origins = origins_of_faces(*file, models, location);
    if (!origins) return origins.error();
    auto faces = read_bsp_faces(*file, *origins, location, warnings);
    if (!faces) return faces.error();
    ImportedSoup imported{.soup = std::move(faces->soup)};
    std::vector<std::uint32_t>& materials = imported.soup.face_material;
    for (std::size_t face = 0; face < materials.size(); ++face)
        if ((file->surface_flags(materials[face]) & bsp::surface_sky) != 0)
            imported.undrawn.push_back(static_cast<FaceId>(face));

    const auto walls = undrawn_walls(*file, models, faces->walls, location, progress);
    if (!walls) return walls.error();
    for (const BspWall& wall : *walls) {
        std::vector<Vec3f> corners;
        for (const Vec3& corner : wall.corners)
            corners.push_back(corner.cast<float>());
        const auto face = static_cast<FaceId>(materials.size());
        if (append_face(imported.soup, corners, std::vector<Vec2f>(corners.size(), Vec2f::Zero()),
                        wall.texture))
            imported.undrawn.push_back(face);
    }
    if (materials.empty()) return Error{location, "has no faces"};
    imported.frame = frame_of(metres_per_unit, ImportSource::guessed, "32 Quake units per metre", UpAxis::z,
                              ImportSource::declared, "Quake maps have Z up");
    imported.types = types_of(*file, imported.soup);
    imported.spawns = bsp_spawns(entities);
    return imported;
}

}  // namespace slipface
