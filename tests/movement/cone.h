// Planes that meet in a point, and the exact answer to hold a player among them against.
#pragma once

#include <Eigen/LU>
#include <algorithm>
#include <optional>

#include "test_geometry.h"

namespace slipface::test {

// All points p with normal.p >= distance; the normal is a unit vector.
struct HalfSpace {
    Vec3 normal = Vec3::UnitY();
    double distance = 0.0;
};

// The point of all half spaces that is nearest to `from`; nothing where they have no point in common.
//
// The way to the nearest point is a sum of pushes, none of them negative, along the normals of planes that it
// ends on (Karush, Kuhn and Tucker), and three planes are enough in space. A point like that is the only one,
// so the first set of one, two or three planes that gives one is the answer. The pushes come from the planes'
// Gram matrix; the engine knows neither pushes nor matrices.
inline std::optional<Vec3> nearest_in(const std::vector<HalfSpace>& spaces, const Vec3& from) {
    const auto inside = [&](const Vec3& p) {
        for (const HalfSpace& space : spaces)
            if (space.normal.dot(p) < space.distance - 1e-9) return false;
        return true;
    };
    if (inside(from)) return from;
    const std::size_t count = spaces.size();
    std::optional<Vec3> found;
    const auto try_set = [&](const std::vector<std::size_t>& set) {
        const auto size = static_cast<Eigen::Index>(set.size());
        Eigen::MatrixXd normals(size, 3);
        Eigen::VectorXd missing(size);
        for (Eigen::Index i = 0; i < size; ++i) {
            const HalfSpace& space = spaces[set[static_cast<std::size_t>(i)]];
            normals.row(i) = space.normal.transpose();
            missing[i] = space.distance - space.normal.dot(from);
        }
        const Eigen::FullPivLU<Eigen::MatrixXd> gram(normals * normals.transpose());
        if (!gram.isInvertible()) return;
        const Eigen::VectorXd pushes = gram.solve(missing);
        const Vec3 to = from + normals.transpose() * pushes;
        if (pushes.minCoeff() > -1e-9 && inside(to) && !found) found = to;
    };
    for (std::size_t i = 0; i < count; ++i)
        try_set({i});
    for (std::size_t i = 0; i < count; ++i)
        for (std::size_t j = i + 1; j < count; ++j)
            try_set({i, j});
    for (std::size_t i = 0; i < count; ++i)
        for (std::size_t j = i + 1; j < count; ++j)
            for (std::size_t k = j + 1; k < count; ++k)
                try_set({i, j, k});
    return found;
}

// A world of planes through the origin, one triangle each, which reaches 100 m from there. The normals lead
// to the side on which the player is.
inline Lab corner_of(const std::vector<Vec3>& normals) {
    Lab lab;
    for (const Vec3& n : normals) {
        const Vec3 across =
            n.cross(std::abs(n.y()) < 0.8 ? Vec3(Vec3::UnitY()) : Vec3(Vec3::UnitX())).normalized();
        const Vec3 up = n.cross(across);
        std::vector<Vec3> corners;
        for (const double degrees : {0.0, 120.0, 240.0})
            corners.push_back(200.0 *
                              (std::cos(radians(degrees)) * across + std::sin(radians(degrees)) * up));
        lab.polygon(corners);
    }
    lab.ready();
    return lab;
}

// Where the centre may be: a skin off each plane of `lab`. Made from the triangles as the world holds them,
// because their corners were rounded to float: 8e-6 m at 100 m.
inline std::vector<HalfSpace> room_in(Lab& lab, const MovementSettings& s) {
    std::vector<HalfSpace> spaces;
    for (TriangleId i = 0; i < lab.world().triangle_count(); ++i) {
        const std::array<Vec3, 3> corner = lab.world().triangle(i);
        const Vec3 n = (corner[1] - corner[0]).cross(corner[2] - corner[0]).normalized();
        spaces.push_back({n, n.dot(corner[0]) + s.radii.cwiseProduct(n).norm() + s.skin});
    }
    return spaces;
}

// The point on two or three planes; of a line of two the point nearest to the origin.
inline Vec3 common_point(const std::vector<HalfSpace>& planes) {
    Eigen::MatrixXd normals(static_cast<Eigen::Index>(planes.size()), 3);
    Eigen::VectorXd distances(normals.rows());
    for (Eigen::Index i = 0; i < normals.rows(); ++i) {
        normals.row(i) = planes[static_cast<std::size_t>(i)].normal.transpose();
        distances[i] = planes[static_cast<std::size_t>(i)].distance;
    }
    return normals.transpose() * (normals * normals.transpose()).fullPivLu().solve(distances);
}

// A player's centre that overlaps each plane of `room`: `share[i]` of the way from touching it to having the
// centre on it.
inline Vec3 centre_inside(std::vector<HalfSpace> room, const MovementSettings& s,
                          const std::vector<double>& fraction) {
    for (std::size_t i = 0; i < room.size(); ++i)
        room[i].distance -= s.skin + fraction[i] * s.radii.cwiseProduct(room[i].normal).norm();
    return common_point(room);
}

inline Vec3 random_direction(Random& random) {
    for (;;) {
        const Vec3 v(random.between(-1, 1), random.between(-1, 1), random.between(-1, 1));
        if (v.norm() > 0.1 && v.norm() < 1.0) return v.normalized();
    }
}

// Two faces with the given angle of air between them, their edge along any direction.
inline std::vector<Vec3> wedge_normals(Random& random, double angle) {
    const Vec3 a = random_direction(random);
    const Vec3 b = a.cross(random_direction(random)).normalized();
    return {std::sin(angle / 2) * a + std::cos(angle / 2) * b,
            std::sin(angle / 2) * a - std::cos(angle / 2) * b};
}

// Three faces with acute angles between them: normals that lead away from each other.
inline std::vector<Vec3> acute_corner_normals(Random& random) {
    for (;;) {
        const Vec3 a = random_direction(random), b = random_direction(random), c = random_direction(random);
        const double maximum = std::max({a.dot(b), b.dot(c), c.dot(a)});
        if (maximum < 0.0 && std::abs(a.dot(b.cross(c))) > 0.05) return {a, b, c};
    }
}

}  // namespace slipface::test
