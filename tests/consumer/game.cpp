#include <slipface/level/level_file.h>
#include <slipface/render/gl_graphics.h>
#include <slipface/world/geometric_manager.h>

#include <cstdio>

// The world as a camera behind the player sees it. A game with a window binds its own framebuffer instead.
slipface::Status draw(slipface::World& world, const slipface::Vec3& player, const char* png) {
    auto context = slipface::make_offscreen_context();
    if (!context) return context.error();
    slipface::Framebuffer target((*context)->gl(), 1280, 720);
    slipface::GlGraphics graphics((*context)->gl());
    graphics.style.overlay = 0.0f;  // textures without the colours of the surface types
    slipface::Camera camera;
    camera.eye = player + slipface::Vec3(0, 2, 5);
    camera.target = player;
    target.bind();
    graphics.begin_frame(camera, target.width(), target.height());
    world.draw(graphics);
    if (auto drawn = graphics.end_frame(); !drawn) return drawn;
    return slipface::save_png(png, target.read());
}

int main(int argc, char** argv) {
    auto loaded = slipface::load_level(argc > 1 ? argv[1] : "assets/levels/easy.obj");
    if (!loaded) return std::puts(loaded.error().text().c_str()), 2;
    auto geometry = slipface::GeometricManager::make(std::move(loaded->level));
    if (!geometry) return std::puts(geometry.error().text().c_str()), 2;

    slipface::World world;
    auto& level = static_cast<slipface::GeometricManager&>(world.add_manager(std::move(*geometry)));
    auto& player = world.make_entity<slipface::Character>();
    player.state = level.player_at(level.level().spawn);
    player.input.wish = {0, -1};  // walk along -Z
    for (int tick = 0; tick < 120; ++tick)
        world.tick(1.0 / 60);

    const slipface::Vec3 at = player.position();
    const auto& ground = level.level().surfaces[player.state.ground_surface];
    std::printf("at %.2f %.2f %.2f on %s\n", at.x(), at.y(), at.z(), ground.name.c_str());
    if (argc < 3) return 0;
    const auto drawn = draw(world, at, argv[2]);
    return drawn ? 0 : (std::puts(drawn.error().text().c_str()), 2);
}
