// Levels without a spawn, drawn from seeds, and the places where a player could begin: what the first Play
// has to choose from. Half of the kinds are thick graybox solids.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <random>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "shapes.h"
#include "slipface/level/find_start.h"
#include "slipface/level/level_scene.h"
#include "slipface/reach/search.h"

namespace slipface::test {

struct DrawnLevel {
    std::string_view kind;
    bool thick = false;
    Level level;
    std::function<bool(const Vec3&)> solid;  // whether a point lies where no player should be
};

// Draws geometry in metres with its lower left corner at 0; done() moves it.
class LevelDrawer {
  public:
    explicit LevelDrawer(std::uint64_t seed, bool inverted = false) : random_(seed), inverted_(inverted) {}

    double in(double low, double high) {
        return low + (high - low) * static_cast<double>(random_() >> 11) * 0x1p-53;
    }
    int count(int low, int high) { return static_cast<int>(std::floor(in(low, high + 0.999))); }
    bool chance(double p) { return in(0, 1) < p; }

    struct Box {
        Vec3 low = Vec3::Zero(), high = Vec3::Zero();
        bool contains(const Vec3& p) const {
            return (p.array() > low.array()).all() && (p.array() < high.array()).all();
        }
    };
    using Quad = std::array<Vec3, 4>;

    void quad(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) { quads_.push_back({a, b, c, d}); }
    // The six sides, seen from outside; with `inside` those of a room.
    void sides(const Vec3& low, const Vec3& high, bool inside) {
        for (int axis = 0; axis < 3; ++axis) {
            const int u = (axis + 1) % 3, v = (axis + 2) % 3;
            for (const bool top : {false, true}) {
                Quad q;
                q.fill(top ? high : low);
                q[0][u] = low[u], q[0][v] = low[v];
                q[1][u] = high[u], q[1][v] = low[v];
                q[2][u] = high[u], q[2][v] = high[v];
                q[3][u] = low[u], q[3][v] = high[v];
                if (top == inside) std::reverse(q.begin(), q.end());
                quads_.push_back(q);
            }
        }
    }
    void solid(const Vec3& low, const Vec3& high) {
        solids_.push_back({low, high});
        sides(low, high, false);
    }
    void floor(const Vec3& low, const Vec3& high) {
        quad({low.x(), low.y(), low.z()}, {low.x(), low.y(), high.z()}, {high.x(), low.y(), high.z()},
             {high.x(), low.y(), low.z()});
    }
    // A thin upright wall from a to b, seen from its left.
    void wall(const Vec3& a, const Vec3& b, double height) {
        const Vec3 up(0, height, 0);
        quad(a, b, b + up, a + up);
    }
    void crates(const Vec3& low, const Vec3& high, int most) {
        for (int i = count(0, most); i > 0; --i) {
            const Vec3 size(in(0.4, 3), in(0.3, 2.5), in(0.4, 3));
            const double x = in(low.x(), std::max(low.x(), high.x() - size.x()));
            const double z = in(low.z(), std::max(low.z(), high.z() - size.z()));
            const double sunk = chance(0.5) ? 0.0 : in(0, 0.2);
            solid({x, low.y() - sunk, z},
                  {std::min(x + size.x(), high.x()), low.y() + size.y(), std::min(z + size.z(), high.z())});
        }
    }

    // Cells of a grid that are filled, or (with `carved`) empty; their border is the geometry.
    struct Grid {
        int x = 0, y = 0, z = 0;
        Vec3 cell = Vec3::Ones();
        std::vector<char> filled;
        Grid(int nx, int ny, int nz, const Vec3& size, bool full)
            : x(nx), y(ny), z(nz), cell(size), filled(static_cast<std::size_t>(nx * ny * nz), full ? 1 : 0) {}
        char& at(int i, int j, int k) { return filled[static_cast<std::size_t>((j * z + k) * x + i)]; }
        void fill(int x0, int y0, int z0, int x1, int y1, int z1, bool value) {
            for (int j = std::max(0, y0); j < std::min(y, y1); ++j)
                for (int k = std::max(0, z0); k < std::min(z, z1); ++k)
                    for (int i = std::max(0, x0); i < std::min(x, x1); ++i)
                        at(i, j, k) = value ? 1 : 0;
        }
    };
    // `shell`: what lies outside of the grid is filled too, and has no faces.
    void border(Grid& grid, bool shell) {
        const auto filled = [&](int i, int j, int k) {
            if (i < 0 || j < 0 || k < 0 || i >= grid.x || j >= grid.y || k >= grid.z) return shell;
            return grid.at(i, j, k) != 0;
        };
        const int n[3] = {grid.x, grid.y, grid.z};
        for (int axis = 0; axis < 3; ++axis) {
            const int u = (axis + 1) % 3, v = (axis + 2) % 3;
            for (int a = 0; a <= n[axis]; ++a)
                for (int b = 0; b < n[u]; ++b)
                    for (int c = 0; c < n[v]; ++c) {
                        int below[3], above[3];
                        below[axis] = a - 1, above[axis] = a;
                        below[u] = above[u] = b;
                        below[v] = above[v] = c;
                        const bool under = filled(below[0], below[1], below[2]);
                        if (under == filled(above[0], above[1], above[2])) continue;
                        Quad q;
                        const int du[4] = {0, 1, 1, 0}, dv[4] = {0, 0, 1, 1};
                        for (std::size_t i = 0; i < 4; ++i) {
                            q[i][axis] = a * grid.cell[axis];
                            q[i][u] = (b + du[i]) * grid.cell[u];
                            q[i][v] = (c + dv[i]) * grid.cell[v];
                        }
                        if (!under) std::reverse(q.begin(), q.end());
                        quads_.push_back(q);
                    }
        }
        for (int j = 0; j < grid.y; ++j)
            for (int k = 0; k < grid.z; ++k)
                for (int i = 0; i < grid.x; ++i)
                    if (grid.at(i, j, k) != 0) {
                        const Vec3 low(i * grid.cell.x(), j * grid.cell.y(), k * grid.cell.z());
                        solids_.push_back({low, low + grid.cell});
                    }
        if (shell) room_ = Box{Vec3::Zero(), grid.cell.cwiseProduct(Vec3(grid.x, grid.y, grid.z))};
    }
    void room(const Vec3& low, const Vec3& high) { room_ = Box{low, high}; }

    // `about`: what comes to lie at the level's origin.
    DrawnLevel done(std::string_view kind, bool thick, const Vec3& about) {
        Shapes shapes;
        for (Quad& q : quads_) {
            if (inverted_) std::reverse(q.begin(), q.end());
            shapes.polygon({q[0] - about, q[1] - about, q[2] - about, q[3] - about});
        }
        DrawnLevel drawn{kind, thick, shapes.level(), {}};
        drawn.level.spawn_is_set = false;
        drawn.level.spawn = Vec3::Zero();
        drawn.level.spawn_yaw = 0.0;
        drawn.solid = [solids = solids_, room = room_, about](const Vec3& p) {
            const Vec3 at = p + about;
            if (!room.low.isApprox(room.high) && !room.contains(at)) return true;
            return std::any_of(solids.begin(), solids.end(),
                               [&](const Box& box) { return box.contains(at); });
        };
        return drawn;
    }
    // The middle, a corner, a point on the floor, or one far away.
    Vec3 any_origin() {
        Vec3 low = Vec3::Constant(1e9), high = -low;
        for (const Quad& q : quads_)
            for (const Vec3& p : q) {
                low = low.cwiseMin(p);
                high = high.cwiseMax(p);
            }
        const int which = count(0, 4);
        if (which == 0) return 0.5 * (low + high);
        if (which == 1) return low;
        if (which == 2) return {0.5 * (low.x() + high.x()), low.y(), 0.5 * (low.z() + high.z())};
        if (which == 3) return {in(low.x(), high.x()), in(low.y(), high.y()), in(low.z(), high.z())};
        return Vec3(in(-300, 300), in(-50, 50), in(-300, 300));
    }

  private:
    std::mt19937_64 random_;
    bool inverted_ = false;
    std::vector<Quad> quads_;
    std::vector<Box> solids_;
    Box room_;
};

// Blender's default cube scaled into a floor; its middle is at the origin.
inline DrawnLevel cube_floor(LevelDrawer& draw) {
    const Vec3 size(draw.in(8, 60), draw.in(0.5, 10), draw.in(8, 60));
    draw.solid(Vec3::Zero(), size);
    draw.crates({0, size.y(), 0}, size, 10);
    return draw.done("cube as floor", true, draw.chance(0.7) ? Vec3(0.5 * size) : draw.any_origin());
}

// A slab with towers; often the origin lies in one of them.
inline DrawnLevel towers(LevelDrawer& draw) {
    const Vec3 size(draw.in(15, 60), draw.in(0.3, 4), draw.in(15, 60));
    draw.solid(Vec3::Zero(), size);
    Vec3 origin = 0.5 * size;
    for (int i = draw.count(1, 6); i > 0; --i) {
        const Vec3 tower(draw.in(2, 8), draw.in(4, 40), draw.in(2, 8));
        const Vec3 low(draw.in(0, size.x() - tower.x()), draw.chance(0.5) ? size.y() : 0.0,
                       draw.in(0, size.z() - tower.z()));
        draw.solid(low, low + tower);
        if (draw.chance(0.3)) origin = low + draw.in(0, 1) * tower;
    }
    draw.crates({0, size.y(), 0}, size, 6);
    return draw.done("towers", true, draw.chance(0.6) ? origin : draw.any_origin());
}

// Rooms of thick walls with doors, with a roof or without, on a floor that may go on outside.
inline DrawnLevel thick_rooms(LevelDrawer& draw) {
    const int nx = draw.count(1, 4), nz = draw.count(1, 4);
    const double room = draw.in(4, 10), wall = draw.in(0.2, 1), height = draw.in(2.6, 5),
                 thick = draw.in(0.2, 2);
    const double yard = draw.chance(0.4) ? draw.in(2, 15) : 0.0, pitch = room + wall;
    const bool outer_door = draw.chance(0.5);
    const double x1 = nx * pitch + wall, z1 = nz * pitch + wall;
    draw.solid({-yard, -thick, -yard}, {x1 + yard, 0, z1 + yard});
    const auto wall_along = [&](bool along_x, double at, double from, bool door) {
        const auto part = [&](double a, double b, double low, double high) {
            if (b - a < 1e-3) return;
            along_x ? draw.solid({a, low, at}, {b, high, at + wall})
                    : draw.solid({at, low, a}, {at + wall, high, b});
        };
        const double end = from + pitch;
        if (!door) return part(from, end, 0, height);
        const double width = draw.in(1.2, 2), middle = from + wall + draw.in(0.5, room - 0.5 - width);
        part(from, middle, 0, height);
        part(middle + width, end, 0, height);
        part(middle, middle + width, draw.in(2.1, height - 0.2), height);
    };
    const int door_at = draw.count(0, nx - 1);
    for (int k = 0; k <= nz; ++k)
        for (int i = 0; i < nx; ++i)
            wall_along(true, k * pitch, i * pitch,
                       (k > 0 && k < nz) || (outer_door && k == 0 && i == door_at));
    for (int i = 0; i <= nx; ++i)
        for (int k = 0; k < nz; ++k)
            wall_along(false, i * pitch, k * pitch, i > 0 && i < nx);
    draw.solid({nx * pitch, 0, nz * pitch}, {x1, height, z1});
    if (draw.chance(0.8)) draw.solid({0, height, 0}, {x1, height + draw.in(0.1, 1), z1});
    draw.crates({wall, 0, wall}, {wall + room, 2, wall + room}, 3);
    return draw.done("thick rooms", true, draw.any_origin());
}

// Halls and tunnels carved into one block.
inline DrawnLevel cave(LevelDrawer& draw) {
    const int nx = draw.count(12, 30), ny = draw.count(5, 10), nz = draw.count(12, 30);
    LevelDrawer::Grid grid(nx, ny, nz, {draw.in(0.8, 1.6), draw.in(0.9, 1.2), draw.in(0.8, 1.6)}, true);
    int x = draw.count(2, nx - 6), z = draw.count(2, nz - 6);
    for (int i = draw.count(3, 9); i > 0; --i) {
        const int w = draw.count(3, 8), d = draw.count(3, 8), h = draw.count(3, ny - 2);
        grid.fill(std::max(1, x - w / 2), 1, std::max(1, z - d / 2), std::min(nx - 1, x + w - w / 2), 1 + h,
                  std::min(nz - 1, z + d - d / 2), false);
        const int to_x = draw.count(2, nx - 4), to_z = draw.count(2, nz - 4);
        grid.fill(std::min(x, to_x), 1, z, std::max(x, to_x) + 2, 4, z + 2, false);
        grid.fill(to_x, 1, std::min(z, to_z), to_x + 2, 4, std::max(z, to_z) + 2, false);
        x = to_x, z = to_z;
    }
    draw.border(grid, false);
    return draw.done("cave in a block", true, draw.any_origin());
}

// Storeys above each other, joined by stairs of boxes.
inline DrawnLevel storeys(LevelDrawer& draw) {
    const double width = draw.in(10, 30), depth = draw.in(10, 30), height = draw.in(2.8, 4.5);
    const double slab = draw.in(0.15, 0.6), hole = 2.0;
    const int floors = draw.count(2, 5);
    draw.solid({0, -slab, 0}, {width, 0, depth});
    for (int f = 1; f < floors; ++f) {
        const double y = f * height;
        const bool left = f % 2 == 0;
        const int steps = static_cast<int>(std::ceil(height / 0.25));
        const double rise = height / steps, run = (depth - 2.0) / steps;
        const double x = left ? 0.0 : width - hole;
        for (int s = 0; s < steps; ++s) {
            const double z = left ? depth - 1.0 - (s + 1) * run : 1.0 + s * run;
            draw.solid({x, y - height + (draw.chance(0.5) ? 0.0 : std::max(0.0, s * rise - 0.3)), z},
                       {x + hole, y - height + (s + 1) * rise, z + run});
        }
        // The slab leaves the stairs free.
        draw.solid({left ? hole : 0.0, y - slab, 0}, {left ? width : width - hole, y, depth});
        draw.solid({x, y - slab, left ? 0.0 : depth - 1.0}, {x + hole, y, left ? 1.0 : depth});
    }
    if (draw.chance(0.5)) draw.crates({1, 0, 1}, {width - 1, 2, depth - 1}, 4);
    return draw.done("storeys", true, draw.any_origin());
}

// Islands too far apart to jump between; often a tiny one lies at the origin.
inline DrawnLevel islands(LevelDrawer& draw) {
    const Vec3 tiny(draw.in(1, 3), draw.in(0.5, 3), draw.in(1, 3));
    draw.solid(-0.5 * tiny, 0.5 * tiny);
    double x = tiny.x() + draw.in(8, 20);
    for (int i = draw.count(1, 4); i > 0; --i) {
        const Vec3 size(draw.in(6, 40), draw.in(0.4, 6), draw.in(6, 40));
        const Vec3 low(x, draw.in(-4, 4), draw.in(-20, 10));
        draw.solid(low, low + size);
        draw.crates({low.x(), low.y() + size.y(), low.z()}, low + size, 4);
        x += size.x() + draw.in(9, 20);
    }
    return draw.done("islands", true, draw.chance(0.8) ? Vec3::Zero() : draw.any_origin());
}

// A closed hall: one shell of faces outside, one inside.
inline DrawnLevel hall(LevelDrawer& draw) {
    const Vec3 size(draw.in(8, 40), draw.in(3, 12), draw.in(8, 40));
    const Vec3 wall(draw.in(0.1, 1.5), draw.in(0.1, 3), draw.in(0.1, 1.5));
    draw.sides(Vec3::Zero(), size, true);
    draw.sides(-wall, size + wall, false);
    draw.crates(Vec3::Zero(), size, 10);
    DrawnLevel drawn = draw.done("closed hall", true, draw.any_origin());
    return drawn;
}

// Terraces that can only be gone down.
inline DrawnLevel terraces(LevelDrawer& draw) {
    const int steps = draw.count(3, 8);
    const double width = draw.in(8, 25), run = draw.in(4, 10), drop = draw.in(2.5, 5);
    for (int i = 0; i < steps; ++i)
        draw.solid({0, draw.chance(0.5) ? -1 : (steps - i) * drop - 1, i * run},
                   {width, (steps - i) * drop, (i + 1) * run});
    return draw.done("terraces", true, draw.any_origin());
}

// Ground and walls without thickness.
inline DrawnLevel planes(LevelDrawer& draw) {
    const double width = draw.in(8, 60), depth = draw.in(8, 60);
    draw.floor(Vec3::Zero(), {width, 0, depth});
    for (int i = draw.count(0, 8); i > 0; --i) {
        const Vec3 a(draw.in(0, width), 0, draw.in(0, depth));
        const double length = draw.in(2, 12);
        const Vec3 b = draw.chance(0.5) ? Vec3(std::min(width, a.x() + length), 0, a.z())
                                        : Vec3(a.x(), 0, std::min(depth, a.z() + length));
        draw.chance(0.5) ? draw.wall(a, b, draw.in(1, 4)) : draw.wall(b, a, draw.in(1, 4));
    }
    return draw.done("planes", false, draw.any_origin());
}

// One room of faces that look inward.
inline DrawnLevel inward_room(LevelDrawer& draw) {
    const Vec3 size(draw.in(6, 40), draw.in(2.5, 10), draw.in(6, 40));
    draw.sides(Vec3::Zero(), size, true);
    draw.crates(Vec3::Zero(), size, 8);
    draw.room(Vec3::Zero(), size);
    return draw.done("inward room", false, draw.any_origin());
}

// Halls and corridors of which only the inner faces are there.
inline DrawnLevel inward_halls(LevelDrawer& draw) {
    const int nx = draw.count(14, 30), ny = 5, nz = draw.count(14, 30);
    LevelDrawer::Grid grid(nx, ny, nz, {draw.in(0.8, 1.6), draw.in(0.9, 1.2), draw.in(0.8, 1.6)}, true);
    int x = draw.count(2, nx - 6), z = draw.count(2, nz - 6);
    for (int i = draw.count(2, 7); i > 0; --i) {
        const int w = draw.count(3, 9), d = draw.count(3, 9);
        grid.fill(x, 0, z, x + w, draw.count(3, ny), z + d, false);
        const int to_x = draw.count(2, nx - 4), to_z = draw.count(2, nz - 4);
        grid.fill(std::min(x, to_x), 0, z, std::max(x, to_x) + 2, 3, z + 2, false);
        grid.fill(to_x, 0, std::min(z, to_z), to_x + 2, 3, std::max(z, to_z) + 2, false);
        x = to_x, z = to_z;
    }
    draw.border(grid, true);
    return draw.done("inward halls", false, draw.any_origin());
}

// Hills of triangles, with crates sunk into them.
inline DrawnLevel hills(LevelDrawer& draw) {
    const int n = draw.count(10, 40);
    const double cell = draw.in(0.8, 2.5), a = draw.in(0.3, 3), b = draw.in(0.3, 3), f = draw.in(0.1, 0.5),
                 g = draw.in(0.1, 0.5);
    const auto at = [&](int i, int k) {
        return Vec3(i * cell, a * std::sin(f * i * cell) + b * std::cos(g * k * cell), k * cell);
    };
    for (int i = 0; i < n; ++i)
        for (int k = 0; k < n; ++k) {
            draw.quad(at(i, k), at(i, k + 1), at(i + 1, k + 1), at(i + 1, k + 1));
            draw.quad(at(i, k), at(i + 1, k + 1), at(i + 1, k), at(i + 1, k));
        }
    for (int i = draw.count(0, 6); i > 0; --i) {
        const Vec3 p = at(draw.count(2, n - 4), draw.count(2, n - 4));
        draw.solid(p - Vec3(1, 2, 1), p + Vec3(draw.in(0.5, 3), draw.in(0.5, 4), draw.in(0.5, 3)));
    }
    return draw.done("hills", false, draw.any_origin());
}

// Floors without thickness above each other, joined by ramps.
inline DrawnLevel thin_storeys(LevelDrawer& draw) {
    const double width = draw.in(12, 30), depth = draw.in(12, 30), height = draw.in(2.8, 4.5), lane = 2.5;
    const int floors = draw.count(2, 4);
    draw.floor(Vec3::Zero(), {width, 0, depth});
    for (int f = 1; f < floors; ++f) {
        const double y = f * height, x = f % 2 == 0 ? 0.0 : width - lane;
        const double run = std::min(depth - 2, 2.0 * height);
        const Vec3 a(x, y - height, 1), b(x + lane, y, 1 + run);
        draw.quad({a.x(), a.y(), a.z()}, {a.x(), b.y(), b.z()}, {b.x(), b.y(), b.z()}, {b.x(), a.y(), a.z()});
        draw.floor({f % 2 == 0 ? lane : 0.0, y, 0}, {f % 2 == 0 ? width : width - lane, y, depth});
        if (1 + run < depth) draw.floor({x, y, 1 + run}, {x + lane, y, depth});
    }
    return draw.done("thin storeys", false, draw.any_origin());
}

// Floors without thickness, too far apart to jump between.
inline DrawnLevel thin_islands(LevelDrawer& draw) {
    double x = 0.0;
    for (int i = draw.count(2, 5); i > 0; --i) {
        const Vec3 low(x, draw.in(-5, 5), draw.in(-10, 10)), size(draw.in(1.5, 30), 0, draw.in(1.5, 30));
        draw.floor(low, low + size);
        x += size.x() + draw.in(9, 25);
    }
    return draw.done("thin islands", false, draw.any_origin());
}

using DrawLevel = DrawnLevel (*)(LevelDrawer&);
inline constexpr std::array<DrawLevel, 8> thick_kinds{cube_floor, towers,  thick_rooms, cave,
                                                      storeys,    islands, hall,        terraces};
inline constexpr std::array<DrawLevel, 6> thin_kinds{planes, inward_room,  inward_halls,
                                                     hills,  thin_storeys, thin_islands};

// Even seeds are thick solids. `inverted`: all faces look the other way.
inline DrawnLevel drawn_level(std::uint64_t seed, bool inverted = false) {
    LevelDrawer draw(seed * 0x9e3779b97f4a7c15u + 1, inverted);
    const std::size_t i = seed / 2;
    return seed % 2 == 0 ? thick_kinds[i % thick_kinds.size()](draw)
                         : thin_kinds[i % thin_kinds.size()](draw);
}

// Square metres of ground on which a search from `start` stood, and where they lie.
struct Ground {
    std::set<std::array<int, 3>> metres;
    static std::array<int, 3> metre(const Vec3& p) {
        return {static_cast<int>(std::floor(p.x())), static_cast<int>(std::floor(p.y())),
                static_cast<int>(std::floor(p.z()))};
    }
    bool holds(const Vec3& p) const {
        const auto at = metre(p);
        for (const int up : {-1, 0, 1})
            if (metres.contains({at[0], at[1] + up, at[2]})) return true;
        return false;
    }
};
inline Ground ground_from(const Level& level, const Vec3& start, std::uint64_t rounds) {
    Ground ground;
    Result<ReachSearch> search = ReachSearch::begin(level, start, {});
    if (!search) return ground;
    search->run({.rounds = rounds});
    for (NodeId node = 0; node < search->archive().nodes.size(); ++node)
        if (search->archive().nodes[node].state.grounded)
            ground.metres.insert(Ground::metre(search->position_of(node)));
    return ground;
}

// Places with room on faces that look up, outside of the solids: `count` columns of them.
inline std::vector<Vec3> possible_starts(const DrawnLevel& drawn, int count, std::uint64_t seed) {
    const Level& level = drawn.level;
    Result<CollisionWorld> world = build_collision_world(level);
    LevelDrawer draw(seed + 77);
    std::vector<Vec3> starts;
    const Aabb bounds = world->bounds();
    const Vec3 radii = level.movement.radii;
    for (int i = 0; i < count; ++i) {
        Vec3 from(draw.in(bounds.min.x(), bounds.max.x()), bounds.max.y() + 1,
                  draw.in(bounds.min.z(), bounds.max.z()));
        for (int layer = 0; layer < 64; ++layer) {
            const auto hit = cast_ray(*world, from, {0, -1, 0});
            if (!hit) break;
            from.y() = hit->point.y() - 0.01;
            if (hit->back_face || hit->normal.y() < 0.9) continue;
            const Vec3 at = centre_on(hit->point, hit->normal, level.movement);
            const Vec3 less = radii.array() - level.movement.skin;
            if (!drawn.solid(at) && !overlaps_any(*world, less, at)) starts.push_back(at);
        }
    }
    return starts;
}

// What the first Play of a level is worth.
struct FirstPlay {
    Start start;
    bool in_solid = false;
    std::size_t reached = 0, most = 0;  // m^2, from the start and from the best one
    double fraction() const {
        return most == 0 ? 1.0 : static_cast<double>(reached) / static_cast<double>(most);
    }
    bool right() const { return start.stands && !in_solid && fraction() > 0.5; }
};
inline FirstPlay first_play(const DrawnLevel& drawn, std::uint64_t seed, std::uint64_t rounds, int columns) {
    FirstPlay play;
    LevelScene scene = LevelScene::build(drawn.level).value();
    play.start = find_start(drawn.level, scene, drawn.level.movement).value();
    play.in_solid = drawn.solid(play.start.position);
    std::vector<Ground> grounds;
    if (play.start.stands && !play.in_solid) {
        grounds.push_back(ground_from(drawn.level, play.start.position, rounds));
        play.reached = grounds.front().metres.size();
    }
    play.most = play.reached;
    for (const Vec3& start : possible_starts(drawn, columns, seed)) {
        // From where a search came, no more is reached.
        if (std::any_of(grounds.begin(), grounds.end(),
                        [&](const Ground& ground) { return ground.holds(start); }))
            continue;
        grounds.push_back(ground_from(drawn.level, start, rounds));
        play.most = std::max(play.most, grounds.back().metres.size());
    }
    return play;
}

}  // namespace slipface::test
