#include "easy_level.h"

#include <limits>
#include <string>

#include "easy.h"
#include "slipface/level/level_file.h"
#include "slipface/mesh/import.h"

namespace slipface::generate {
namespace {

// The face nearest to `point` of those whose material is `material`.
FaceId face_at(const Mesh& mesh, const Vec3& point, const std::string& material) {
    FaceId best = no_id;
    double best_distance = std::numeric_limits<double>::infinity();
    for (FaceId face = 0; face < mesh.face_count(); ++face) {
        if (mesh.materials[mesh.face_material[face]].name != material) continue;
        const double distance = (face_centroid(mesh, face) - point).squaredNorm();
        if (distance >= best_distance) continue;
        best = face;
        best_distance = distance;
    }
    return best;
}

void set_surfaces(Level& level) {
    for (SurfaceType& surface : level.surfaces) {
        if (surface.name == "turntable") surface.spin_centre = Vec3(0, -1.8, -12.75);
        if (surface.name == "bouncy") surface.restitution = 0.9;
    }
    level.surfaces.push_back({.name = "foliage",
                              .color = {0.47f, 0.67f, 0.19f},
                              .hatch = Hatch::dots,
                              .hotkey = 9,
                              .solid = false});
    level.rules = {
        {"ice*", "ice"},       {"ladder*", "ladder"},     {"sticky*", "sticky"},
        {"bouncy*", "bouncy"}, {"conveyor*", "conveyor"}, {"turntable*", "turntable"},
        {"hazard*", "hazard"}, {"foliage*", "foliage"},
    };
}

// What a rule by material cannot say: one iced ramp, one sticky ramp, a way of bouncy tiles, and a pedestal
// that throws.
void paint_faces(Level& level) {
    struct Painted {
        Vec3 point;
        const char* material;
        const char* surface;
    };
    const Painted painted[] = {
        {{-45, 0, 4.3}, "ramp_stone", "ice"},         // 15 degrees
        {{-47, 0.5, -8.7}, "ramp_stone", "ice"},      // 40 degrees
        {{-48, 0.5, -19.1}, "ramp_steep", "sticky"},  // 60 degrees
        {{0, 0.6, -31}, "tile_teal", "bouncy"},       // the crystal's plinth
        {{-21, -1, -21}, "test_floor", "bouncy"},    {{-23, -1, -21}, "test_floor", "ice"},
        {{12.75, -1, -15.25}, "stone_floor", "ice"},  // beside the pit
        {{12.75, -1, -17.75}, "stone_floor", "ice"}, {{12.75, -1, -20.25}, "stone_floor", "ice"},
    };
    level.overrides.assign(level.mesh->face_count(), std::nullopt);
    for (const Painted& entry : painted) {
        const FaceId face = face_at(*level.mesh, entry.point, entry.material);
        if (face != no_id) level.overrides[face] = find_surface(level, entry.surface);
    }
}

}  // namespace

Status write_easy_level(const std::filesystem::path& obj) {
    Result<ImportedMesh> imported = import_mesh(obj);
    if (!imported.ok()) return imported.error();
    if (!imported->warnings.empty()) return imported->warnings.front();
    Level level;
    level.mesh_path = obj;
    level.file_path = level_file_for(obj);
    level.mesh = imported->mesh;
    set_surfaces(level);
    paint_faces(level);
    level.cameras = {
        {.name = "overview", .eye = {-5.2, 6.4, 10.2}, .target = {1.6, 1.2, -14}, .fov_y = 1.15},
        {.name = "hall", .eye = {0, 0.7, 9.4}, .target = {0, 2.2, -29}},
        {.name = "pool", .eye = {4.6, 1.6, -3.4}, .target = {-2.4, -1.6, -14.5}},
        {.name = "gallery", .eye = {9.4, 5.6, 2.5}, .target = {2.0, 3.4, -20}},
        {.name = "garden", .eye = {8.2, 0.9, 5.2}, .target = {11.6, -0.2, 9.4}},
        {.name = "pit", .eye = {12.4, 0.9, -10.4}, .target = {10.2, -1.6, -19}},
        {.name = "test-room", .eye = {-19.4, 4.6, 8.2}, .target = {-39, -1.6, -15}, .fov_y = 1.2},
        {.name = "half-pipe", .eye = {-37.2, 0.6, -11.4}, .target = {-28, -3.2, -16.6}},
    };
    return save_level(level);
}

}  // namespace slipface::generate
