#include "recipes.h"

#include <array>
#include <limits>

#include "easy.h"
#include "hard.h"
#include "island.h"
#include "playground.h"

namespace slipface::generate {
namespace {

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

}  // namespace

std::span<const Recipe> recipes() {
    static const std::array<Recipe, 4> all{
        {{"easy", "platformer", make_easy, annotate_easy, nullptr},
         {"hard", "platformer", make_hard, annotate_hard, nullptr},
         {"island", "platformer", make_island, annotate_island, write_island_heights},
         {"playground", "platformer", make_playground, annotate_playground, nullptr}}};
    return all;
}

void add_common_rules(Level& level) {
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

void paint_faces(Level& level, std::span<const PaintedFace> faces) {
    level.overrides.assign(level.mesh->face_count(), std::nullopt);
    for (const PaintedFace& entry : faces) {
        const FaceId face = face_at(*level.mesh, entry.point, entry.material);
        if (face != no_id) level.overrides[face] = find_surface(level, entry.surface);
    }
}

}  // namespace slipface::generate
