// Players at rest: step() with a Rest gives the bits of step() without.
#include <bit>

#include "slipface/movement/rest.h"
#include "test_geometry.h"

namespace slipface::test {

namespace {

void expect_same(const StepResult& found, const StepResult& expected) {
    ASSERT_EQ(found.state, expected.state);
    for (const auto member : PlayerState::vectors)
        for (int axis = 0; axis < 3; ++axis)
            ASSERT_EQ(std::signbit((found.state.*member)[axis]),
                      std::signbit((expected.state.*member)[axis]));
    for (const auto member : PlayerState::numbers)
        ASSERT_EQ(std::signbit(found.state.*member), std::signbit(expected.state.*member));
    ASSERT_EQ(found.sweeps, expected.sweeps);
    ASSERT_EQ(found.contacts, expected.contacts);
    ASSERT_EQ(found.end_is_free, expected.end_is_free);
    ASSERT_EQ(found.crowded, expected.crowded);
}

// A slab that goes to and fro, up and down.
struct Ferry {
    CollisionWorld rest;
    std::vector<MovingPart> parts;
    PlatformTree tree;
    Vec3 centre, way;
    double period_s;

    explicit Ferry(Random& random)
        : centre(random.between(-8, 8), random.between(-1, 3), random.between(-8, 8)),
          way(random.between(-8, 8), random.between(-2, 2), random.between(-8, 8)),
          period_s(random.between(2, 6)) {
        const std::vector<Vec3f> corners{{-1, 0, -1}, {-1, 0, 1}, {1, 0, 1}, {1, 0, -1}};
        const std::vector<std::array<std::uint32_t, 3>> triangles{{0, 1, 2}, {0, 2, 3}};
        const std::vector<FaceId> faces{0, 0};
        rest = std::move(CollisionWorld::build_movable(
                             {.positions = corners, .triangles = triangles, .faces = faces}))
                   .value();
        parts.resize(1);
        parts[0].rest = &rest;
    }
    Vec3 at(double time_s) const {
        const double turn = time_s / period_s - std::floor(time_s / period_s);
        return centre + way * std::abs(2.0 * turn - 1.0);
    }
    void move(double time_s, double dt) {
        parts[0].begin.offset = at(time_s);
        parts[0].end.offset = at(time_s + dt);
        parts[0].velocity = (at(time_s + dt) - at(time_s)) / dt;
        const std::vector<Aabb> rooms{room_of(parts[0])};
        if (time_s == 0.0) tree.build(rooms);
        tree.refit(rooms);
    }
};

}  // namespace

TEST(Rest, GivesTheBitsOfAStepInAnyLevel) {
    int known = 0, steps = 0, with_ferry = 0;
    for (std::uint64_t seed = 0; seed < 60; ++seed) {
        SCOPED_TRACE(seed);
        Random random(seed);
        Lab lab;
        const FaceId floor = lab.floor();
        for (int i = 0; i < 30; ++i) {
            const Vec3 centre(random.between(-9, 9), random.between(-1, 2), random.between(-9, 9));
            const auto corner = [&] {
                return Vec3(centre +
                            Vec3(random.between(-2, 2), random.between(-1, 1), random.between(-2, 2)));
            };
            lab.polygon({corner(), corner(), corner()}, static_cast<SurfaceId>(random.below(8)));
        }
        lab.ready();
        MovementSettings settings = seed % 3 == 0 ? basic_settings() : MovementSettings{};
        for (const SettingInfo& info : settings_table())
            if (is_switch(info) && random.below(4) == 0)
                (void)set_setting(settings, info, static_cast<double>(random.below(2)));
        std::optional<Ferry> ferry;
        if (seed % 2 == 1) ferry.emplace(random);
        const double dt = seed % 5 == 4 ? 1.0 / 30 : tick;
        for (int player = 0; player < 6; ++player) {
            PlayerState state = at({random.between(-8, 8), random.between(1, 4), random.between(-8, 8)});
            PlayerInput input;
            Rest rest;
            for (int i = 0; i < 360; ++i) {
                if (random.below(90) == 0) input = wish(random.between(-1, 1), random.between(-1, 1));
                if (random.below(20) == 0) input = {};
                if (random.below(120) == 0) settings.walk_speed += 0.5;
                if (random.below(200) == 0)
                    lab.world().set_face_surface(floor, random.below(2) == 0 ? plain : ice);
                MovementScene scene = lab.scene();
                if (ferry) {
                    ferry->move(i * dt, dt);
                    scene.platforms = ferry->parts;
                    scene.tree = &ferry->tree;
                }
                if (rest.find(scene, settings, state, input, dt) != nullptr) {
                    ++known;
                    with_ferry += ferry ? 1 : 0;
                }
                ++steps;
                const StepResult expected = step(scene, settings, state, input, dt);
                expect_same(step(scene, settings, state, input, dt, rest), expected);
                if (HasFatalFailure()) return;
                state = expected.state;
            }
        }
    }
    EXPECT_GT(known, steps / 4);
    EXPECT_GT(with_ferry, steps / 20);
}

TEST(Rest, NoticesThatTheGroundIsGone) {
    Lab lab;
    lab.floor();
    lab.ready();
    const MovementSettings settings;
    PlayerState state = at({0, centre_height(settings, Vec3::UnitY()), 0});
    Rest rest;
    for (int i = 0; i < 5; ++i)
        state = step(lab.scene(), settings, state, {}, tick, rest).state;
    ASSERT_NE(rest.find(lab.scene(), settings, state, {}, tick), nullptr);
    SurfaceRule air;
    air.solid = false;
    lab.world().set_surface_rule(plain, air);
    EXPECT_EQ(rest.find(lab.scene(), settings, state, {}, tick), nullptr);
    EXPECT_LT(step(lab.scene(), settings, state, {}, tick, rest).state.position.y(), state.position.y());
}

// A platform that comes from afar pushes one at rest.
TEST(Rest, EndsWhenAPlatformComes) {
    Lab lab;
    lab.floor();
    lab.ready();
    const MovementSettings settings;
    Random random(1);
    Ferry ferry(random);
    ferry.centre = {0, 0.5, 0};
    ferry.way = {20, 0, 0};
    ferry.period_s = 8;
    PlayerState state = at({0, centre_height(settings, Vec3::UnitY()), 0});
    const Vec3 begin = state.position;
    Rest rest;
    int known = 0;
    for (int i = 0; i < 300; ++i) {
        ferry.move(i * tick, tick);
        MovementScene scene = lab.scene();
        scene.platforms = ferry.parts;
        scene.tree = &ferry.tree;
        known += rest.find(scene, settings, state, {}, tick) != nullptr ? 1 : 0;
        state = step(scene, settings, state, {}, tick, rest).state;
    }
    EXPECT_GT(known, 60);
    EXPECT_GT((state.position - begin).norm(), 0.1);
}

}  // namespace slipface::test
