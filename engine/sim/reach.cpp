#include "slipface/sim/reach.h"

#include <algorithm>
#include <cmath>

#include "slipface/collision/collision_world.h"

namespace slipface {
namespace {

constexpr double floor_length_m = 4000.0, floor_width_m = 1000.0;

// A floor at y = 0 that ends at x = 0; ahead is +X.
class Floor {
  public:
    Floor() {
        const auto length = static_cast<float>(floor_length_m), width = static_cast<float>(floor_width_m);
        const std::vector<Vec3f> corners{
            {-length, 0, -width}, {-length, 0, width}, {0, 0, width}, {0, 0, -width}};
        const std::vector<std::array<std::uint32_t, 3>> triangles{{0, 1, 2}, {0, 2, 3}};
        const std::vector<FaceId> faces{0, 0};
        Result<CollisionWorld> built = CollisionWorld::build({corners, triangles, faces, {}});
        if (built) world_ = std::move(*built);
    }
    MovementScene scene() const { return {world_, surfaces_}; }

  private:
    std::vector<SurfaceType> surfaces_{SurfaceType{}};
    CollisionWorld world_;
};

const PlayerInput ahead{Vec2(1, 0), {}}, ahead_jump{Vec2(1, 0), Button::jump}, rest{},
    rest_jump{Vec2::Zero(), Button::jump};

constexpr int longest_ticks = 60 * 60;

class Walker {
  public:
    Walker(const MovementSettings& settings, double dt, double x)
        : settings_(settings), dt_(dt), scene_(floor().scene()) {
        state.position = Vec3(x, settings.radii.y() + 2.0 * settings.skin, 0.0);
        for (int i = 0; i < 30 && !state.grounded; ++i)
            tick(rest);
    }
    void tick(const PlayerInput& input) { state = step(scene_, settings_, state, input, dt_).state; }
    // Walks until no tick makes it faster.
    void run_up() {
        for (int i = 0; i < longest_ticks; ++i) {
            const double before = state.velocity.x();
            tick(ahead);
            if (!(state.velocity.x() > before)) break;
        }
    }
    PlayerState state;

  private:
    static const Floor& floor() {
        static const Floor one;
        return one;
    }
    MovementSettings settings_;
    double dt_;
    MovementScene scene_;
};

JumpArc fly(Walker walker, double dt, const PlayerInput& pressed, const PlayerInput& then) {
    JumpArc arc;
    const Vec3 origin = walker.state.position;
    arc.path.emplace_back(0.0, 0.0);
    for (int i = 0; i < longest_ticks; ++i) {
        walker.tick(i == 0 ? pressed : then);
        const Vec3 moved = walker.state.position - origin;
        arc.path.emplace_back(moved.x(), moved.y());
        arc.height_m = std::max(arc.height_m, moved.y());
        arc.duration_s = (i + 1) * dt;
        if (walker.state.grounded) break;
    }
    arc.distance_m = arc.path.back().x();
    return arc;
}

}  // namespace

bool jumps_in_air(const MovementSettings& settings) {
    return settings.air_jump || settings.wall_jump;
}

Reach measure_reach(const MovementSettings& settings, double dt) {
    Reach reach;
    Walker runner(settings, dt, -0.5 * floor_length_m);
    reach.standing = fly(runner, dt, rest_jump, rest_jump);
    const double started = runner.state.position.x();
    runner.run_up();
    const double run_up_m = runner.state.position.x() - started;
    reach.top_speed = runner.state.velocity.x();
    reach.running = fly(runner, dt, ahead_jump, ahead_jump);
    reach.tapped = fly(runner, dt, ahead_jump, ahead);
    Walker stopping = runner;
    for (int i = 0; i < longest_ticks && std::abs(stopping.state.velocity.x()) > 1e-6; ++i)
        stopping.tick(rest);
    reach.stopping_m = stopping.state.position.x() - runner.state.position.x();

    // Off the edge at full speed, the jump pressed ever later.
    Walker edge(settings, dt, -run_up_m - 4.0 * settings.radii.x());
    for (int i = 0; i < longest_ticks && edge.state.grounded; ++i)
        edge.tick(ahead);
    const double left_at = edge.state.position.x();
    for (int waited = 1; waited < 120; ++waited) {
        Walker late = edge;
        late.tick(ahead_jump);
        if (!(late.state.velocity.y() > 0.0)) break;
        reach.coyote_ticks = waited;
        reach.coyote_m = edge.state.position.x() - left_at;
        edge.tick(ahead);
    }
    return reach;
}

}  // namespace slipface
