// What depends on the player: sharp corners, slopes and steps at the limit. And what is missing.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>

#include "checks.h"
#include "slipface/mesh/texture_file.h"

namespace slipface {
namespace doctor {
namespace {

constexpr double sharpest =
    0.7853981633974483;  // radians: below 45 degrees a corner pushes back harder than 1:1
constexpr double near_limit = 0.01;

// The player, resting in the corner of faces a and b at `edge_point`, touching both. Nothing if the planes
// form no corner there that is sharper than the limit. `angle` is the free angle in sphere space.
struct Rest {
    Vec3 centre;
    double angle;
};
std::optional<Rest> rest_in_corner(const Vec3& radii, const Vec3& edge_point, const Vec3& normal_a,
                                   const Vec3& normal_b, const Vec3& beyond_b) {
    // The other face in front of this one: a valley, not a ridge.
    if (normal_a.dot(beyond_b - edge_point) <= 0.0) return std::nullopt;
    // Planes transform by the inverse transpose: normals are multiplied by the radii.
    const Vec3 a = normal_a.cwiseProduct(radii).normalized(), b = normal_b.cwiseProduct(radii).normalized();
    const double between = std::acos(std::clamp(a.dot(b), -1.0, 1.0));
    const double angle = 3.141592653589793 - between;
    if (!(angle < sharpest) || !(angle > 1e-4)) return std::nullopt;
    const Vec3 middle = (a + b).normalized();
    const Vec3 centre_sphere = edge_point.cwiseQuotient(radii) + middle / std::sin(0.5 * angle);
    return Rest{centre_sphere.cwiseProduct(radii), angle};
}

// The player touches both faces there and nothing else is in the way.
bool player_fits(const Patient& patient, const Vec3& centre, FaceId a, FaceId b) {
    const Vec3& radii = patient.level.movement.radii;
    if (overlaps_any(patient.world, 0.98 * radii, centre)) return false;
    std::array<Overlap, 64> touched;
    const std::size_t count =
        std::min(touched.size(), find_overlaps(patient.world, 1.03 * radii, centre, touched));
    const auto touches = [&](FaceId face) {
        return std::any_of(touched.begin(), touched.begin() + static_cast<std::ptrdiff_t>(count),
                           [&](const Overlap& overlap) { return overlap.face == face; });
    };
    return touches(a) && touches(b);
}

double slope_of(const Vec3& normal) {
    return std::acos(std::clamp(normal.y(), -1.0, 1.0));
}

}  // namespace

void find_acute_corners(const Patient& patient, Problems& out) {
    const Topology& topology = patient.topology;
    const Vec3& radii = patient.level.movement.radii;
    const std::size_t before = out.size();
    topology.each_edge([&](std::size_t first, std::size_t last) {
        if (last - first != 2) return;
        const FaceId a = topology.edges[first].face, b = topology.edges[first + 1].face;
        if (a == b || !patient.surface(a).solid || !patient.surface(b).solid) return;
        const Vec3 middle = 0.5 * (topology.position[topology.edges[first].from] +
                                   topology.position[topology.edges[first].to]);
        // From both sides, for the player may be behind the faces as well.
        for (const double side : {1.0, -1.0}) {
            const auto rest = rest_in_corner(radii, middle, side * topology.normal[a],
                                             side * topology.normal[b], face_centroid(patient.mesh, b));
            if (!rest || !player_fits(patient, rest->centre, a, b)) continue;
            out.push_back({ProblemKind::acute_corner, a, b, middle, 0,
                           fmt::format("Faces {} and {} meet at {} as the player sees it", a, b,
                                       degrees(rest->angle))});
            break;
        }
    });
    std::stable_sort(out.begin() + static_cast<std::ptrdiff_t>(before), out.end(),
                     [](const Problem& x, const Problem& y) { return x.face < y.face; });
}

void find_limit_slopes(const Patient& patient, Problems& out) {
    for (FaceId face = 0; face < patient.mesh.face_count(); ++face) {
        const Vec3& normal = patient.topology.normal[face];
        const SurfaceType& surface = patient.surface(face);
        if (normal.isZero() || !surface.solid || surface.sticky || surface.climbable) continue;
        const double limit = surface.max_slope.value_or(patient.level.movement.max_slope);
        const double slope = slope_of(normal);
        if (std::abs(slope - limit) <= near_limit * limit)
            out.push_back({ProblemKind::slope_limit, face, no_id, face_centroid(patient.mesh, face), 0,
                           "Rises by " + degrees(slope) + "; the limit is " + degrees(limit)});
    }
}

void find_limit_steps(const Patient& patient, Problems& out) {
    // Settings grow; a player that climbs no steps has none at the limit.
    const SettingInfo* const setting = find_setting("step_height");
    if (!setting) return;
    const double limit = get_setting(patient.level.movement, *setting);
    if (!(limit > 0.0)) return;
    const FaceNeighbours neighbours = face_neighbours(patient.mesh);
    const double walkable = std::cos(patient.level.movement.max_slope);
    for (FaceId face = 0; face < patient.mesh.face_count(); ++face) {
        if (std::abs(patient.topology.normal[face].y()) > 0.1 || !patient.surface(face).solid) continue;
        double low = std::numeric_limits<double>::infinity(), high = -low;
        for (std::uint32_t c = patient.mesh.face_first_corner[face];
             c < patient.mesh.face_first_corner[face + 1]; ++c) {
            const double y = patient.topology.position[patient.topology.vertex[c]].y();
            low = std::min(low, y);
            high = std::max(high, y);
        }
        const double height = high - low;
        if (!(std::abs(height - limit) <= near_limit * limit)) continue;
        const std::span<const FaceId> around = neighbours.of(face);
        // A step has a floor at its upper edge.
        const bool floor_above = std::any_of(around.begin(), around.end(), [&](FaceId other) {
            return patient.topology.normal[other].y() > walkable &&
                   face_centroid(patient.mesh, other).y() > low + 0.5 * height;
        });
        if (floor_above)
            out.push_back({ProblemKind::step_limit, face, no_id, face_centroid(patient.mesh, face), 0,
                           "Is " + metres(height) + " high; the limit is " + metres(limit)});
    }
}

void find_orphans(const Patient& patient, Problems& out) {
    const std::vector<Orphan>& orphans = patient.level.orphans;
    for (std::size_t i = 0; i < orphans.size(); ++i)
        out.push_back({ProblemKind::orphan, no_id, no_id, orphans[i].key.centroid, i,
                       "A painted " + orphans[i].type +
                           (orphans[i].key.material.empty() ? std::string(" without a material")
                                                            : " of material " + orphans[i].key.material)});
}

void find_missing_textures(const Patient& patient, Problems& out) {
    const Mesh& mesh = patient.mesh;
    const std::filesystem::path folder = patient.level.mesh_path.parent_path();
    std::map<std::uint32_t, FaceId> first_face;
    for (FaceId face = 0; face < mesh.face_count(); ++face)
        first_face.try_emplace(mesh.face_material[face], face);
    for (std::size_t i = 0; i < mesh.materials.size(); ++i) {
        const Material& material = mesh.materials[i];
        if (material.texture.empty() || find_texture(material.texture, folder, TextureAccess::anywhere).path)
            continue;
        const auto face = first_face.find(static_cast<std::uint32_t>(i));
        const FaceId where = face == first_face.end() ? no_id : face->second;
        out.push_back({ProblemKind::missing_texture, where, no_id,
                       where == no_id ? Vec3(Vec3::Zero()) : face_centroid(mesh, where), i,
                       "Material " + material.name + " names " + material.texture});
    }
}

}  // namespace doctor

}  // namespace slipface
