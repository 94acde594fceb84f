// Triangle soups for the collision tests and benchmarks.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <optional>
#include <random>
#include <span>
#include <stdexcept>
#include <vector>

#include "slipface/collision/collision_world.h"

namespace slipface::scenes {

struct Soup {
    std::vector<Vec3f> positions;
    std::vector<std::array<std::uint32_t, 3>> triangles;
    std::vector<FaceId> faces;

    void add(const Vec3& a, const Vec3& b, const Vec3& c) {
        const auto first = static_cast<std::uint32_t>(positions.size());
        for (const Vec3& p : {a, b, c})
            positions.push_back(p.cast<float>());
        triangles.push_back({first, first + 1, first + 2});
        faces.push_back(static_cast<FaceId>(faces.size()));
    }
    // Two triangles a, b, c and a, c, d of one face.
    void add_quad(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
        add(a, b, c);
        add(a, c, d);
        faces.back() = faces[faces.size() - 2];
    }
    TriangleSoup view() const { return {positions, triangles, faces}; }
    CollisionWorld world() const {
        auto result = CollisionWorld::build(view());
        if (!result) throw std::runtime_error(result.error().text());
        return std::move(result).value();
    }
    // The triangle alone, in a world of its own.
    CollisionWorld single(std::size_t triangle) const {
        const std::array<FaceId, 1> face{faces[triangle]};
        auto result = CollisionWorld::build({positions, std::span(triangles).subspan(triangle, 1), face});
        if (!result) throw std::runtime_error(result.error().text());
        return std::move(result).value();
    }
};

// A right triangle in the plane y = 0 with legs of 4 on the axes, winding normal +Y.
inline Soup corner_triangle() {
    Soup soup;
    soup.add({0, 0, 0}, {0, 0, 4}, {4, 0, 0});
    return soup;
}

class Random {
  public:
    explicit Random(std::uint64_t seed) : state_(seed) {}

    // Spelled out instead of std::uniform_real_distribution, whose numbers differ between libraries.
    double uniform(double low, double high) {
        return low + (high - low) * (static_cast<double>(next() >> 11) * 0x1p-53);
    }
    std::size_t below(std::size_t count) { return static_cast<std::size_t>(next() % count); }
    Vec3 in_box(double half) { return {uniform(-half, half), uniform(-half, half), uniform(-half, half)}; }
    Vec3 direction() {
        while (true) {
            const Vec3 v = in_box(1.0);
            if (v.squaredNorm() > 0.01 && v.squaredNorm() <= 1.0) return v.normalized();
        }
    }
    // splitmix64
    std::uint64_t next() {
        std::uint64_t z = (state_ += 0x9e3779b97f4a7c15ULL);
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
        z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
        return z ^ (z >> 31);
    }

  private:
    std::uint64_t state_;
};

// `count` triangles of about `size` metres within a cube of half side `half`.
inline Soup random_soup(Random& random, std::size_t count, double half, double size) {
    Soup soup;
    for (std::size_t i = 0; i < count; ++i) {
        const Vec3 at = random.in_box(half);
        soup.add(at + random.in_box(size), at + random.in_box(size), at + random.in_box(size));
    }
    return soup;
}

// Rolling ground of cells x cells quads with `cell` metres a side, shared corners, and a box standing on
// about every thirtieth quad: floor, walls and steps as levels have them.
inline Soup terrain(Random& random, std::size_t cells, double cell) {
    Soup soup;
    const auto height = [cell](std::size_t i, std::size_t j) {
        const double x = static_cast<double>(i) * cell;
        const double z = static_cast<double>(j) * cell;
        return 1.5 * std::sin(0.31 * x) * std::cos(0.23 * z) + 0.3 * std::sin(1.7 * x + 0.9 * z);
    };
    for (std::size_t j = 0; j <= cells; ++j) {
        for (std::size_t i = 0; i <= cells; ++i) {
            soup.positions.emplace_back(static_cast<float>(static_cast<double>(i) * cell),
                                        static_cast<float>(height(i, j)),
                                        static_cast<float>(static_cast<double>(j) * cell));
        }
    }
    const auto row = static_cast<std::uint32_t>(cells + 1);
    for (std::uint32_t j = 0; j < cells; ++j) {
        for (std::uint32_t i = 0; i < cells; ++i) {
            const std::uint32_t a = j * row + i;
            const auto face = static_cast<FaceId>(soup.faces.size());
            soup.triangles.push_back({a, a + row, a + row + 1});
            soup.triangles.push_back({a, a + row + 1, a + 1});
            soup.faces.insert(soup.faces.end(), {face, face});
            if (random.below(30) != 0) continue;
            const Vec3 base = soup.positions[a].cast<double>();
            const double w = random.uniform(0.3, 2.0) * cell;
            const double h = random.uniform(0.2, 3.0);
            const auto at = [&](int x, int y, int z) { return Vec3(base + Vec3(x * w, y * h - 0.5, z * w)); };
            soup.add_quad(at(0, 0, 0), at(0, 1, 0), at(1, 1, 0), at(1, 0, 0));
            soup.add_quad(at(0, 0, 1), at(1, 0, 1), at(1, 1, 1), at(0, 1, 1));
            soup.add_quad(at(0, 0, 0), at(0, 0, 1), at(0, 1, 1), at(0, 1, 0));
            soup.add_quad(at(1, 0, 0), at(1, 1, 0), at(1, 1, 1), at(1, 0, 1));
            soup.add_quad(at(0, 1, 0), at(0, 1, 1), at(1, 1, 1), at(1, 1, 0));
        }
    }
    return soup;
}

// A building of `count` x `count` rooms on each of `floors` storeys, 6 m a side and 4 m high: walls with
// doorways, a flight of stairs, a round column of slivers, and boxes for furniture in each; shared corners.
class Rooms {
  public:
    Rooms(Random& random, std::size_t count, std::size_t floors) : random_(random) {
        for (std::size_t f = 0; f < floors; ++f) {
            for (std::size_t j = 0; j < count; ++j) {
                for (std::size_t i = 0; i < count; ++i)
                    add_room(Vec3(6.0 * static_cast<double>(i), 4.0 * static_cast<double>(f),
                                  6.0 * static_cast<double>(j)));
            }
        }
    }
    Soup soup;

  private:
    using Corner = std::uint32_t;

    Corner corner(const Vec3& p) {
        soup.positions.push_back(p.cast<float>());
        return static_cast<Corner>(soup.positions.size() - 1);
    }
    void quad(Corner a, Corner b, Corner c, Corner d) {
        const auto face = static_cast<FaceId>(soup.faces.empty() ? 0 : soup.faces.back() + 1);
        soup.triangles.push_back({a, b, c});
        soup.triangles.push_back({a, c, d});
        soup.faces.insert(soup.faces.end(), {face, face});
    }
    // u along, v up, n x n cells.
    void wall(const Vec3& at, const Vec3& u, const Vec3& v, int columns, int rows) {
        std::vector<Corner> grid;
        for (int r = 0; r <= rows; ++r) {
            for (int c = 0; c <= columns; ++c)
                grid.push_back(corner(at + (double(c) / columns) * u + (double(r) / rows) * v));
        }
        for (int r = 0; r < rows; ++r) {
            for (int c = 0; c < columns; ++c) {
                const auto k = static_cast<std::size_t>(r * (columns + 1) + c);
                const auto up = k + static_cast<std::size_t>(columns) + 1;
                quad(grid[k], grid[k + 1], grid[up + 1], grid[up]);
            }
        }
    }
    void box(const Vec3& at, const Vec3& size) {
        std::array<Corner, 8> c{};
        for (std::size_t k = 0; k < 8; ++k) {
            const Vec3 side((k & 1U) != 0, (k & 2U) != 0, (k & 4U) != 0);
            c[k] = corner(at + side.cwiseProduct(size));
        }
        quad(c[0], c[2], c[3], c[1]);
        quad(c[4], c[5], c[7], c[6]);
        quad(c[0], c[4], c[6], c[2]);
        quad(c[1], c[3], c[7], c[5]);
        quad(c[2], c[6], c[7], c[3]);
        quad(c[0], c[1], c[5], c[4]);
    }
    void column(const Vec3& at, double radius, double height, int sides) {
        std::vector<Corner> ring;
        for (int k = 0; k < sides; ++k) {
            const double angle = 6.283185307179586 * k / sides;
            const Vec3 out(radius * std::cos(angle), 0, radius * std::sin(angle));
            ring.push_back(corner(at + out));
            ring.push_back(corner(at + out + Vec3(0, height, 0)));
        }
        for (std::size_t k = 0; k < ring.size(); k += 2) {
            const std::size_t next = (k + 2) % ring.size();
            quad(ring[k], ring[k + 1], ring[next + 1], ring[next]);
        }
    }
    // A wall of 6 m by 4 m with a doorway of 1.6 m by 2.5 m.
    void doorway(const Vec3& at, const Vec3& along) {
        wall(at, 2.2 * along, Vec3(0, 4, 0), 2, 2);
        wall(at + 3.8 * along, 2.2 * along, Vec3(0, 4, 0), 2, 2);
        wall(at + 2.2 * along + Vec3(0, 2.5, 0), 1.6 * along, Vec3(0, 1.5, 0), 1, 1);
    }
    void add_room(const Vec3& at) {
        wall(at, Vec3(0, 0, 6), Vec3(6, 0, 0), 3, 3);
        doorway(at, Vec3::UnitX());
        doorway(at, Vec3::UnitZ());
        column(at + Vec3(random_.uniform(1, 5), 0, random_.uniform(1, 5)), random_.uniform(0.2, 0.4), 4, 16);
        const Vec3 stairs = at + Vec3(4.5, 0, 0.5);
        for (int k = 0; k < 8; ++k)
            box(stairs + Vec3(0, 0, 0.4 * k), Vec3(1.2, 0.25 * (k + 1), 0.4));
        for (int k = 0; k < 5; ++k) {
            box(at + Vec3(random_.uniform(0.2, 5), 0, random_.uniform(0.2, 5)),
                Vec3(random_.uniform(0.2, 1), random_.uniform(0.2, 1.5), random_.uniform(0.2, 1)));
        }
    }

    Random& random_;
};

// A closed ball of 8 * 4^levels triangles with shared corners.
inline Soup ball(double radius, int levels) {
    Soup soup;
    const auto add = [&](auto&& self, const Vec3& a, const Vec3& b, const Vec3& c, int level) -> void {
        if (level == 0) {
            soup.add(radius * a, radius * b, radius * c);
            return;
        }
        const Vec3 ab = (a + b).normalized();
        const Vec3 bc = (b + c).normalized();
        const Vec3 ca = (c + a).normalized();
        self(self, a, ab, ca, level - 1);
        self(self, ab, b, bc, level - 1);
        self(self, ca, bc, c, level - 1);
        self(self, ab, bc, ca, level - 1);
    };
    for (const double x : {-1.0, 1.0}) {
        for (const double y : {-1.0, 1.0}) {
            for (const double z : {-1.0, 1.0}) {
                const Vec3 a(x, 0, 0);
                const Vec3 b(0, y, 0);
                const Vec3 c(0, 0, z);
                // Counter-clockwise seen from outside.
                if (x * y * z > 0) {
                    add(add, a, b, c, levels);
                } else {
                    add(add, a, c, b, levels);
                }
            }
        }
    }
    return soup;
}

}  // namespace slipface::scenes
