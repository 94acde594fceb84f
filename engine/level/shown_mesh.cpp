#include "slipface/level/shown_mesh.h"

#include <algorithm>

#include "slipface/mesh/build.h"

namespace slipface {

namespace {

PolygonSoup soup_of(const Mesh& mesh) {
    PolygonSoup soup;
    soup.corner_position.reserve(mesh.corner_vertex.size());
    for (const std::uint32_t vertex : mesh.corner_vertex)
        soup.corner_position.push_back(mesh.positions[vertex]);
    soup.corner_uv = mesh.corner_uv;
    soup.face_first_corner = mesh.face_first_corner;
    soup.face_material = mesh.face_material;
    soup.face_group = mesh.face_group;
    soup.materials = mesh.materials;
    soup.groups = mesh.groups;
    return soup;
}

void append_triangle(PolygonSoup& soup, const std::array<Vec3, 3>& corners, std::uint32_t material,
                     std::uint32_t group) {
    for (const Vec3& corner : corners) {
        soup.corner_position.push_back(corner.cast<float>());
        soup.corner_uv.push_back(Vec2f::Zero());
    }
    soup.face_first_corner.push_back(static_cast<std::uint32_t>(soup.corner_position.size()));
    soup.face_material.push_back(material);
    soup.face_group.push_back(group);
}

}  // namespace

MeshPtr shown_mesh(const Level& level, bool with_props) {
    const MeshPtr& faces = with_props ? level.mesh.whole() : level.mesh.own();
    if (!faces || !level.terrain) return faces;
    const Heightfield& field = *level.terrain;
    PolygonSoup soup = soup_of(*faces);
    const auto material = static_cast<std::uint32_t>(soup.materials.size());
    const auto group = static_cast<std::uint32_t>(soup.groups.size());
    soup.materials.push_back({.name = "terrain", .diffuse = {0.56F, 0.60F, 0.45F}, .texture = {}});
    soup.groups.emplace_back("terrain");
    // Cells are split into triangles as in terrain_at().
    for (int row = 0; row + 1 < field.rows; ++row) {
        for (int column = 0; column + 1 < field.columns; ++column) {
            const Vec3 near = field.corner(column, row), far = field.corner(column + 1, row + 1);
            append_triangle(soup, {near, far, field.corner(column + 1, row)}, material, group);
            append_triangle(soup, {near, field.corner(column, row + 1), far}, material, group);
        }
    }
    Result<MeshPtr> mesh = build_mesh(std::move(soup));
    return mesh ? *mesh : faces;
}

std::vector<std::uint32_t> face_platforms(const Level& level) {
    std::vector<std::uint32_t> platforms;
    if (!level.mesh || level.platforms.empty()) return platforms;
    if (std::none_of(level.platforms.begin(), level.platforms.end(),
                     [&](const Platform& platform) { return has_group(level, platform.group); }))
        return platforms;
    const Mesh& mesh = *level.mesh;
    // [group] the first platform with this group.
    std::vector<std::uint32_t> by_group(mesh.groups.size(), no_id);
    for (std::size_t i = level.platforms.size(); i-- > 0;) {
        for (std::size_t group = 0; group < mesh.groups.size(); ++group) {
            if (mesh.groups[group] == level.platforms[i].group)
                by_group[group] = static_cast<std::uint32_t>(i);
        }
    }
    for (const std::uint32_t group : mesh.face_group)
        platforms.push_back(by_group[group]);
    const bool moves =
        std::any_of(platforms.begin(), platforms.end(), [](std::uint32_t p) { return p != no_id; });
    if (!moves) platforms.clear();
    return platforms;
}

std::vector<Pose> platform_poses(const Level& level, double time_s) {
    std::vector<Pose> poses;
    for (const Platform& platform : level.platforms)
        poses.push_back(platform_pose(platform, time_s));
    return poses;
}

std::map<std::uint32_t, Pose> prop_poses(const Level& level, std::span<const std::uint32_t> face_platforms,
                                         std::span<const Pose> platform_poses) {
    std::map<std::uint32_t, Pose> poses;
    if (!has_instances(level)) return poses;
    for (std::uint32_t i = 0; i < level.props.size(); ++i) {
        const FaceId first = level.placed.first_face[i];
        if (first == level.placed.first_face[i + 1] || first >= face_platforms.size()) continue;
        if (face_platforms[first] < platform_poses.size()) poses[i] = platform_poses[face_platforms[first]];
    }
    return poses;
}

bool has_animated_props(const Level& level) {
    return has_instances(level) && std::any_of(level.props.begin(), level.props.end(),
                                               [](const Prop& prop) { return prop.animation.moves(); });
}

}  // namespace slipface
