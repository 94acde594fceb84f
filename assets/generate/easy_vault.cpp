#include "easy.h"
#include "shapes.h"

namespace slipface::generate {
namespace {

constexpr int vault_segments = 7;
constexpr double apse_radius = 6.0;
constexpr double apse_rise = 4.6;
constexpr double dais_y = 0.0;

double vault_deg(int i) {
    return 180.0 * i / vault_segments;
}

// A point of the vault's profile, `inset` metres in from it.
Vec3 vault_point(int i, double z, double inset = 0.0) {
    return {(nave_x - inset) * cos_deg(vault_deg(i)),
            springing_y + (vault_rise - inset) * sin_deg(vault_deg(i)), z};
}

Vec3 apse_point(int i, double z) {
    return {apse_radius * cos_deg(vault_deg(i)), springing_y + apse_rise * sin_deg(vault_deg(i)), z};
}

void add_rib(Model& model, double z) {
    const double half = 0.3, inset = 0.28;
    for (int i = 0; i < vault_segments; ++i) {
        const Vec3 a = vault_point(i, 0, inset), b = vault_point(i + 1, 0, inset);
        const Vec3 outer_a = vault_point(i, 0), outer_b = vault_point(i + 1, 0);
        const Vec3 south(0, 0, z + half), north(0, 0, z - half);
        model.face("stone_trim", {a + north, a + south, b + south, b + north});
        model.face("stone_trim", {a + south, outer_a + south, outer_b + south, b + south});
        model.face("stone_trim", {b + north, outer_b + north, outer_a + north, a + north});
    }
}

// The round window over the entrance, in relief on the wall: a ring, spokes and glass.
void add_rose_window(Model& model) {
    const Vec3 centre(0, 9.4, south_z);
    const int sides = 16;
    const auto around = [&](int i, double radius, double out) {
        const double angle = 360.0 * (i % sides) / sides;
        return Vec3(centre + Vec3(-radius * cos_deg(angle), radius * sin_deg(angle), -out));
    };
    std::vector<Vec3> glass;
    for (int i = 0; i < sides; ++i) {
        model.face("stone_trim", {around(i, 2.4, 0), around(i + 1, 2.4, 0), around(i + 1, 2.25, 0.3),
                                  around(i, 2.25, 0.3)});
        model.face("stone_trim", {around(i, 2.25, 0.3), around(i + 1, 2.25, 0.3), around(i + 1, 1.95, 0.3),
                                  around(i, 1.95, 0.3)});
        model.face("stone_trim", {around(i, 1.95, 0.3), around(i + 1, 1.95, 0.3), around(i + 1, 1.9, 0.1),
                                  around(i, 1.9, 0.1)});
        glass.push_back(around(i, 1.9, 0.1));
    }
    std::vector<Corner> pane;
    for (const Vec3& point : glass) {
        pane.push_back(
            {point, Vec2(0.5 - (point.x() - centre.x()) / 3.8, 0.5 + (point.y() - centre.y()) / 3.8)});
    }
    model.face_uv("rose_glass", pane);
}

void add_shell(Model& model) {
    const int rows = 3;
    const auto point = [](int i, int row) {
        const double back = 90.0 * row / rows;
        return Vec3(apse_radius * cos_deg(vault_deg(i)) * cos_deg(back),
                    springing_y + apse_rise * sin_deg(vault_deg(i)) * cos_deg(back),
                    north_z - apse_radius * sin_deg(back));
    };
    for (int i = 0; i < vault_segments; ++i) {
        model.face("stone_trim", {apse_point(i, north_z), vault_point(i, north_z),
                                  vault_point(i + 1, north_z), apse_point(i + 1, north_z)});
        for (int row = 0; row < rows; ++row) {
            std::vector<Vec3> corners{point(i, row + 1), point(i, row), point(i + 1, row),
                                      point(i + 1, row + 1)};
            if (row + 1 == rows) corners.pop_back();
            model.face("apse_mosaic", corners);
        }
    }
}

void add_crystal(Model& model, const Vec3& foot, const Vec3& axis, double radius, double length) {
    const Vec3 along = axis.normalized();
    const Vec3 u = along.cross(Vec3::UnitZ()).normalized();
    const Vec3 v = along.cross(u);
    const auto ring = [&](int i, double r, double h) {
        const double angle = 60.0 * (i % 6);
        return Vec3(foot + h * along + r * (cos_deg(angle) * u + sin_deg(angle) * v));
    };
    for (int i = 0; i < 6; ++i) {
        model.face("crystal", {ring(i, 0.8 * radius, 0), ring(i + 1, 0.8 * radius, 0),
                               ring(i + 1, radius, 0.7 * length)});
        model.face("crystal", {ring(i, 0.8 * radius, 0), ring(i + 1, radius, 0.7 * length),
                               ring(i, radius, 0.7 * length)});
        model.face("crystal",
                   {ring(i, radius, 0.7 * length), ring(i + 1, radius, 0.7 * length), foot + length * along});
    }
}

}  // namespace

void add_vault(Model& model) {
    model.begin_group("vault");
    for (int k = 0; k < bays; ++k) {
        const double z1 = south_z - bay * k, z0 = z1 - bay;
        if (k > 0) add_rib(model, z1);
        for (int i = 0; i < vault_segments; ++i) {
            const bool skylight = i == vault_segments / 2;
            coffer(model, "stone_trim", skylight ? "sky" : "coffer_panel",
                   {vault_point(i, z0), vault_point(i, z1), vault_point(i + 1, z1), vault_point(i + 1, z0)},
                   skylight ? 0.7 : 0.5, skylight ? 0.9 : 0.35);
        }
    }
    std::vector<Vec3> tympanum;
    for (int i = vault_segments; i >= 0; --i)
        tympanum.push_back(vault_point(i, south_z));
    model.face("plaster", tympanum);
    add_rose_window(model);
}

void add_apse(Model& model) {
    model.begin_group("apse");
    stairs(model, "stone_floor", "stone_trim",
           {.left = {-6, floor_y, -24},
            .ahead = -Vec3::UnitZ(),
            .width = 12,
            .count = 5,
            .rise = 0.2,
            .tread = 0.4,
            .landing = 3.0,
            .back = false});
    for (const double side : {-1.0, 1.0}) {
        const double x0 = side < 0 ? -nave_x : apse_radius, x1 = side < 0 ? -apse_radius : nave_x;
        // In two pieces: one as high as the hall is too slender for its many corners.
        wall(model, "stone_trim", {x0, floor_y, north_z}, {x1, floor_y, north_z}, gallery_y);
        wall(model, "stone_trim", {x0, gallery_y, north_z}, {x1, gallery_y, north_z}, springing_y);
    }
    const auto rim = [](int i) {
        const double angle = 180.0 - 30.0 * i;
        return Vec3(apse_radius * cos_deg(angle), dais_y, north_z - apse_radius * sin_deg(angle));
    };
    std::vector<Vec3> dais;
    for (int i = 6; i >= 0; --i)
        dais.push_back(rim(i));
    model.face("mosaic_floor", dais);
    for (int i = 0; i < 6; ++i) {
        const ArchShape window{.from = rim(i),
                               .to = rim(i + 1),
                               .y0 = dais_y,
                               .y1 = springing_y,
                               .half_width = 0.8,
                               .sill = 2.2,
                               .spring = 5.6,
                               .rise = 0.8,
                               .segments = 8};
        arch_wall(model, "stone_wall", window);
        arch_reveal(model, "stone_trim", window, 0.5, true);
        arch_panel(model, i == 0 || i == 5 ? "tile_teal" : "sky", window, 0.5);
    }
    add_shell(model);

    // The crystal on its plinth: what one sees from the door.
    const Vec3 altar(0, dais_y, -31.0);
    lathe(model, "stone_trim", altar, {{2.2, 0}, {2.2, 0.3}, {1.6, 0.3}, {1.6, 0.6}}, 8, 22.5, "tile_teal");
    const Vec3 foot = altar + Vec3(0, 0.55, 0);
    add_crystal(model, foot, {0, 1, 0}, 0.62, 4.2);
    add_crystal(model, foot + Vec3(0.55, 0, 0.1), {0.45, 1, 0.1}, 0.36, 2.6);
    add_crystal(model, foot + Vec3(-0.55, 0, 0.15), {-0.5, 1, 0.15}, 0.4, 2.3);
    add_crystal(model, foot + Vec3(0.15, 0, 0.6), {0.15, 1, 0.6}, 0.3, 1.7);
    add_crystal(model, foot + Vec3(-0.2, 0, -0.55), {-0.2, 1, -0.55}, 0.33, 2.1);
}

}  // namespace slipface::generate
