// Small meshes for the level tests, and what modelling tools do to them.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <numeric>
#include <random>
#include <string>
#include <vector>

#include "slipface/level/level_file.h"
#include "slipface/mesh/build.h"

namespace slipface::test {

struct Face {
    std::vector<Vec3f> corners;
    std::string material = "stone";
    int painted = -1;  // the surface that a test gives it; -1: unset
    std::string object = {};
};

using Faces = std::vector<Face>;

inline MeshPtr mesh_of(const Faces& faces) {
    PolygonSoup soup;
    soup.face_first_corner.push_back(0);
    for (const Face& face : faces) {
        soup.corner_position.insert(soup.corner_position.end(), face.corners.begin(), face.corners.end());
        soup.face_first_corner.push_back(static_cast<std::uint32_t>(soup.corner_position.size()));
        std::size_t material = 0;
        while (material < soup.materials.size() && soup.materials[material].name != face.material)
            ++material;
        if (material == soup.materials.size()) {
            Material added;
            added.name = face.material;
            soup.materials.push_back(added);
        }
        soup.face_material.push_back(static_cast<std::uint32_t>(material));
        const auto object = std::find(soup.groups.begin(), soup.groups.end(), face.object);
        soup.face_group.push_back(static_cast<std::uint32_t>(object - soup.groups.begin()));
        if (object == soup.groups.end()) soup.groups.push_back(face.object);
    }
    Result<MeshPtr> mesh = build_mesh(std::move(soup));
    if (!mesh) {
        ADD_FAILURE() << mesh.error().text();
        return nullptr;
    }
    return *mesh;
}

inline Level level_of(const Faces& faces) {
    Level level;
    level.mesh_path = "folder/test.obj";
    level.file_path = "folder/test.slipface.json";
    level.mesh = mesh_of(faces);
    for (const Face& face : faces) {
        level.overrides.push_back(face.painted < 0
                                      ? std::optional<SurfaceId>()
                                      : std::optional<SurfaceId>(static_cast<SurfaceId>(face.painted)));
    }
    return level;
}

// What was painted on `before`, found again on `after`.
inline LoadedLevel rematch(const Faces& before, const Faces& after) {
    Result<LoadedLevel> loaded =
        level_from_json(level_to_json(level_of(before)), "test.slipface.json", mesh_of(after));
    if (!loaded) {
        ADD_FAILURE() << loaded.error().text();
        return {};
    }
    return std::move(*loaded);
}

// The faces of `faces` whose override after loading is not what Face::painted says.
inline std::vector<std::size_t> wrong_faces(const Faces& faces, const LoadedLevel& loaded) {
    std::vector<std::size_t> wrong;
    for (std::size_t i = 0; i < faces.size(); ++i) {
        const auto& found = loaded.level.overrides.at(i);
        if ((found ? int{*found} : -1) != faces[i].painted) wrong.push_back(i);
    }
    return wrong;
}

inline Face quad(Vec3f a, Vec3f b, Vec3f c, Vec3f d) {
    return {{a, b, c, d}};
}

// n x n tiles of one metre in the plane y = height, facing up, with corners at coordinates that no decimal
// hits.
inline Faces tiles(int n, float height = 0.1f) {
    Faces faces;
    const auto at = [&](int x, int z) {
        return Vec3f(static_cast<float>(x) * 1.0000137f + 0.333333f, height,
                     static_cast<float>(z) * 0.9999871f - 7.77777f);
    };
    for (int z = 0; z < n; ++z) {
        for (int x = 0; x < n; ++x)
            faces.push_back(quad(at(x, z), at(x, z + 1), at(x + 1, z + 1), at(x + 1, z)));
    }
    return faces;
}

// A face moved by `out`, and the sides that a tool puts between.
inline void extrude(Faces& faces, std::size_t face, const Vec3f& out) {
    const std::vector<Vec3f> base = faces[face].corners;
    for (Vec3f& corner : faces[face].corners)
        corner += out;
    for (std::size_t c = 0; c < base.size(); ++c) {
        const std::size_t next = (c + 1) % base.size();
        faces.push_back(quad(base[c], base[next], base[next] + out, base[c] + out));
    }
}

inline float six_decimals(float value) {
    char text[64];
    std::snprintf(text, sizeof text, "%.6f", static_cast<double>(value));
    return std::strtof(text, nullptr);
}

inline Faces rounded(Faces faces) {
    for (Face& face : faces) {
        for (Vec3f& corner : face.corners)
            corner = corner.unaryExpr(&six_decimals);
    }
    return faces;
}

// Another order of the faces, and of each face's corners (the winding kept).
inline Faces shuffled(Faces faces, unsigned seed) {
    std::mt19937 random(seed);
    std::shuffle(faces.begin(), faces.end(), random);
    for (Face& face : faces) {
        const auto first = static_cast<std::ptrdiff_t>(random() % face.corners.size());
        std::rotate(face.corners.begin(), face.corners.begin() + first, face.corners.end());
    }
    return faces;
}

inline Faces triangulated(const Faces& faces) {
    Faces triangles;
    for (const Face& face : faces) {
        for (std::size_t i = 2; i < face.corners.size(); ++i) {
            triangles.push_back(
                {{face.corners[0], face.corners[i - 1], face.corners[i]}, face.material, face.painted});
        }
    }
    return triangles;
}

// Random polygons of 3 to 8 corners in random planes, `spread` metres about the origin.
inline Faces random_polygons(std::size_t count, float spread, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> unit(-1.0f, 1.0f);
    Faces faces;
    while (faces.size() < count) {
        const Vec3f centre = spread * Vec3f(unit(random), unit(random), unit(random));
        const Vec3f normal = Vec3f(unit(random), unit(random), unit(random)).normalized();
        const Vec3f side = normal.unitOrthogonal();
        const Vec3f other = normal.cross(side);
        const auto corners = 3 + random() % 6;
        const float size = 0.2f + 2.0f * std::abs(unit(random));
        Face face;
        for (unsigned i = 0; i < corners; ++i) {
            const float angle = 6.2831853f * static_cast<float>(i) / static_cast<float>(corners);
            face.corners.push_back(centre + size * (std::cos(angle) * side + std::sin(angle) * other));
        }
        face.material = random() % 2 == 0 ? "Stone Wall" : "grass";
        face.painted = random() % 3 == 0 ? static_cast<int>(random() % 8) : -1;
        faces.push_back(face);
    }
    return faces;
}

using Random = std::mt19937;

inline double drawn(Random& random, double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
}

inline int drawn_type(Random& random) {
    return static_cast<int>(random() % 6) - 1;
}

inline std::size_t painted_count(const Faces& faces) {
    return static_cast<std::size_t>(
        std::count_if(faces.begin(), faces.end(), [](const Face& f) { return f.painted >= 0; }));
}

// A floor with a low wall, both painted, and a second floor elsewhere, which stays.
struct Moving {
    Faces before;
    std::size_t moving = 0;  // the first faces
};

inline Moving two_rooms() {
    Faces faces = tiles(9);
    const Vec3f up(0, 0.5f, 0);
    for (std::size_t i = 0; i < 6; ++i) {
        const Vec3f left = faces[i].corners[0];
        const Vec3f right = faces[i].corners[3];
        faces.push_back(quad(left, right, right + up, left + up));
    }
    const std::size_t moving = faces.size();
    for (Face face : tiles(9)) {
        for (Vec3f& corner : face.corners)
            corner += Vec3f(100, 2, 0);
        faces.push_back(face);
    }
    for (std::size_t i = 0; i < faces.size(); ++i)
        faces[i].painted = i % 3 == 0 ? -1 : static_cast<int>(i * i % 7);
    return {faces, moving};
}

}  // namespace slipface::test
