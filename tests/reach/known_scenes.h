// Kinds of scenes that are possible up to a known size and impossible beyond it, drawn from seeds.
#pragma once

#include <array>

#include "reach_scenes.h"

namespace slipface::test {

// All that is drawn for one scene. The same seed and index give the same number.
struct Draw {
    std::uint64_t seed = 1;
    MovementSettings settings;
    double in(int index, double low, double high) const {
        std::mt19937_64 random(seed * 1009 + static_cast<std::uint64_t>(index));
        random.discard(2);
        return std::uniform_real_distribution<double>(low, high)(random);
    }
};

inline Draw draw_of(std::uint64_t seed) {
    std::mt19937_64 random(seed);
    return {seed, random_settings(random)};
}

// A wall that no jump of random_settings() clears.
constexpr double wall_m = 6.0;

inline ReachScene finished(const Shapes& shapes, const Draw& draw, const Vec3& ground, const Vec3& target) {
    ReachScene scene{shapes.level(), ground + Vec3(0, draw.settings.radii.y() + 0.01, 0), target};
    scene.level.movement = draw.settings;
    scene.level.spawn = scene.start;
    return scene;
}

// A staircase around a column: eleven landings on the edge of a square, half a metre apart. Each rises by up
// to `fraction` of the highest ledge that is possible, one by exactly that.
inline ReachScene spiral_scene(const Draw& draw, double fraction, double maximum) {
    constexpr std::array<std::array<int, 2>, 11> ring{
        {{0, 0}, {0, 1}, {0, 2}, {0, 3}, {1, 3}, {2, 3}, {3, 3}, {3, 2}, {3, 1}, {3, 0}, {2, 0}}};
    const double yaw = draw.in(0, 0.0, 6.28), pitch = 3.5;
    const int highest = 1 + static_cast<int>(draw.in(1, 0.0, 9.99));
    Shapes shapes;
    double height = 0.0;
    Vec3 at = Vec3::Zero();
    for (int i = 0; i < 11; ++i) {
        if (i > 0)
            height +=
                maximum * (i == highest ? fraction : draw.in(10 + i, 0.5, 0.95) * std::min(fraction, 1.0));
        at = Vec3(pitch * ring[static_cast<std::size_t>(i)][0], height,
                  -pitch * ring[static_cast<std::size_t>(i)][1]);
        turned_box(shapes, at - Vec3(1.5, 0.3, 1.5), at + Vec3(1.5, 0, 1.5), yaw);
    }
    return finished(shapes, draw, Vec3::Zero(), turned(at, yaw));
}

// From a ledge down onto a bouncy pad, against a wall and up onto it; three times. `size`: height of each
// wall above its pad.
inline ReachScene bounce_scene(const Draw& draw, double size, int links, double yaw) {
    const double drop = draw.in(0, 1.0, 3.0), apart = draw.in(1, 1.5, 3.0), run = 4.0;
    Shapes shapes;
    shapes.material("stone");
    turned_box(shapes, {-2, -1, 0}, {2, 0, run}, yaw);
    double z = 0.0, y = 0.0;
    for (int i = 0; i < links; ++i) {
        y -= drop;
        shapes.material("pad__bouncy");
        turned_box(shapes, {-2, y - 0.5, z - apart}, {2, y, z}, yaw);
        z -= apart;
        shapes.material("stone");
        turned_box(shapes, {-2, y - 0.5, z - run}, {2, y + size, z}, yaw);
        y += size;
        z -= run;
    }
    ReachScene scene =
        finished(shapes, draw, turned({0, 0, 0.7 * run}, yaw), turned({0, y, z + 0.5 * run}, yaw));
    for (SurfaceType& type : scene.level.surfaces)
        if (type.name == "bouncy") type.restitution = draw.in(2, 0.75, 1.0);
    return scene;
}

// A gap behind a runway of ice with a wall at its back, just long enough to reach the walking speed. Without
// steering in the air, only a run from the very back is fast enough.
inline ReachScene ice_scene(const Draw& draw, double width, double yaw) {
    Draw ice = draw;
    ice.settings.air_control = false;
    ice.settings.slippery_acceleration = draw.in(1, 3.0, 8.0);
    const double speed = draw.settings.walk_speed, radius = draw.settings.radii.x();
    const double length =
        draw.in(0, 1.0, 1.1) * speed * speed / (2.0 * ice.settings.slippery_acceleration) + radius;
    Shapes shapes;
    shapes.material("stone");
    turned_box(shapes, {-2, 0, length}, {2, wall_m, length + 0.5}, yaw);
    // Players who slide over a rim of the runway gain speed: walls beside it, and one metre more in front of
    // what is meant to be impossible.
    turned_box(shapes, {-2.5, -1, 0}, {-2, wall_m, length}, yaw);
    turned_box(shapes, {2, -1, 0}, {2.5, wall_m, length}, yaw);
    shapes.material("floor__ice");
    turned_box(shapes, {-2, -1, 0}, {2, 0, length}, yaw);
    shapes.material("stone");
    turned_box(shapes, {-2, -1, -width - 4}, {2, 0, -width}, yaw);
    return finished(shapes, ice, turned({0, 0, length - radius - 0.01}, yaw),
                    turned({0, 0, -width - 2}, yaw));
}

inline Platform ferry_of(const char* name, double speed, double pause, double phase, double path_m) {
    Platform ferry;
    ferry.name = ferry.group = name;
    ferry.phase_s = phase;
    ferry.path = {{Vec3::Zero(), speed, pause}, {Vec3(0, 0, -path_m), speed, pause}};
    return ferry;
}

constexpr double ferry_m = 2.2;  // its length

// The widest gap from a ferry at rest.
inline double gap_from_ferry(const Draw& draw, int starts) {
    const auto make = [&](double width) {
        Shapes shapes;
        shapes.box({-2, -1, 0}, {2, 0, ferry_m}).box({-2, -1, -width - 4}, {2, 0, -width});
        return finished(shapes, draw, {0, 0, ferry_m - 0.1}, {0, 0, -width - 2});
    };
    return largest_possible(make, 20.0, starts);
}

// More than any jump from a ferry covers that moves at `speed`: a long run-up, faster by that.
inline double gap_beyond(const Draw& draw, double speed) {
    MovementSettings faster = draw.settings;
    faster.walk_speed += speed;
    faster.ground_acceleration = faster.air_acceleration = 500.0;
    return max_possible(faster, false, 8);
}

// A ferry that comes as near to the far side as a fraction of what can be jumped from it.
inline ReachScene ferry_scene(const Draw& draw, double fraction, double maximum) {
    const double speed = draw.in(0, 1.5, 4.0);
    const double last = fraction > 1.0 ? fraction * gap_beyond(draw, speed) : fraction * maximum;
    const double path = gap_beyond(draw, speed) + draw.in(1, 2.0, 6.0);
    const double far_z = -0.2 - ferry_m - path - last;
    Shapes shapes;
    shapes.box({-2, -1, 0}, {2, 0, 4}).box({-2, -1, far_z - 4}, {2, 0, far_z});
    shapes.group("ferry").box({-1.5, -0.4, -0.2 - ferry_m}, {1.5, 0, -0.2});
    ReachScene scene = finished(shapes, draw, {0, 0, 3}, {0, 0, far_z - 2});
    scene.level.platforms = {ferry_of("ferry", speed, draw.in(2, 0.3, 1.5), draw.in(3, 0.0, 9.0), path)};
    return scene;
}

// Two ferries, one behind the other: the player changes where they meet. With periods that differ they do so
// sooner or later; in step they are always a whole path apart.
inline ReachScene relay_scene(const Draw& draw, double fraction, double) {
    const double speed = draw.in(0, 1.5, 3.0), pause = draw.in(1, 0.4, 1.0), apart = 0.3;
    const double path = 1.05 * gap_beyond(draw, speed) + 0.2;
    const double far_z = -0.2 - 2.0 * (ferry_m + path) - apart - 0.2;
    Shapes shapes;
    shapes.box({-2, -1, 0}, {2, 0, 4}).box({-2, -1, far_z - 4}, {2, 0, far_z});
    shapes.group("first").box({-1.5, -0.4, -0.2 - ferry_m}, {1.5, 0, -0.2});
    const double second = -0.2 - ferry_m - path - apart;
    shapes.group("second").box({-1.5, -0.4, second - ferry_m}, {1.5, 0, second});
    ReachScene scene = finished(shapes, draw, {0, 0, 3}, {0, 0, far_z - 2});
    const double phase = draw.in(2, 0.0, 20.0);
    scene.level.platforms = {ferry_of("first", speed, pause, phase, path)};
    scene.level.platforms.push_back(fraction > 1.0 ? ferry_of("second", speed, pause, phase, path)
                                                   : ferry_of("second", draw.in(3, 0.6, 0.9) * speed, pause,
                                                              draw.in(4, 0.0, 20.0), path));
    return scene;
}

// A room with walls all around and a door in one of them, as high and wide as the body divided by `fraction`.
inline ReachScene room_scene(const Draw& draw, double fraction, double) {
    const double yaw = draw.in(0, 0.0, 6.28), at = draw.in(1, -1.0, 1.0);
    const double half = draw.settings.radii.x() / fraction, top = 2.0 * draw.settings.radii.y() / fraction;
    const auto wall = [&](Shapes& shapes, const Vec3& low, const Vec3& high) {
        turned_box(shapes, low, high, yaw);
    };
    Shapes shapes;
    wall(shapes, {-6, -1, -6}, {6, 0, 6});
    for (const double side : {-6.0, 6.0}) {
        wall(shapes, {side - 0.2, 0, -6}, {side + 0.2, wall_m, 6});
        wall(shapes, {-6, 0, side - 0.2}, {6, wall_m, side + 0.2});
    }
    wall(shapes, {-2.2, 0, -2.2}, {-2, wall_m, 2.2});
    wall(shapes, {2, 0, -2.2}, {2.2, wall_m, 2.2});
    wall(shapes, {-2.2, 0, -2.2}, {2.2, wall_m, -2});
    wall(shapes, {-2.2, 0, 2}, {at - half, wall_m, 2.2});
    wall(shapes, {at + half, 0, 2}, {2.2, wall_m, 2.2});
    // The lintel's underside counts: the door is no higher than `top`.
    shapes.polygon({turned({at - half, top, 2}, yaw), turned({at + half, top, 2}, yaw),
                    turned({at + half, top, 2.2}, yaw), turned({at - half, top, 2.2}, yaw)});
    wall(shapes, {at - half, top, 2}, {at + half, wall_m, 2.2});
    wall(shapes, {-1.2, 0.005, -1.2}, {1.2, 0.01, 1.2});  // what is asked for
    return finished(shapes, draw, turned({4, 0, 4}, yaw), {0, 0.01, 0});
}

// A square hole in a floor under walls, as wide as the body divided by `fraction`, and a cellar below it.
inline ReachScene hole_scene(const Draw& draw, double fraction, double) {
    const double half = draw.settings.radii.x() / fraction, x = draw.in(0, -2.0, 2.0),
                 z = draw.in(1, -2.0, 2.0);
    Shapes shapes;
    shapes.box({-4, -0.2, -4}, {x - half, 0, 4}).box({x + half, -0.2, -4}, {4, 0, 4});
    shapes.box({x - half, -0.2, -4}, {x + half, 0, z - half})
        .box({x - half, -0.2, z + half}, {x + half, 0, 4});
    for (const double side : {-4.0, 4.0}) {
        shapes.box({side - 0.1, -5, -4}, {side + 0.1, wall_m, 4});
        shapes.box({-4, -5, side - 0.1}, {4, wall_m, side + 0.1});
    }
    shapes.box({-4, -5.2, -4}, {4, -5, 4});
    return finished(shapes, draw, {x > 0 ? -3.0 : 3.0, 0, z > 0 ? -3.0 : 3.0}, {0, -5, 0});
}

// A tower in a walled yard: from its top down, or from the yard up, higher than any ledge that is possible.
inline ReachScene drop_scene(const Draw& draw, double fraction, double maximum) {
    const double height = maximum * std::max(1.05, fraction) * draw.in(0, 1.0, 2.0);
    Shapes shapes;
    shapes.box({-1, -1, -1}, {1, height, 1});
    shapes.box({-6, -1, -6}, {6, 0, 6});
    for (const double side : {-6.0, 6.0}) {
        shapes.box({side - 0.2, 0, -6}, {side + 0.2, height + wall_m, 6});
        shapes.box({-6, 0, side - 0.2}, {6, height + wall_m, side + 0.2});
    }
    const Vec3 top(0, height, 0), yard(4, 0, 4);
    return fraction > 1.0 ? finished(shapes, draw, yard, top) : finished(shapes, draw, top, Vec3::Zero());
}

// Walls of a random maze on a grid of 2 m: from every tile to every other there is one path, unless one wall
// on the path from the first tile to the last is `closed`. The floor's tiles are the first faces.
struct Maze {
    int size = 0;
    std::vector<bool> open_x, open_z;  // [z * size + x] to the next tile along x, along z
    std::vector<bool> connected() const {
        std::vector<bool> seen(open_x.size());
        std::vector<int> stack{0};
        while (!stack.empty()) {
            const int at = stack.back();
            stack.pop_back();
            if (seen[static_cast<std::size_t>(at)]) continue;
            seen[static_cast<std::size_t>(at)] = true;
            for (const int next : neighbours(at))
                if (is_open(at, next)) stack.push_back(next);
        }
        return seen;
    }
    std::vector<int> neighbours(int at) const {
        const int x = at % size, z = at / size;
        std::vector<int> list;
        if (x > 0) list.push_back(at - 1);
        if (x < size - 1) list.push_back(at + 1);
        if (z > 0) list.push_back(at - size);
        if (z < size - 1) list.push_back(at + size);
        return list;
    }
    std::vector<bool>::reference between(int a, int b) {
        return (std::abs(a - b) == 1 ? open_x : open_z)[static_cast<std::size_t>(std::min(a, b))];
    }
    bool is_open(int a, int b) const {
        return (std::abs(a - b) == 1 ? open_x : open_z)[static_cast<std::size_t>(std::min(a, b))];
    }
};

inline Maze maze_of(std::uint64_t seed, int size, bool closed) {
    std::mt19937_64 random(seed);
    Maze maze{size, std::vector<bool>(static_cast<std::size_t>(size * size)), {}};
    maze.open_z = maze.open_x;
    std::vector<bool> seen = maze.open_x;
    std::vector<int> stack{0}, path;
    seen[0] = true;
    while (!stack.empty()) {
        std::vector<int> next = maze.neighbours(stack.back());
        std::erase_if(next, [&](int at) { return bool(seen[static_cast<std::size_t>(at)]); });
        if (stack.back() == size * size - 1) path = stack;
        if (next.empty()) {
            stack.pop_back();
            continue;
        }
        const int to = next[random() % next.size()];
        maze.between(stack.back(), to) = true;
        seen[static_cast<std::size_t>(to)] = true;
        stack.push_back(to);
    }
    if (closed) {
        const std::size_t at = random() % (path.size() - 1);
        maze.between(path[at], path[at + 1]) = false;
    }
    return maze;
}

inline ReachScene maze_scene(const Draw& draw, const Maze& maze) {
    constexpr double tile = 2.0, thick = 0.1;
    const int size = maze.size;
    Shapes shapes;
    shapes.floor({0, 0, 0}, {tile * size, 0, tile * size}, tile);
    for (int i = 0; i <= size; i += size) {
        shapes.box({tile * i - thick, 0, 0}, {tile * i + thick, wall_m, tile * size});
        shapes.box({0, 0, tile * i - thick}, {tile * size, wall_m, tile * i + thick});
    }
    for (int at = 0; at < size * size; ++at) {
        const int x = at % size, z = at / size;
        if (x < size - 1 && !maze.is_open(at, at + 1))
            shapes.box({tile * (x + 1) - thick, 0, tile * z},
                       {tile * (x + 1) + thick, wall_m, tile * (z + 1)});
        if (z < size - 1 && !maze.is_open(at, at + size))
            shapes.box({tile * x, 0, tile * (z + 1) - thick},
                       {tile * (x + 1), wall_m, tile * (z + 1) + thick});
    }
    return finished(shapes, draw, {1, 0, 1}, {tile * size - 1, 0, tile * size - 1});
}

// Whether the target can be reached is `fraction` <= 1.
struct KnownScene {
    const char* name;
    bool sized;  // else all fractions up to 1 are alike, and all beyond
    double (*maximum)(const Draw&, int starts);
    ReachScene (*make)(const Draw&, double fraction, double maximum);
};

inline const std::vector<KnownScene>& known_scenes() {
    const auto none = [](const Draw&, int) { return 1.0; };
    const auto ledge = [](const Draw& draw, int starts) { return max_possible(draw.settings, true, starts); };
    static const std::vector<KnownScene> list{
        {"gap", true, [](const Draw& draw, int starts) { return max_possible(draw.settings, false, starts); },
         [](const Draw& draw, double fraction, double maximum) {
             return gap_scene(draw.settings, fraction * maximum, 0.0, draw.in(0, 0.0, 6.28));
         }},
        {"ledge", true, ledge,
         [](const Draw& draw, double fraction, double maximum) {
             return gap_scene(draw.settings, 0.5, fraction * maximum, draw.in(0, 0.0, 6.28));
         }},
        {"spiral", true, ledge, spiral_scene},
        {"bounce chain", true,
         [](const Draw& draw, int starts) {
             const auto make = [&](double size) { return bounce_scene(draw, size, 1, 0.0); };
             return largest_possible(make, 8.0, starts);
         },
         [](const Draw& draw, double fraction, double maximum) {
             return bounce_scene(draw, fraction * maximum, 3, draw.in(5, 0.0, 6.28));
         }},
        {"ice run-up", true,
         [](const Draw& draw, int starts) {
             const auto make = [&](double size) { return ice_scene(draw, size, 0.0); };
             return largest_possible(make, 12.0, starts);
         },
         [](const Draw& draw, double fraction, double maximum) {
             const double more = fraction > 1.0 ? 1.0 : 0.0;
             return ice_scene(draw, fraction * maximum + more, draw.in(5, 0.0, 6.28));
         }},
        {"ferry", true, gap_from_ferry, ferry_scene},
        {"two ferries", false, none, relay_scene},
        {"hole", true, none, hole_scene},
        {"door", true, none, room_scene},
        {"maze", false, none,
         [](const Draw& draw, double fraction, double) {
             const int size = 4 + static_cast<int>(draw.in(0, 0.0, 4.0));
             return maze_scene(draw, maze_of(draw.seed, size, fraction > 1.0));
         }},
        {"drop", false, ledge, drop_scene},
    };
    return list;
}

}  // namespace slipface::test
