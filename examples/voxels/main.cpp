// voxels [STEPS [SEED [IMAGE]]]: walkers in a world of blocks without end and on a dome of triangles above
// it, STEPS steps in all. Counts those that ended inside a block or fell through the rock, and draws the last
// sight. Exit code 1 if there was one, or if nobody stood on the blocks or on the dome.
#include <slipface/mesh/build.h>
#include <slipface/render/gl_graphics.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <random>

#include "voxel_manager.h"

using namespace slipface;

static int draw(World& world, const Vec3& eye_at, const char* file) {
    auto context = make_offscreen_context();
    if (!context) return std::fprintf(stderr, "%s\n", context.error().text().c_str()), 1;
    Framebuffer target((*context)->gl(), 1280, 720);
    GlGraphics graphics((*context)->gl());
    Camera camera;
    camera.target = eye_at;
    camera.eye = eye_at + Vec3(14, 12, 18);
    target.bind();
    graphics.begin_frame(camera, target.width(), target.height());
    world.draw(graphics);
    if (const Status drawn = graphics.end_frame(); !drawn)
        return std::fprintf(stderr, "%s\n", drawn.error().text().c_str()), 1;
    const Status written = save_png(file, target.read());
    if (!written) return std::fprintf(stderr, "%s\n", written.error().text().c_str()), 1;
    return 0;
}

// A shallow cone of triangles, as another tool would make it.
static Level dome(const Vec3& top, float radius) {
    PolygonSoup soup;
    soup.face_first_corner.push_back(0);
    for (int i = 0; i < 24; ++i) {
        soup.corner_position.push_back(top.cast<float>());
        for (const int k : {i + 1, i}) {
            const float angle = static_cast<float>(k) * 0.2617994F;
            soup.corner_position.emplace_back(top.cast<float>() +
                                              radius * Vec3f(std::cos(angle), -0.2F, std::sin(angle)));
        }
        soup.face_first_corner.push_back(static_cast<std::uint32_t>(soup.corner_position.size()));
    }
    Level level;
    level.mesh = build_mesh(std::move(soup)).value();
    return level;
}

int main(int count, char** words) {
    const std::uint64_t steps = count > 1 ? std::strtoull(words[1], nullptr, 10) : 20'000;
    std::mt19937_64 random(count > 2 ? std::strtoull(words[2], nullptr, 10) : 1);
    World world;
    auto& level = static_cast<GeometricManager&>(
        world.add_manager(GeometricManager::make(dome({0.0, 30.0, 0.0}, 12.0F)).value()));
    auto& voxels = world.make_manager<VoxelManager>(hills(random()), 1, &level);
    std::vector<Walker*> walkers;
    for (int i = 0; i < 4; ++i) {
        Walker& walker = world.make_entity<Walker>();
        walker.state.position = Vec3(0.5 + 200.0 * i, 40.0, 0.5);
        walkers.push_back(&walker);
    }
    std::uint64_t inside = 0, lost = 0, on_blocks = 0, on_dome = 0;
    for (std::uint64_t tick = 0; tick * walkers.size() < steps; ++tick) {
        for (Walker* walker : walkers) {
            if (random() % 40 == 0) {
                const double angle = static_cast<double>(random() % 6283) * 1e-3;
                walker->input.wish = {std::cos(angle), std::sin(angle)};
            }
            walker->input.buttons.set(Button::jump, random() % 60 == 0);
        }
        world.tick(1.0 / 60.0);
        for (Walker* walker : walkers) {
            const PlayerState& state = walker->state;
            (state.ground_platform == no_id ? on_dome : on_blocks) += state.grounded;
            lost += !(state.position.y() > -40.0);
            const MovementScene scene = voxels.scene_at(state.position);
            bool overlaps = overlaps_any(scene.collision, walker->settings.radii, state.position);
            for (const MovingPart& chunk : scene.platforms)
                overlaps = overlaps || overlaps_any(chunk.at_end(), walker->settings.radii, state.position);
            inside += overlaps;
        }
    }
    std::printf(
        "%llu steps, %llu on blocks, %llu on the dome, %llu inside a block, %llu lost; %zu chunks built, %zu "
        "there\n",
        static_cast<unsigned long long>(steps), static_cast<unsigned long long>(on_blocks),
        static_cast<unsigned long long>(on_dome), static_cast<unsigned long long>(inside),
        static_cast<unsigned long long>(lost), voxels.built_count(), voxels.chunk_count());
    const bool bad = inside > 0 || lost > 0 || on_blocks == 0 || on_dome == 0;
    if (count > 3 && draw(world, walkers.front()->state.position, words[3]) != 0) return 2;
    return bad ? 1 : 0;
}
