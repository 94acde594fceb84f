// A small level made by hand, for the tests of drawing.
#pragma once

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <initializer_list>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include "slipface/image/image.h"
#include "slipface/mesh/mesh.h"

namespace slipface::test {

// Gathers polygons into a Mesh; each is fanned into triangles from its first corner.
class MeshBuilder {
  public:
    MeshBuilder() {
        mesh_.groups = {""};
        mesh_.face_first_corner = {0};
        mesh_.face_first_triangle = {0};
    }

    std::uint32_t material(const std::string& name, const Vec3f& diffuse, const std::string& texture = "") {
        mesh_.materials.push_back({name, diffuse, texture});
        return static_cast<std::uint32_t>(mesh_.materials.size() - 1);
    }

    // Texture coordinates: the two axes across the polygon's main direction, one repeat a metre.
    FaceId face(const std::vector<Vec3>& corners, std::uint32_t material = 0) {
        Vec3 normal = Vec3::Zero();
        for (std::size_t i = 0; i < corners.size(); ++i) {
            normal += corners[i].cross(corners[(i + 1) % corners.size()]);
        }
        const Vec3 size = normal.cwiseAbs();
        const auto first = static_cast<std::uint32_t>(mesh_.corner_vertex.size());
        for (const Vec3& corner : corners) {
            mesh_.corner_vertex.push_back(vertex(corner));
            const Vec3f p = corner.cast<float>();
            mesh_.corner_uv.push_back(size.y() >= std::max(size.x(), size.z()) ? Vec2f(p.x(), p.z())
                                      : size.x() > size.z()                    ? Vec2f(p.z(), p.y())
                                                                               : Vec2f(p.x(), p.y()));
            mesh_.bounds.add(corner);
        }
        const auto face = static_cast<FaceId>(mesh_.face_material.size());
        for (std::uint32_t i = 2; i < corners.size(); ++i) {
            mesh_.triangles.push_back({first, first + i - 1, first + i});
            mesh_.triangle_face.push_back(face);
        }
        mesh_.face_first_corner.push_back(static_cast<std::uint32_t>(mesh_.corner_vertex.size()));
        mesh_.face_first_triangle.push_back(static_cast<std::uint32_t>(mesh_.triangles.size()));
        mesh_.face_material.push_back(material);
        mesh_.face_group.push_back(0);
        return face;
    }

    // An axis-aligned box, seen from outside. Returns its top face; the others follow as bottom, +X, -X, +Z,
    // -Z.
    FaceId box(const Vec3& a, const Vec3& b, std::uint32_t material = 0) {
        const auto p = [&](int x, int y, int z) {
            return Vec3(x != 0 ? b.x() : a.x(), y != 0 ? b.y() : a.y(), z != 0 ? b.z() : a.z());
        };
        const FaceId top = face({p(0, 1, 1), p(1, 1, 1), p(1, 1, 0), p(0, 1, 0)}, material);
        face({p(0, 0, 0), p(1, 0, 0), p(1, 0, 1), p(0, 0, 1)}, material);
        face({p(1, 0, 1), p(1, 0, 0), p(1, 1, 0), p(1, 1, 1)}, material);
        face({p(0, 0, 0), p(0, 0, 1), p(0, 1, 1), p(0, 1, 0)}, material);
        face({p(0, 0, 1), p(1, 0, 1), p(1, 1, 1), p(0, 1, 1)}, material);
        face({p(1, 0, 0), p(0, 0, 0), p(0, 1, 0), p(1, 1, 0)}, material);
        return top;
    }

    MeshPtr build() {
        if (mesh_.materials.empty()) material("", Vec3f::Constant(0.8f));
        return std::make_shared<const Mesh>(mesh_);
    }

  private:
    std::uint32_t vertex(const Vec3& position) {
        const Vec3f p = position.cast<float>();
        for (std::size_t i = 0; i < mesh_.positions.size(); ++i) {
            if (mesh_.positions[i] == p) return static_cast<std::uint32_t>(i);
        }
        mesh_.positions.push_back(p);
        return static_cast<std::uint32_t>(mesh_.positions.size() - 1);
    }

    Mesh mesh_;
};

// A courtyard with a ramp, stairs, pillars, a half-pipe and a wall that is seen from behind. `painted` lists
// faces with surface types 1 to 7, in this order.
struct Courtyard {
    MeshPtr mesh;
    std::vector<FaceId> painted;
};

inline Courtyard make_courtyard(const std::string& floor_texture = "", const std::string& wall_texture = "") {
    MeshBuilder b;
    const auto floor = b.material("floor", {0.55f, 0.56f, 0.52f}, floor_texture);
    const auto wall = b.material("wall", {0.66f, 0.52f, 0.42f}, wall_texture);
    const auto stone = b.material("stone", {0.50f, 0.55f, 0.62f});
    Courtyard yard;
    std::vector<FaceId> tiles;
    for (int z = -3; z < 3; ++z) {
        for (int x = -4; x < 4; ++x) {
            const double x0 = 3.0 * x, z0 = 3.0 * z;
            tiles.push_back(
                b.face({{x0, 0, z0 + 3}, {x0 + 3, 0, z0 + 3}, {x0 + 3, 0, z0}, {x0, 0, z0}}, floor));
        }
    }
    b.face({{-12, 0, -9}, {12, 0, -9}, {12, 4, -9}, {-12, 4, -9}}, wall);
    const FaceId left = b.face({{-12, 0, 9}, {-12, 0, -9}, {-12, 4, -9}, {-12, 4, 9}}, wall);
    b.face({{12, 0, 9}, {12, 0, 2}, {12, 2.5, 2}, {12, 2.5, 9}}, wall);
    const FaceId ramp = b.face({{-9, 0, -2}, {-3, 3, -2}, {-3, 3, -5}, {-9, 0, -5}}, stone);
    b.face({{-9, 0, -2}, {-3, 0, -2}, {-3, 3, -2}}, stone);
    b.face({{-3, 0, -5}, {-9, 0, -5}, {-3, 3, -5}}, stone);
    const FaceId deck = b.box({-3, 2.6, -5}, {2, 3, -2}, stone);
    for (int i = 0; i < 8; ++i)
        b.box({2.0 + 0.5 * i, 0, -5}, {2.5 + 0.5 * i, 3.0 - 0.375 * i, -2}, stone);
    const FaceId pillar = b.box({-7, 0, 3}, {-5.5, 3.5, 4.5}, wall);
    b.box({-2, 0, 4}, {-1, 1.0, 5}, stone);
    const FaceId crate = b.box({0.5, 0, 3.5}, {2.0, 1.5, 5.0}, wall);
    std::vector<FaceId> pipe;
    for (int i = 0; i < 10; ++i) {
        const double a0 = std::numbers::pi * i / 10, a1 = std::numbers::pi * (i + 1) / 10;
        const auto at = [](double a, double z) {
            return Vec3(8.0 - 2.2 * std::cos(a), 2.4 - 2.2 * std::sin(a), z);
        };
        pipe.push_back(b.face({at(a0, 8), at(a1, 8), at(a1, 3), at(a0, 3)}, stone));
    }
    yard.painted = {ramp, pillar + 4, deck, crate, tiles[17], tiles[27], tiles[20]};
    for (const FaceId face : pipe)
        yard.painted.push_back(face);
    (void)left;
    yard.mesh = b.build();
    return yard;
}

// Ice on the first, ladder on the second, and so on; ice on the half-pipe.
inline std::vector<SurfaceId> courtyard_surfaces(const Courtyard& yard) {
    std::vector<SurfaceId> surfaces(yard.mesh->face_count(), 0);
    for (std::size_t i = 0; i < yard.painted.size(); ++i) {
        surfaces[yard.painted[i]] = i < 7 ? static_cast<SurfaceId>(i + 1) : SurfaceId{1};
    }
    return surfaces;
}

// Tiles with seams and some variation; a texture that shows scale and direction.
inline Image tile_texture(int side, std::uint8_t red, std::uint8_t green, std::uint8_t blue) {
    Image image = make_image(side, side, red, green, blue);
    std::uint32_t random = 12345;
    for (int y = 0; y < side; ++y) {
        for (int x = 0; x < side; ++x) {
            random = random * 1664525U + 1013904223U;
            const int noise = static_cast<int>(random >> 28U) - 8;
            const int edge = std::min({x, y, side - 1 - x, side - 1 - y});
            const int seam = edge < 2 ? -40 : edge < 4 ? 14 : 0;
            std::uint8_t* pixel = image.pixel(x, y);
            for (int channel = 0; channel < 3; ++channel) {
                pixel[channel] = static_cast<std::uint8_t>(std::clamp(pixel[channel] + noise + seam, 0, 255));
            }
        }
    }
    return image;
}

}  // namespace slipface::test
