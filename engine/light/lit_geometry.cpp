#include "lit_geometry.h"

#include <algorithm>

#include "slipface/image/image.h"
#include "slipface/mesh/texture_file.h"

namespace slipface {
namespace {

constexpr double lift = 0.01;   // metres in front of a face
constexpr double inset = 0.03;  // metres from its border

Vec3 squared(const Vec3& color) {
    return color.cwiseProduct(color);
}

Result<Image> material_image(const Material& material, const std::filesystem::path& folder) {
    const Result<TextureBytes> read = read_texture(material, folder);
    return read ? decode_image(read->bytes, read->location) : Result<Image>(read.error());
}

// The mean colour of a material's texture, linear; the material's own colour if there is no texture.
Vec3 mean_color(const Material& material, const std::filesystem::path& folder) {
    const Vec3 own = squared(material.diffuse.cast<double>());
    if (material.texture.empty()) return own;
    const Result<Image> image = material_image(material, folder);
    if (!image) return own;
    Vec3 sum = Vec3::Zero();
    for (std::size_t i = 0; i < image->pixel_count(); ++i) {
        const std::uint8_t* pixel = &image->rgba[4 * i];
        sum += squared(Vec3(pixel[0], pixel[1], pixel[2]) / 255.0);
    }
    return sum / static_cast<double>(image->pixel_count());
}

// Moving platforms cast no shadow, because the shadow would not move with them.
Result<CollisionWorld> light_collision(const Level& level) {
    const Mesh& mesh = *level.mesh;
    std::vector<bool> moves(mesh.groups.size());
    for (const Platform& platform : level.platforms) {
        for (std::size_t group = 0; group < moves.size(); ++group)
            moves[group] = moves[group] || mesh.groups[group] == platform.group;
    }
    std::vector<std::array<std::uint32_t, 3>> triangles;
    std::vector<FaceId> faces;
    triangles.reserve(mesh.triangle_count());
    faces.reserve(mesh.triangle_count());
    for (TriangleId t = 0; t < mesh.triangle_count(); ++t) {
        const auto& corners = mesh.triangles[t];
        if (moves[mesh.face_group[mesh.triangle_face[t]]]) continue;
        triangles.push_back(
            {mesh.corner_vertex[corners[0]], mesh.corner_vertex[corners[1]], mesh.corner_vertex[corners[2]]});
        faces.push_back(mesh.triangle_face[t]);
    }
    return CollisionWorld::build({mesh.positions, triangles, faces});
}

LightEmitter material_emitter(const LevelLight& light, const Material& material) {
    LightEmitter found{.pattern = {}, .color = Vec3::Zero(), .window = false};
    for (const LightEmitter& emitter : light.emitters) {
        if (material_matches(emitter.pattern, material.name)) found = emitter;
    }
    return found;
}

// The point of triangle abc nearest to p. Source: Ericson, Real-Time Collision Detection, 5.1.5.
Vec3 nearest_in_triangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
    const Vec3 ab = b - a, ac = c - a, ap = p - a;
    const double d1 = ab.dot(ap), d2 = ac.dot(ap);
    if (d1 <= 0.0 && d2 <= 0.0) return a;
    const double d3 = ab.dot(p - b), d4 = ac.dot(p - b);
    if (d3 >= 0.0 && d4 <= d3) return b;
    if (const double vc = d1 * d4 - d3 * d2; vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0)
        return a + d1 / (d1 - d3) * ab;
    const double d5 = ab.dot(p - c), d6 = ac.dot(p - c);
    if (d6 >= 0.0 && d5 <= d6) return c;
    if (const double vb = d5 * d2 - d1 * d6; vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0)
        return a + d2 / (d2 - d6) * ac;
    if (const double va = d3 * d6 - d5 * d4; va <= 0.0 && d4 - d3 >= 0.0 && d5 - d6 >= 0.0)
        return b + (d4 - d3) / ((d4 - d3) + (d5 - d6)) * (c - b);
    const double va = d3 * d6 - d5 * d4, vb = d5 * d2 - d1 * d6, vc = d1 * d4 - d3 * d2;
    const double sum = va + vb + vc;
    return sum > 0.0 ? Vec3(a + ab * (vb / sum) + ac * (vc / sum)) : a;
}

}  // namespace

Vec3 LitGeometry::sky(const Vec3& direction) const {
    const double height = std::clamp(direction.y(), 0.0, 1.0);
    return light.sky_horizon + (light.sky_zenith - light.sky_horizon) * (height * (2.0 - height));
}

Result<LitGeometry> make_lit_geometry(const Level& level) {
    const std::string location = level.file_path.string();
    if (!level.mesh || level.mesh.triangle_count() == 0) return Error{location, "has no geometry to light"};
    if (!level.light) return Error{location + ":/light", "found nothing, expected what to bake from"};
    LitGeometry lit;
    lit.mesh = level.mesh;
    lit.light = *level.light;
    const double length = lit.light.sun_direction.norm();
    if (lit.light.sun_color.maxCoeff() > 0.0 && length > 0.0) lit.sun = lit.light.sun_direction / length;
    lit.open = lit.light.sky_zenith.maxCoeff() > 0.0 || lit.light.sky_horizon.maxCoeff() > 0.0;
    Result<CollisionWorld> world = light_collision(level);
    if (!world) return world.error();
    lit.world = std::move(*world);
    Result<LightCharts> charts = light_charts(*level.mesh, lit.light.texel_m);
    if (!charts) return charts.error();
    lit.charts = std::move(*charts);
    for (const Material& material : level.mesh->materials) {
        lit.albedo.push_back(mean_color(material, level.mesh_path.parent_path()));
        const LightEmitter emitter = material_emitter(lit.light, material);
        lit.emission.push_back(emitter.color);
        lit.window.push_back(emitter.window);
    }
    for (FaceId face = 0; face < level.mesh.face_count(); ++face) {
        lit.normal.push_back(face_normal(*level.mesh, face));
        if (!lit.glows(face) || lit.normal.back().squaredNorm() < 0.5) continue;
        const Vec3 front = face_centroid(*level.mesh, face) + 2.0 * lift * lit.normal.back();
        lit.emitters.push_back({front, lit.normal.back(), lit.emission[level.mesh->face_material[face]],
                                face_area(*level.mesh, face), face});
    }
    return lit;
}

Vec3 point_on_face(const LitGeometry& lit, FaceId face, const Vec3& position) {
    const Mesh& mesh = *lit.mesh;
    Vec3 best = position;
    double best_distance = std::numeric_limits<double>::infinity();
    for (TriangleId t = mesh.face_first_triangle[face]; t < mesh.face_first_triangle[face + 1]; ++t) {
        std::array<Vec3, 3> corner;
        for (std::size_t i = 0; i < 3; ++i)
            corner[i] = mesh.corner_position(mesh.triangles[t][i]).cast<double>();
        const double a = (corner[2] - corner[1]).norm(), b = (corner[0] - corner[2]).norm(),
                     c = (corner[1] - corner[0]).norm();
        const double round = a + b + c;
        const double twice_area = (corner[1] - corner[0]).cross(corner[2] - corner[0]).norm();
        if (!(twice_area > 0.0)) continue;
        // Moves towards the centre of the inscribed circle, so that every side moves in by `inset`.
        const Vec3 incentre = (a * corner[0] + b * corner[1] + c * corner[2]) / round;
        const double fraction = std::min(0.6, inset * round / twice_area);
        for (Vec3& at : corner)
            at += fraction * (incentre - at);
        const Vec3 nearest = nearest_in_triangle(position, corner[0], corner[1], corner[2]);
        const double distance = (nearest - position).squaredNorm();
        if (distance >= best_distance) continue;
        best = nearest;
        best_distance = distance;
    }
    return best + lift * lit.normal[face];
}

}  // namespace slipface
