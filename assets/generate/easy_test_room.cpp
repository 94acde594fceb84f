#include <cstdint>

#include "easy.h"
#include "labels.h"
#include "shapes.h"
#include "test_room.h"

namespace slipface::generate {
namespace {

constexpr double dado_y = 0.2;

// A wall in pieces of 4 or 5 m: stone below, plaster above.
void add_wall_run(Model& model, const Vec3& from, const Vec3& to, int pieces) {
    for (int i = 0; i < pieces; ++i) {
        const Vec3 a = from + (to - from) * i / pieces, b = from + (to - from) * (i + 1) / pieces;
        wall(model, "stone_wall", a, b, dado_y);
        wall(model, "plaster", {a.x(), dado_y, a.z()}, {b.x(), dado_y, b.z()}, room.top - 0.6);
        wall(model, "tile_teal", {a.x(), room.top - 0.6, a.z()}, {b.x(), room.top - 0.6, b.z()}, room.top);
    }
}

void add_walls(Model& model) {
    const double y = floor_y;
    add_wall_run(model, {room.west, y, room.north}, {room.east, y, room.north}, 8);
    add_wall_run(model, {room.east, y, room.south}, {room.west, y, room.south}, 8);
    add_wall_run(model, {room.west, y, room.south}, {room.west, y, room.north}, 8);
    add_wall_run(model, {room.east, y, room.north}, {room.east, y, -14}, 3);
    add_wall_run(model, {room.east, y, -9}, {room.east, y, room.south}, 4);
    arch_wall(model, "stone_wall",
              {.from = {room.east, y, -14},
               .to = {room.east, y, -9},
               .y0 = y,
               .y1 = room.top,
               .half_width = 1.5,
               .sill = y,
               .spring = 1.4,
               .rise = 1.2,
               .segments = 10});
}

void add_ceiling(Model& model) {
    const int columns = 4, rows = 5;
    const double width = (room.east - room.west) / columns, depth = (room.south - room.north) / rows;
    for (int row = 0; row < rows; ++row) {
        for (int column = 0; column < columns; ++column) {
            const double x0 = room.west + width * column, x1 = x0 + width;
            const double z0 = room.north + depth * row, z1 = z0 + depth;
            coffer(model, "plaster", (row + column) % 2 == 0 ? "sky" : "coffer_panel",
                   {Vec3(x0, room.top, z0), Vec3(x1, room.top, z0), Vec3(x1, room.top, z1),
                    Vec3(x0, room.top, z1)},
                   1.0, 0.6);
        }
    }
}

// One plane of irregular triangles and quads: a player that walks over it must not feel a seam.
void add_seam_field(Model& model) {
    const int cells = 15;
    const auto noise = [](int i, int j, std::uint32_t salt) {
        std::uint32_t bits =
            static_cast<std::uint32_t>(i) * 73856093U ^ static_cast<std::uint32_t>(j) * 19349663U ^ salt;
        bits = (bits ^ (bits >> 13U)) * 0x5bd1e995U;
        return bits ^ (bits >> 15U);
    };
    const auto point = [&](int i, int j) {
        const double step = (seam_field.east - seam_field.west) / cells;
        double x = seam_field.west + step * i, z = seam_field.north + step * j;
        const auto jitter = [&](std::uint32_t salt) {
            return step * 0.46 * (static_cast<double>(noise(i, j, salt) % 1000U) / 999.0 - 0.5);
        };
        // The border's corners are those of the floor around it, and others between them.
        if (i > 0 && i < cells && j > 0 && j < cells) {
            x += jitter(0x1234567U);
            z += jitter(0x89abcdeU);
        }
        return Vec3(x, floor_y, z);
    };
    for (int j = 0; j < cells; ++j) {
        for (int i = 0; i < cells; ++i) {
            const Vec3 a = point(i, j + 1), b = point(i + 1, j + 1), c = point(i + 1, j), d = point(i, j);
            const std::uint32_t kind = noise(i, j, 0x51f15eU) % 3U;
            if (kind == 0) {
                model.face("seam_floor", {a, b, c, d});
            } else if (kind == 1) {
                model.face("seam_floor", {a, b, c});
                model.face("seam_floor", {a, c, d});
            } else {
                model.face("seam_floor", {a, b, d});
                model.face("seam_floor", {b, c, d});
            }
        }
    }
}

void add_half_pipe(Model& model) {
    const int segments = 24, pieces = 7;
    const double radius = 0.5 * (pipe.south - pipe.north), middle = 0.5 * (pipe.south + pipe.north);
    const auto point = [&](int i, double x) {
        const double angle = 180.0 * i / segments;
        return Vec3(x, floor_y - radius * sin_deg(angle), middle + radius * cos_deg(angle));
    };
    const double arc = 2 * radius * sin_deg(90.0 / segments) / 3;  // of one segment, in texture tiles
    std::vector<Vec3> west_end, east_end;
    for (int i = 0; i <= segments; ++i) {
        west_end.push_back(point(i, pipe.west));
        east_end.insert(east_end.begin(), point(i, pipe.east));
    }
    for (int i = 0; i < segments; ++i) {
        for (int k = 0; k < pieces; ++k) {
            const double x0 = pipe.west + (pipe.east - pipe.west) * k / pieces;
            const double x1 = pipe.west + (pipe.east - pipe.west) * (k + 1) / pieces;
            const double upper = arc * i, lower = arc * (i + 1);
            model.face_uv("ice_pipe", {{point(i + 1, x1), {x1 / 3, lower}},
                                       {point(i + 1, x0), {x0 / 3, lower}},
                                       {point(i, x0), {x0 / 3, upper}},
                                       {point(i, x1), {x1 / 3, upper}}});
        }
    }
    model.face("stone_wall", west_end);
    model.face("stone_wall", east_end);

    const double bottom = floor_y - radius, x = pipe.east - 0.12;
    for (int i = 0; i < 3; ++i) {
        const double y0 = bottom + i, y1 = y0 + 1;
        model.face_uv("ladder_wood", {{{x, y0, middle - 0.5}, {0, y0}},
                                      {{x, y0, middle + 0.5}, {1, y0}},
                                      {{x, y1, middle + 0.5}, {1, y1}},
                                      {{x, y1, middle - 0.5}, {0, y1}}});
    }
    box(model, "wood_planks", {x, bottom, middle - 0.5}, {pipe.east, floor_y, middle + 0.5},
        side_north | side_south | side_top);
}

}  // namespace

void add_test_room(Model& model) {
    model.begin_group("test_room");
    add_walls(model);
    add_ceiling(model);
    std::vector<double> xs, zs;
    for (double x = room.west; x <= room.east; x += 2)
        xs.push_back(x);
    for (double z = room.north; z <= room.south; z += 2)
        zs.push_back(z);
    grid_floor(model, xs, zs, floor_y, [](double x, double z) {
        return pipe.contains(x, z) || seam_field.contains(x, z) ? "" : "test_floor";
    });
    model.begin_group("test_seams");
    add_seam_field(model);
    model.begin_group("test_half_pipe");
    add_half_pipe(model);
}

}  // namespace slipface::generate
