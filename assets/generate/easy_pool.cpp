#include "easy.h"
#include "shapes.h"

namespace slipface::generate {
namespace {

void add_brazier(Model& model, double x, double z) {
    lathe(model, "bronze", {x, floor_y, z},
          {{0.34, 0},
           {0.34, 0.12},
           {0.12, 0.25},
           {0.1, 0.95},
           {0.34, 1.15},
           {0.44, 1.35},
           {0.36, 1.35},
           {0.3, 1.22}},
          10, 0, "bronze");
    lathe(model, "crystal", {x, floor_y + 1.2, z}, {{0.2, 0}, {0.24, 0.2}, {0.0, 0.75}}, 6);
}

}  // namespace

// The frozen pool, sunk by four steps all round, with a turning millstone in the ice.
void add_pool(Model& model) {
    model.begin_group("pool");
    const double x = 5.0, south = -6.5, north = -19.0, tread = 0.35, rise = 0.25;
    const int steps = 4;
    for (int i = 0; i < steps; ++i) {
        const double inset = tread * i, next = tread * (i + 1);
        const double top = floor_y - rise * i, y = top - rise;
        const std::array<Vec3, 4> outer{Vec3(x - inset, y, south - inset), Vec3(x - inset, y, north + inset),
                                        Vec3(-x + inset, y, north + inset),
                                        Vec3(-x + inset, y, south - inset)};
        const std::array<Vec3, 4> inner{Vec3(x - next, y, south - next), Vec3(x - next, y, north + next),
                                        Vec3(-x + next, y, north + next), Vec3(-x + next, y, south - next)};
        for (std::size_t a = 0; a < 4; ++a) {
            const std::size_t b = (a + 1) % 4;
            wall(model, "tile_teal", outer[b], outer[a], top);
            if (i + 1 < steps) model.face("stone_trim", {outer[a], outer[b], inner[b], inner[a]});
        }
    }
    const double inset = tread * (steps - 1), ice_y = floor_y - rise * steps;
    std::vector<double> xs, zs;
    for (int i = 0; i <= 4; ++i)
        xs.push_back((x - inset) * (0.5 * i - 1.0));
    for (int i = 0; i <= 6; ++i)
        zs.push_back(north + inset + (south - north - 2 * inset) * i / 6);
    grid_floor(model, xs, zs, ice_y, [](double, double) { return "ice_floor"; });

    ramp(model, "stone_floor", "stone_trim",
         {.left = {1.25, ice_y, -9.5},
          .ahead = Vec3::UnitZ(),
          .width = 2.5,
          .run = 3,
          .height = 1,
          .back = false});

    const Vec3 centre(0, ice_y, 0.5 * (south + north));
    lathe(model, "stone_trim", centre, {{2.7, 0}, {2.65, 0.15}, {2.4, 0.2}}, 32);
    disc(model, "turntable_stone", centre + Vec3(0, 0.2, 0), 2.4, 32);

    for (const double side : {-5.6, 5.6}) {
        for (const double z : {-5.9, -19.6})
            add_brazier(model, side, z);
    }
}

}  // namespace slipface::generate
