#include "hard.h"

#include <algorithm>
#include <cmath>

#include "painting.h"
#include "shapes.h"
#include "wild.h"

namespace slipface::generate {
namespace {

constexpr double ember_y = -4.0;

// Distance into a round chamber, metres: above 0 inside.
double into(double x, double z, double cx, double cz, double rx, double rz) {
    const double dx = (x - cx) / rx, dz = (z - cz) / rz;
    return (1.0 - std::sqrt(dx * dx + dz * dz)) * std::min(rx, rz);
}

// Distance into the pass from (ax, az) to (bx, bz).
double into_pass(double x, double z, double ax, double az, double bx, double bz, double half) {
    const double lx = bx - ax, lz = bz - az;
    const double t = std::clamp(((x - ax) * lx + (z - az) * lz) / (lx * lx + lz * lz), 0.0, 1.0);
    const double dx = x - ax - t * lx, dz = z - az - t * lz;
    return half - std::sqrt(dx * dx + dz * dz);
}

double in_proving(double x, double z) {
    return std::min({x - 34.0, 70.0 - x, z + 36.0, 4.0 - z});
}

double depth_into_cave(double x, double z) {
    return std::max({into(x, z, 0, -16, 28, 24), in_proving(x, z), into_pass(x, z, 22, -14, 38, -12, 4.6),
                     into(x, z, -40, -28, 9, 8), into_pass(x, z, -22, -22, -36, -28, 3.4)});
}

double rough(double x, double z, std::uint32_t seed) {
    return cloud(x / 64.0 + 4.0, z / 64.0 + 4.0, 8, 3, seed) - 0.5;
}

// 1 where people levelled the ground: the landing place, the proving ground, the crypt.
double levelled(double x, double z) {
    const double landing = ramp_between(-1.0, 2.5, into(x, z, 0, 1.0, 8.5, 6.5));
    const double proving = ramp_between(1.5, 4.0, in_proving(x, z));
    const double crypt = ramp_between(0.5, 3.0, into(x, z, -40, -28, 9, 8));
    return std::max({landing, proving, crypt});
}

double lake(double x, double z) {
    return ramp_between(-2.0, 3.0, into(x, z, 0, -18, 13.5, 10.5));
}

double roof(double x, double z) {
    const double d = std::max(0.0, depth_into_cave(x, z));
    const double hall = 17.0 * std::sqrt(std::clamp(into(x, z, 0, -16, 28, 24) / 22.0, 0.0, 1.0));
    const double proving = 9.5 * std::sqrt(std::clamp(in_proving(x, z) / 9.0, 0.0, 1.0));
    const double low = 5.2 * std::sqrt(std::clamp(d / 3.2, 0.0, 1.0));
    return -1.0 + std::max({hall, proving, low}) * (1.0 + 0.35 * rough(x, z, 611));
}

bool rim(double x, double z) {
    return depth_into_cave(x, z) < 0.15;
}

std::vector<ModelMaterial> hard_materials() {
    return {
        {"basalt", "basalt", 3.0},
        {"roof_basalt", "basalt", 4.0},
        {"flagstone", "flagstone", 2.5},
        {"rock", "rock", 2.0},
        {"crystal_heart", "crystal", 1.2},
        {"crystal", "crystal", 1.2},
        {"gem", "gem", 1.0},
        {"hazard_embers", "hazard_embers", 3.0},
        {"wood_planks", "wood_planks", 2.0},
        {"wood_floor", "wood_floor", 2.5},
        {"bronze", "bronze", 1.0},
        {"stone_trim", "stone_trim", 2.0},
        {"stone_wall", "stone_wall", 2.0},
        {"step_stone", "step_stone", 2.0},
        {"ramp_stone", "ramp_stone", 2.0},
        {"ramp_steep", "ramp_steep", 2.0},
        {"test_floor", "test_floor", 2.0},
        {"sky", "sky", 8.0},
        {"lamp", "lamp_glass", 1.0},
        {"ice_floor", "ice", 3.0},
        {"ladder_wood", "ladder_wood", 1.0},
        {"sticky_moss", "sticky_moss", 1.6},
        {"bouncy_pad", "bouncy_pad", 1.0},
        {"conveyor_belt", "conveyor_belt", 2.5},
        {"banner_cloth", "banner_cloth", 1.0},
        {"sign_labels", "sign_labels", 1.0},
    };
}

}  // namespace

double hard_floor(double x, double z) {
    if (rim(x, z)) return roof(x, z);
    const double d = depth_into_cave(x, z);
    const double wild =
        -1.0 + 3.2 * rough(x, z, 601) * std::min(1.0, d / 4.0) + 0.10 * std::max(0.0, 8.0 - d);
    const double flat = levelled(x, z);
    const double dry = wild + (-1.0 - wild) * flat;
    const double low = dry + (ember_y - 3.0 - dry) * lake(x, z) * (1.0 - flat);
    return std::min(low, roof(x, z) - 0.4 * std::min(d, 2.0));
}

void add_hard_cave(Model& model) {
    const double step = 2.0;
    Ground sheet{
        .x0 = -52, .z0 = -44, .step = step, .columns = 63, .rows = 28, .jitter = 0.5, .outside = rim};
    sheet.height = hard_floor;
    sheet.material = [&](double x, double z, double steep) -> std::string {
        if (in_proving(x, z) > 3.5) return "test_floor";
        return levelled(x, z) > 0.9 && steep < 0.05 ? "flagstone" : "basalt";
    };
    model.begin_group("cave_floor");
    ground(model, sheet);
    sheet.height = [](double x, double z) { return roof(x, z); };
    sheet.material = [&](double x, double z, double) -> std::string {
        const double hole = into(x, z, 3, -17, 4.2, 3.4);
        const double hole2 = into(x, z, 54, -16, 3.5, 5.0);
        const double hole3 = into(x, z, -40, -28, 1.6, 1.6);
        return hole > 0 || hole2 > 0 || hole3 > 0 ? "sky" : "roof_basalt";
    };
    sheet.faces_up = false;
    model.begin_group("cave_roof");
    ground(model, sheet);
    model.begin_group("embers");
    std::vector<double> xs, zs;
    for (int i = 0; i <= 12; ++i)
        xs.push_back(-15 + 2.5 * i);
    for (int i = 0; i <= 10; ++i)
        zs.push_back(-30.5 + 2.5 * i);
    grid_floor(model, xs, zs, ember_y,
               [](double x, double z) { return into(x, z, 0, -18, 14.5, 12) > 0 ? "hazard_embers" : ""; });
}

Model make_hard() {
    Model model(hard_materials());
    add_hard_cave(model);
    add_hard_crystals(model);
    add_hard_ways(model);
    add_hard_proving(model);
    return model;
}

}  // namespace slipface::generate
