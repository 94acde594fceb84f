// Push-out among planes of every orientation, held against the exact projection on their cone; and what is
// defined where there is no such answer.
#include <cstdlib>

#include "cone.h"

namespace slipface::test {
namespace {

MovementSettings pushed(PushOut kind) {
    MovementSettings s = basic_settings();
    s.gravity = 0.0;
    s.push_out = kind;
    return s;
}

// Where a player who stands at `from` without moving is after one step.
Vec3 pushed_to(const Lab& lab, const MovementSettings& s, const Vec3& from) {
    return step(lab.scene(), s, at(from), {}, tick).state.position;
}

PushOutRecord push_record(const Lab& lab, const MovementSettings& s, const Vec3& from) {
    TraceRecorder trace;
    step(lab.scene(), s, at(from), {}, tick, &trace);
    for (const TraceRecord& record : trace.records)
        if (const auto* push = std::get_if<PushOutRecord>(&record)) return *push;
    ADD_FAILURE() << "nothing was pushed";
    return {};
}

TEST(PushOutCone, IsTheExactProjectionForTwoAndThreePlanesOfAnyOrientation) {
    // The answer may lie on one plane, on a line or in the point; each must come up often enough.
    Random random(21);
    std::array<int, 4> ended_on{};
    for (int i = 0; i < 3000; ++i) {
        MovementSettings s = pushed(PushOut::analytic);
        s.radii = Vec3(random.between(0.2, 1.0), random.between(0.2, 1.0), random.between(0.2, 1.0));
        std::vector<Vec3> normals;
        for (int k = 0; k < 2 + i % 2; ++k)
            normals.push_back(random_direction(random));
        Lab lab = corner_of(normals);
        const std::vector<HalfSpace> room = room_in(lab, s);
        std::vector<double> fraction;
        for (std::size_t k = 0; k < normals.size(); ++k)
            fraction.push_back(random.between(0.1, 0.9));
        const Vec3 from = centre_inside(room, s, fraction);
        const std::optional<Vec3> exact = nearest_in(room, from);
        ASSERT_TRUE(exact) << i;
        // The triangles end 100 m out.
        if (from.norm() > 30.0 || exact->norm() > 30.0) continue;
        const Vec3 to = pushed_to(lab, s, from);
        EXPECT_FALSE(overlaps_any(lab.world(), s.radii, to)) << i;
        EXPECT_LT((to - *exact).norm(), 1e-6) << i << ", " << normals.size() << " planes";
        std::size_t touched = 0;
        for (const HalfSpace& space : room)
            touched += space.normal.dot(*exact) < space.distance + 1e-7 ? 1 : 0;
        ++ended_on[touched];
    }
    EXPECT_EQ(ended_on[0], 0);
    for (std::size_t planes = 1; planes <= 3; ++planes)
        EXPECT_GT(ended_on[planes], 100) << planes;
}

TEST(PushOutCone, IsTheExactProjectionForFourToEightPlanes) {
    // A pit of faces that lean outwards around +Y. Only three of them can decide, whichever they are.
    Random random(22);
    int requested = 0;
    for (int i = 0; i < 600; ++i) {
        const int count = 4 + i % 5;
        MovementSettings s = pushed(PushOut::analytic);
        s.radii = Vec3(random.between(0.3, 0.8), random.between(0.3, 0.8), random.between(0.3, 0.8));
        std::vector<Vec3> normals;
        for (int k = 0; k < count; ++k) {
            const double a = 2 * pi * (k + random.between(-0.3, 0.3)) / count;
            const double lean = random.between(0.3, 1.2);
            normals.push_back({std::cos(lean) * std::cos(a), std::sin(lean), std::cos(lean) * std::sin(a)});
        }
        Lab lab = corner_of(normals);
        const std::vector<HalfSpace> room = room_in(lab, s);
        // Near the pit's bottom, where every face is overlapped, on the inner side of all.
        const Vec3 from(random.between(-0.02, 0.02), random.between(0.1, 0.25), random.between(-0.02, 0.02));
        bool between = true;
        for (const HalfSpace& space : room) {
            const double off = space.distance - s.skin - s.radii.cwiseProduct(space.normal).norm();
            between = between && space.normal.dot(from) > off;
        }
        if (!between) continue;
        ++requested;
        const std::optional<Vec3> exact = nearest_in(room, from);
        ASSERT_TRUE(exact) << i;
        const Vec3 to = pushed_to(lab, s, from);
        EXPECT_FALSE(overlaps_any(lab.world(), s.radii, to)) << i;
        EXPECT_LT((to - *exact).norm(), 1e-6) << i << ", " << count << " planes";
    }
    EXPECT_GT(requested, 300);
}

TEST(PushOutCone, FourPlanesOfAPyramidAreLeftOverItsPoint) {
    // Four faces, each 60 degrees steep, that meet at the origin: by symmetry the nearest place that is off
    // all of them from below is on the axis, where n.(0, y, 0) = |R n| + skin, which is centre_height.
    const double a = radians(60);
    const MovementSettings s = pushed(PushOut::analytic);
    const Vec3 n(std::sin(a), std::cos(a), 0);
    Lab lab = corner_of({n, {-n.x(), n.y(), 0}, {0, n.y(), n.x()}, {0, n.y(), -n.x()}});
    for (const Vec3& from : {Vec3(0, 0.3, 0), Vec3(0.05, 0.3, 0.02), Vec3(-0.1, 0.4, 0.1)}) {
        const PushOutRecord record = push_record(lab, s, from);
        EXPECT_EQ(record.planes, 4);
        EXPECT_TRUE(record.free);
        EXPECT_LT((pushed_to(lab, s, from) - Vec3(0, centre_height(s, n), 0)).norm(), 1e-6);
    }
}

TEST(PushOutCone, MorePlanesThanAreKeptAreLeftAllTheSame) {
    // Sixteen faces of a round pit, 60 degrees steep. Eight planes are kept, those overlapped deepest, and
    // the rest is left one by one. That is no longer the shortest way, and nothing says how much longer it
    // is: not twice as long.
    const double a = radians(60);
    std::vector<Vec3> normals;
    for (int k = 0; k < 16; ++k) {
        const double turn = 2 * pi * (k + 0.3) / 16;
        normals.push_back({std::sin(a) * std::cos(turn), std::cos(a), std::sin(a) * std::sin(turn)});
    }
    Lab lab = corner_of(normals);
    Random random(23);
    for (const PushOut kind : {PushOut::analytic, PushOut::iterative}) {
        const MovementSettings s = pushed(kind);
        const std::vector<HalfSpace> room = room_in(lab, s);
        int hit_all = 0;
        for (int i = 0; i < 300; ++i) {
            const double along = random.between(0.2, 1.2), turn = random.between(0, 2 * pi);
            const double aside = along * std::cos(a) / std::sin(a) * random.between(0, 0.9);
            const Vec3 from(aside * std::cos(turn), along, aside * std::sin(turn));
            std::array<Overlap, 64> overlaps;
            hit_all += find_overlaps(lab.world(), s.radii, from, overlaps) == 16 ? 1 : 0;
            const Vec3 to = pushed_to(lab, s, from);
            EXPECT_FALSE(overlaps_any(lab.world(), s.radii, to)) << i;
            for (const Vec3& n : normals)
                EXPECT_GT(n.dot(to), 0.0) << i;
            const double exit_motion = (nearest_in(room, from).value() - from).norm();
            EXPECT_LE((to - from).norm(), 2.0 * exit_motion) << i;
        }
        EXPECT_GT(hit_all, 20);
    }
}

TEST(PushOutCone, FacesThatAreNearlyOnePlaneCountOnce) {
    // Their line, if they were taken for two, lies 1 / tilt times as far away as their heights differ. The
    // upper one counts, and the lower one is then left by as much as it lies lower.
    const MovementSettings s = pushed(PushOut::analytic);
    for (const double tilt : {0.0, 1e-9, 1e-7, 1e-5}) {
        Lab lab;
        lab.floor(0.0, plain, 8.0);
        const double rise = 8.0 * tilt;
        lab.polygon(
            {{-8, -0.001 - rise, -8}, {-8, -0.001 - rise, 8}, {8, -0.001 + rise, 8}, {8, -0.001 + rise, -8}});
        lab.ready();
        const Vec3 from(0.1, 0.5, 0.2);
        const PushOutRecord record = push_record(lab, s, from);
        EXPECT_EQ(record.planes, 1) << tilt;
        EXPECT_TRUE(record.free) << tilt;
        EXPECT_LT((pushed_to(lab, s, from) - Vec3(0.1, 0.9 + s.skin, 0.2)).norm(), 1e-9) << tilt;
    }
}

TEST(PushOutCone, ASlotWithNearlyParallelSidesIsNotLeft) {
    // Two walls 0.6 m apart whose planes meet 0.6 / tilt away, at least 60 km: with no line worth going to,
    // nothing is free, and the player stays.
    for (const double tilt : {0.0, 1e-9, 1e-7, 1e-5}) {
        Lab lab;
        const double turn = 20.0 * tilt;
        lab.wall({-20, 0.3 - turn}, {20, 0.3 + turn}, -50, 50);
        lab.wall({-20, -0.3}, {20, -0.3}, -50, 50);
        lab.ready();
        for (const PushOut kind : {PushOut::iterative, PushOut::analytic}) {
            const MovementSettings s = pushed(kind);
            EXPECT_FALSE(push_record(lab, s, {0, 0, 0}).free) << tilt;
            EXPECT_EQ(pushed_to(lab, s, {0, 0, 0}), Vec3(0, 0, 0)) << tilt;
        }
    }
}

// Drives for each kind of push-out, or as many as SLIPFACE_PUSH_OUT_DRIVES says; 10^6 take a minute.
int drives() {
    const char* const wanted = std::getenv("SLIPFACE_PUSH_OUT_DRIVES");
    return wanted != nullptr ? std::atoi(wanted) : 20000;
}

// Fractions of the extents by which a player overlaps `planes` planes, from nearly touching to nearly
// through.
std::vector<double> random_fractions(Random& random, std::size_t planes) {
    std::vector<double> fraction;
    for (std::size_t k = 0; k < planes; ++k)
        fraction.push_back(random.between(0.02, 0.98));
    return fraction;
}

// Drives `state`, who began at `from` overlapping everything, for three ticks.
void drive(const Lab& lab, const MovementSettings& s, const std::vector<HalfSpace>& room, PlayerState state,
           double exit_motion) {
    const Vec3 from = state.position;
    const double speed = state.velocity.norm();
    for (int k = 1; k <= 3; ++k) {
        state = step(lab.scene(), s, state, {}, tick).state;
        ASSERT_FALSE(overlaps_any(lab.scene().collision, s.radii, state.position)) << "tick " << k;
        // Planes pass near the origin, within what float makes of corners 200 m out.
        for (const HalfSpace& space : room)
            ASSERT_GT(space.normal.dot(state.position), 0.0) << "through a plane, tick " << k;
        // A ramp may turn the horizontal part of a split move so that it adds to the vertical one: sqrt 2 of
        // the way at most. Each contact of either part may push the player off by what is missing of a skin.
        const double moved = std::sqrt(2.0) * speed * tick * k + 2 * s.max_slides * s.skin * k;
        ASSERT_LE((state.position - from).norm(), exit_motion + moved) << "tick " << k;
    }
}

TEST(PushOutCone, DrivesIntoWedgesAndCornersEndOutsideOnTheSameSideAndNear) {
    // Near: no further than the shortest way out, to 1e-6 m, and what the speed makes of the ticks.
    ASSERT_GT(drives(), 0);
    Random random(24);
    const MovementSettings s = pushed(PushOut::analytic);
    Lab lab;
    std::vector<HalfSpace> room;
    for (int i = 0; i < drives(); ++i) {
        if (i % 20 == 0) {
            const bool wedge = i % 40 == 0;
            const double angle = radians(random.between(5.0, 85.0));
            lab = corner_of(wedge ? wedge_normals(random, angle) : acute_corner_normals(random));
            room = room_in(lab, s);
        }
        const Vec3 from = centre_inside(room, s, random_fractions(random, room.size()));
        const double exit_motion = (nearest_in(room, from).value() - from).norm() + 1e-6;
        drive(lab, s, room, at(from, random.between(0.0, 40.0) * random_direction(random)), exit_motion);
        if (HasFatalFailure()) FAIL() << "drive " << i << ", " << room.size() << " planes";
    }
}

TEST(PushOutCone, IteratingDrivesIntoWedgesEndOutsideOnTheSameSideAndNear) {
    // Every round is a projection on a plane that the centre has to leave, and no such step is longer than
    // what is left of the shortest way; in a wedge their sum is that way.
    Random random(25);
    const MovementSettings s = pushed(PushOut::iterative);
    Lab lab;
    std::vector<HalfSpace> room;
    for (int i = 0; i < drives(); ++i) {
        if (i % 20 == 0) {
            lab = corner_of(wedge_normals(random, radians(random.between(5.0, 85.0))));
            room = room_in(lab, s);
        }
        const Vec3 from = centre_inside(room, s, random_fractions(random, room.size()));
        const double exit_motion = (nearest_in(room, from).value() - from).norm() + 1e-6;
        drive(lab, s, room, at(from, random.between(0.0, 40.0) * random_direction(random)), exit_motion);
        if (HasFatalFailure()) FAIL() << "drive " << i;
    }
}

// The point of three narrow faces may be metres away, and rounds alone do not always get there.
TEST(PushOutCone, IteratingLeavesEveryCorner) {
    Random random(26);
    const MovementSettings s = pushed(PushOut::iterative);
    for (int i = 0; i < 2000; ++i) {
        Lab lab = corner_of(acute_corner_normals(random));
        const std::vector<HalfSpace> room = room_in(lab, s);
        const Vec3 from = centre_inside(room, s, random_fractions(random, room.size()));
        const Vec3 to = pushed_to(lab, s, from);
        ASSERT_TRUE(push_record(lab, s, from).free) << i;
        ASSERT_FALSE(overlaps_any(lab.world(), s.radii, to)) << i;
    }
}

}  // namespace
}  // namespace slipface::test
