#include <slipface/level/level_file.h>
#include <slipface/world/geometric_manager.h>

#include <cstdio>

int main(int argc, char** argv) {
    auto loaded = slipface::load_level(argc > 1 ? argv[1] : "assets/levels/easy.obj");
    if (!loaded) return std::puts(loaded.error().text().c_str()), 2;
    auto geometry = slipface::GeometricManager::make(std::move(loaded->level));
    if (!geometry) return std::puts(geometry.error().text().c_str()), 2;

    slipface::World world;
    auto& level = static_cast<slipface::GeometricManager&>(world.add_manager(std::move(*geometry)));
    auto& player = world.make_entity<slipface::Character>();
    player.state.position = level.level().spawn;
    player.input.wish = {0, -1};  // walk along -Z
    for (int tick = 0; tick < 120; ++tick)
        world.tick(1.0 / 60);

    const auto& at = player.state.position;
    const auto& ground = level.level().surfaces[player.state.ground_surface];
    std::printf("at %.2f %.2f %.2f on %s\n", at.x(), at.y(), at.z(), ground.name.c_str());
}
