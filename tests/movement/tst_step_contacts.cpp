// Contacts and events of a step: what is touched, how fast, and what it means.
#include <algorithm>

#include "allocation_counter.h"
#include "slipface/movement/events.h"
#include "test_geometry.h"

namespace slipface::test {

namespace {

struct After {
    PlayerState state;
    std::vector<StepContact> contacts;
    std::vector<StepEvent> events;

    const StepEvent* event(StepEventKind kind) const {
        const auto found = std::ranges::find(events, kind, &StepEvent::kind);
        return found == events.end() ? nullptr : &*found;
    }
};

After after_step(const MovementScene& scene, const MovementSettings& settings, const PlayerState& before,
                 const PlayerInput& input) {
    std::array<StepContact, 32> room;
    StepContacts contacts{room};
    After now{step(scene, settings, before, input, tick, nullptr, &contacts).state, {}, {}};
    EXPECT_FALSE(contacts.full);
    now.contacts.assign(contacts.found().begin(), contacts.found().end());
    std::array<StepEvent, 32> events;
    const std::size_t count = find_events(settings, before, now.state, contacts, events);
    now.events.assign(events.begin(), events.begin() + static_cast<std::ptrdiff_t>(count));
    return now;
}

// A bumpy floor of many types with walls, for random walks.
Lab random_lab(Random& random) {
    Lab lab;
    for (int i = 0; i < 36; ++i) {
        const double x = 3.0 * (i % 6) - 9.0, z = 3.0 * (i / 6) - 9.0;
        const auto height = [&] { return random.between(-0.3, 0.3); };
        lab.polygon({{x, height(), z}, {x, height(), z + 3}, {x + 3, height(), z + 3}, {x + 3, height(), z}},
                    static_cast<SurfaceId>(random.below(8)));
        if (random.below(3) == 0) {
            const double a = random.between(0, 2 * pi);
            lab.wall({x, z}, {x + std::cos(a), z + std::sin(a)}, -1, random.between(0.1, 3.0));
        }
    }
    lab.floor(-1.0);
    return lab;
}

}  // namespace

// Nothing changes where contacts are asked for; each of them was touched by a sweep of the trace; a smaller
// room has the first of them; nothing is allocated.
TEST(StepContacts, AreThoseOfTheMove) {
    std::size_t seen = 0, cut = 0;
    for (int round = 0; round < 40; ++round) {
        Random random(static_cast<std::uint64_t>(round) + 77);
        Lab lab = random_lab(random);
        lab.ready();
        const MovementSettings settings = round % 2 == 0 ? MovementSettings{} : every_hack();
        PlayerState state = at({random.between(-6, 6), 2.0, random.between(-6, 6)});
        PlayerInput input;
        for (int i = 0; i < 150; ++i) {
            if (i % 20 == 0) input = wish(random.between(-1, 1), random.between(-1, 1), random.below(2) == 0);
            TraceRecorder trace;
            const PlayerState plain = step(lab.scene(), settings, state, input, tick, &trace).state;
            std::array<StepContact, 32> room;
            StepContacts contacts{room};
            const long before = allocation_count();
            const PlayerState now = step(lab.scene(), settings, state, input, tick, nullptr, &contacts).state;
            ASSERT_EQ(allocation_count(), before);
            ASSERT_EQ(now, plain);
            for (const StepContact& one : contacts.found()) {
                const bool swept = std::ranges::any_of(trace.records, [&](const TraceRecord& record) {
                    const auto* sweep = std::get_if<SweepRecord>(&record);
                    return sweep != nullptr && sweep->contact && sweep->contact->face == one.face &&
                           sweep->contact->point == one.point;
                });
                ASSERT_TRUE(swept) << "round " << round << ", tick " << i;
                ASSERT_GE(one.speed, 0.0);
                ASSERT_LT(one.speed, 30.0);
                ASSERT_NEAR(one.normal.norm(), 1.0, 1e-9);
            }
            if (now.grounded) {  // what is stood on was touched, unless the player rests where it was
                ASSERT_TRUE(now.position == state.position ||
                            std::ranges::count(contacts.found(), now.ground_face, &StepContact::face) > 0);
            }
            seen += contacts.count;
            std::array<StepContact, 1> small;
            StepContacts first{small};
            step(lab.scene(), settings, state, input, tick, nullptr, &first);
            ASSERT_EQ(first.count, std::min<std::size_t>(contacts.count, 1));
            if (first.count == 1) {
                ASSERT_EQ(first.out[0].point, contacts.out[0].point);
            }
            ASSERT_TRUE(!first.full || contacts.count > 0);
            cut += first.full;
            state = plain;
        }
    }
    EXPECT_GT(seen, 2000U);
    EXPECT_GT(cut, 300U);
}

// A fall of h metres ends at sqrt(2 g h); the last tick adds at most g * dt.
TEST(StepContacts, ALandingHasTheSpeedOfTheFall) {
    Random random(5);
    for (int round = 0; round < 50; ++round) {
        Lab lab;
        const FaceId ground = lab.floor(0.0, plain);
        lab.ready();
        MovementSettings settings;
        const double fall = random.between(0.5, 20.0);
        PlayerState state = at({0.0, centre_height(settings, Vec3::UnitY()) + fall, 0.0});
        const double expected = std::min(std::sqrt(2.0 * settings.gravity * fall), settings.terminal_speed);
        int landings = 0;
        for (int i = 0; i < 200; ++i) {
            const After now = after_step(lab.scene(), settings, state, wish(0.5, 0));
            if (const StepEvent* landed = now.event(StepEventKind::landed)) {
                ++landings;
                EXPECT_NEAR(landed->value, expected, 1.01 * settings.gravity * tick);
                EXPECT_EQ(landed->face, ground);
            } else if (state.grounded) {
                for (const StepContact& one : now.contacts)  // standing and walking press, but do not hit
                    EXPECT_LT(one.speed, 1e-9) << i;
            }
            state = now.state;
        }
        EXPECT_EQ(landings, 1);
    }
}

// A wall met at an angle is met at the speed times its cosine.
TEST(StepContacts, AWallIsMetAtTheSpeedAcrossIt) {
    for (const double angle : {0.0, 20.0, 45.0, 70.0}) {
        Lab lab;
        lab.floor();
        const FaceId wall = lab.wall({4, 45}, {4, -45});
        lab.ready();
        const MovementSettings settings;
        PlayerState state = at({2.0, centre_height(settings, Vec3::UnitY()), 0.0});
        double fastest = 0.0;
        for (int i = 0; i < 300; ++i) {
            const double c = std::cos(radians(angle)), s = std::sin(radians(angle));
            const After now = after_step(lab.scene(), settings, state, wish(c, -s));
            for (const StepContact& one : now.contacts)
                if (one.face == wall) fastest = std::max(fastest, one.speed);
            state = now.state;
        }
        EXPECT_NEAR(fastest, settings.walk_speed * std::cos(radians(angle)), 0.01) << angle;
    }
}

// A wall that comes at 3 m/s hits a player that stands at 3 m/s.
TEST(StepContacts, APlatformHitsAtItsSpeed) {
    Lab lab, wall;
    lab.floor();
    lab.ready();
    wall.wall({0, 5}, {0, -5}, 0, 3);
    wall.ready();
    const MovementSettings settings;
    PlayerState state = at({2.0, centre_height(settings, Vec3::UnitY()), 0.0});
    double fastest = 0.0;
    for (int i = 0; i < 60; ++i) {
        MovingPart part;
        part.rest = &wall.world();
        part.begin.offset.x() = 3.0 * tick * i;
        part.end.offset.x() = part.pivot.x() = 3.0 * tick * (i + 1);
        part.velocity.x() = 3.0;
        MovementScene scene = lab.scene();
        scene.platforms = {&part, 1};
        const After now = after_step(scene, settings, state, {});
        for (const StepContact& one : now.contacts) {
            if (one.platform != 0) continue;
            EXPECT_EQ(one.pass, Pass::probe);
            fastest = std::max(fastest, one.speed);
        }
        state = now.state;
    }
    EXPECT_NEAR(fastest, 3.0, 0.02);
    EXPECT_GT(state.position.x(), 2.5);
}

TEST(StepEvents, AWalkOverAStepOffALedgeOntoAHazard) {
    Random random(11);
    for (int round = 0; round < 20; ++round) {
        const double rise = random.between(0.2, 0.38), drop = random.between(1.0, 3.0);
        Lab lab;
        const auto box = [&](double from, double to, double y, SurfaceId type) {
            lab.polygon({{from, y, -5}, {from, y, 5}, {to, y, 5}, {to, y, -5}}, type);
        };
        box(-5, 2, 0, plain);
        lab.polygon({{2, 0, 5}, {2, 0, -5}, {2, rise, -5}, {2, rise, 5}});
        box(2, 5, rise, plain);
        lab.polygon({{5, rise, -5}, {5, rise, 5}, {5, -drop, 5}, {5, -drop, -5}});
        box(5, 30, -drop, hazard);
        lab.ready();
        const MovementSettings settings;
        PlayerState state = at({-1.0, centre_height(settings, Vec3::UnitY()), 0.0});
        std::vector<StepEvent> all;
        for (int i = 0; i < 150; ++i) {
            const After now = after_step(lab.scene(), settings, state, wish(1, 0));
            for (const StepEvent& event : now.events)
                if (all.empty() || event.kind != StepEventKind::touched ||
                    event.surface != all.back().surface)
                    all.push_back(event);
            state = now.state;
        }
        std::vector<StepEventKind> kinds;
        for (const StepEvent& event : all)
            kinds.push_back(event.kind);
        const auto first = [&](StepEventKind kind) { return std::ranges::find(kinds, kind) - kinds.begin(); };
        EXPECT_EQ(std::ranges::count(kinds, StepEventKind::stepped), 1) << rise;
        EXPECT_EQ(std::ranges::count(kinds, StepEventKind::left), 1);
        EXPECT_EQ(std::ranges::count(kinds, StepEventKind::hazard), 1);
        EXPECT_EQ(std::ranges::count(kinds, StepEventKind::landed), 2);  // onto the floor at first
        EXPECT_LT(first(StepEventKind::stepped), first(StepEventKind::left));
        EXPECT_LT(first(StepEventKind::left), first(StepEventKind::hazard));
        const auto stepped = all[static_cast<std::size_t>(first(StepEventKind::stepped))];
        EXPECT_NEAR(stepped.value, rise, 0.01);
        const auto hazards = all[static_cast<std::size_t>(first(StepEventKind::hazard))];
        EXPECT_EQ(hazards.kind, StepEventKind::hazard);
    }
}

}  // namespace slipface::test
