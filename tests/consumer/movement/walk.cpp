#include <slipface/base/hash.h>
#include <slipface/movement/step.h>

#include <cstdio>

// A game that has triangles of its own: one player walks for two seconds on a square of 60 m.
int main() {
    const std::array<slipface::Vec3f, 4> corners{{{-30, 0, -30}, {-30, 0, 30}, {30, 0, 30}, {30, 0, -30}}};
    const std::array<std::array<std::uint32_t, 3>, 2> triangles{{{0, 1, 2}, {0, 2, 3}}};
    const std::array<slipface::FaceId, 2> faces{0, 0};
    auto world =
        slipface::CollisionWorld::build({.positions = corners, .triangles = triangles, .faces = faces});
    if (!world) return std::puts(world.error().text().c_str()), 2;

    const std::vector<slipface::SurfaceType> surfaces(1);
    const slipface::MovementSettings settings;
    slipface::PlayerState player{.position = {0, 2, 0}};
    slipface::Hasher hash;
    for (int tick = 0; tick < 120; ++tick) {
        player = slipface::step({.collision = *world, .surfaces = surfaces}, settings, player,
                                {.wish = {0, -1}}, 1.0 / 60)
                     .state;
        for (const double number : player.position)
            hash.f64(number);
    }
    std::printf("at %.2f %.2f %.2f, %s, hash %016llx\n", player.position.x(), player.position.y(),
                player.position.z(), player.grounded ? "on the ground" : "in the air",
                static_cast<unsigned long long>(hash.value()));
    return player.grounded && player.position.z() < -1 ? 0 : 1;
}
