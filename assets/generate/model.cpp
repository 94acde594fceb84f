#include "model.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <utility>

namespace slipface::generate {
namespace {

std::int64_t to_grid(double value) {
    return static_cast<std::int64_t>(std::llround(value * grid_per_unit));
}

Vec3 newell_normal(const std::vector<Vec3>& corners) {
    Vec3 sum = Vec3::Zero();
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const Vec3 a = corners[i] - corners[0];
        const Vec3 b = corners[(i + 1) % corners.size()] - corners[0];
        sum += a.cross(b);
    }
    return sum.normalized();
}

// Floors and ceilings are mapped from above; anything else keeps v upright along the steepest line of its
// plane.
Vec2 project_uv(const Vec3& position, const Vec3& normal) {
    if (std::abs(normal.y()) > 0.999) return {position.x(), -position.z()};
    const Vec3 along = Vec3(normal.z(), 0, -normal.x()).normalized();
    const Vec3 upward = normal.cross(along);
    return {position.dot(along), position.dot(upward)};
}

using Grid3 = Model::Grid3;

std::int64_t dot(const Grid3& a, const Grid3& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
Grid3 difference(const Grid3& a, const Grid3& b) {
    return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
bool parallel(const Grid3& a, const Grid3& b) {
    return a[1] * b[2] == a[2] * b[1] && a[2] * b[0] == a[0] * b[2] && a[0] * b[1] == a[1] * b[0];
}

}  // namespace

double cos_deg(double degrees) {
    return std::round(std::cos(degrees * std::numbers::pi / 180.0) * 1e12) / 1e12;
}
double sin_deg(double degrees) {
    return std::round(std::sin(degrees * std::numbers::pi / 180.0) * 1e12) / 1e12;
}
double tan_deg(double degrees) {
    return sin_deg(degrees) / cos_deg(degrees);
}

Model::Model(std::vector<ModelMaterial> materials) : materials_(std::move(materials)) {
    for (std::size_t i = 0; i < materials_.size(); ++i)
        material_index_[materials_[i].name] = i;
}

void Model::begin_group(std::string name) {
    groups_.push_back(std::move(name));
}

std::size_t Model::add_position(const Vec3& position) {
    const Grid3 key{to_grid(position.x()), to_grid(position.y()), to_grid(position.z())};
    const auto [entry, added] = position_index_.try_emplace(key, positions_.size());
    if (added) positions_.push_back(key);
    return entry->second;
}

std::size_t Model::add_uv(const Vec2& uv) {
    const Grid2 key{to_grid(uv.x()), to_grid(uv.y())};
    const auto [entry, added] = uv_index_.try_emplace(key, uvs_.size());
    if (added) uvs_.push_back(key);
    return entry->second;
}

void Model::face(const std::string& material, std::vector<Vec3> corners) {
    const double scale = materials_.at(material_index_.at(material)).metres_per_tile;
    std::vector<Vec3> world = corners;
    if (mirror_) {
        for (Vec3& corner : world)
            corner.x() = -corner.x();
        std::reverse(world.begin(), world.end());
    }
    const Vec3 normal = newell_normal(world);
    std::vector<Corner> mapped;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const std::size_t source = mirror_ ? corners.size() - 1 - i : i;
        mapped.push_back({corners[i], project_uv(world[source], normal) / scale});
    }
    face_uv(material, std::move(mapped));
}

void Model::face_uv(const std::string& material, std::vector<Corner> corners) {
    if (mirror_) {
        for (Corner& corner : corners)
            corner.position.x() = -corner.position.x();
        std::reverse(corners.begin(), corners.end());
    }
    ModelFace face;
    face.material = material_index_.at(material);
    face.group = groups_.size() - 1;
    for (const Corner& corner : corners) {
        const std::size_t vertex = add_position(corner.position);
        if (!face.vertices.empty() && face.vertices.back() == vertex) continue;
        face.vertices.push_back(vertex);
        face.uvs.push_back(add_uv(corner.uv));
    }
    if (face.vertices.size() > 1 && face.vertices.front() == face.vertices.back()) {
        face.vertices.pop_back();
        face.uvs.pop_back();
    }
    if (face.vertices.size() < 3) throw std::logic_error("a face of " + material + " has no area");
    faces_.push_back(std::move(face));
}

void Model::join_edges() {
    // Vertices sorted by position: the candidates of an edge are found in the x range that it covers.
    std::vector<std::size_t> by_position(positions_.size());
    for (std::size_t i = 0; i < by_position.size(); ++i)
        by_position[i] = i;
    std::sort(by_position.begin(), by_position.end(),
              [&](std::size_t a, std::size_t b) { return positions_[a] < positions_[b]; });

    for (ModelFace& face : faces_) {
        ModelFace joined{face.material, face.group, {}, {}};
        for (std::size_t i = 0; i < face.vertices.size(); ++i) {
            const std::size_t next = (i + 1) % face.vertices.size();
            const Grid3& from = positions_[face.vertices[i]];
            const Grid3& to = positions_[face.vertices[next]];
            const Grid3 edge = difference(to, from);
            joined.vertices.push_back(face.vertices[i]);
            joined.uvs.push_back(face.uvs[i]);
            std::vector<std::pair<std::int64_t, std::size_t>> between;
            const Grid3 lowest{std::min(from[0], to[0]), INT64_MIN, INT64_MIN};
            auto candidate =
                std::lower_bound(by_position.begin(), by_position.end(), lowest,
                                 [&](std::size_t a, const Grid3& key) { return positions_[a] < key; });
            for (; candidate != by_position.end() && positions_[*candidate][0] <= std::max(from[0], to[0]);
                 ++candidate) {
                const Grid3 offset = difference(positions_[*candidate], from);
                const std::int64_t along = dot(offset, edge);
                if (along > 0 && along < dot(edge, edge) && parallel(offset, edge))
                    between.emplace_back(along, *candidate);
            }
            std::sort(between.begin(), between.end());
            const Grid2 uv_from = uvs_[face.uvs[i]];
            const Grid2 uv_to = uvs_[face.uvs[next]];
            for (const auto& [along, vertex] : between) {
                const double fraction = static_cast<double>(along) / static_cast<double>(dot(edge, edge));
                const Vec2 a(static_cast<double>(uv_from[0]), static_cast<double>(uv_from[1]));
                const Vec2 b(static_cast<double>(uv_to[0]), static_cast<double>(uv_to[1]));
                joined.vertices.push_back(vertex);
                joined.uvs.push_back(add_uv((a + fraction * (b - a)) / grid_per_unit));
            }
        }
        face = std::move(joined);
    }
}

}  // namespace slipface::generate
