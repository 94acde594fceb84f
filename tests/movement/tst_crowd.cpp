// Players that meet: step_crowd().
#include <algorithm>
#include <numeric>

#include "slipface/base/parallel.h"
#include "slipface/movement/crowd.h"
#include "test_geometry.h"

namespace slipface::test {

namespace {

using Crowd = std::vector<CrowdMember>;

// Where two bodies touch this is 1.
double distance(const CrowdMember& a, const CrowdMember& b) {
    return (a.state.position - b.state.position).cwiseQuotient(a.settings->radii + b.settings->radii).norm();
}

double closest(const Crowd& crowd) {
    double least = 1e9;
    for (std::size_t i = 0; i < crowd.size(); ++i)
        for (std::size_t k = 0; k < i; ++k)
            least = std::min(least, distance(crowd[i], crowd[k]));
    return least;
}

void run(const Lab& lab, Crowd& crowd, int ticks) {
    for (int i = 0; i < ticks; ++i)
        step_crowd(lab.scene(), crowd, tick);
}

// A floor, and at the right a wall, x = 5.
struct Yard : Lab {
    MovementSettings settings = basic_settings();
    double standing = 0.0;  // height of the centre on the floor
    Yard() {
        floor();
        wall({5, 10}, {5, -10});
        ready();
        standing = centre_height(settings, Vec3::UnitY());
    }
    CrowdMember member(double x, double z = 0.0, const PlayerInput& input = {}) const {
        PlayerState state = at({x, standing, z});
        state.grounded = true;
        return {&settings, state, input};
    }
};

}  // namespace

TEST(Crowd, AMemberAloneMovesAsInAStep) {
    Yard yard;
    Crowd crowd{yard.member(-3, 0, wish(1, 0)), yard.member(-3, 4, wish(0.5, 0.5, true)), yard.member(0, -4)};
    const Crowd start = crowd;
    run(yard, crowd, 30);
    for (std::size_t i = 0; i < crowd.size(); ++i) {
        const PlayerState alone = test::run(yard, yard.settings, start[i].state, start[i].input, 30);
        EXPECT_EQ(crowd[i].state, alone) << i;
    }
}

TEST(Crowd, WalkersPushThoseInTheirWay) {
    Yard yard;
    Crowd crowd{yard.member(-2, 0, wish(1, 0)), yard.member(0)};
    run(yard, crowd, 60);
    const double pushed = crowd[1].state.position.x();
    EXPECT_GT(pushed, 0.5);
    EXPECT_GE(closest(crowd), 1.0 - 1e-9);
    // Slower than a walker with nobody in its way, and both stay on their line and on the ground.
    EXPECT_LT(crowd[0].state.position.x(), -2 + yard.settings.walk_speed - 0.5);
    for (const CrowdMember& member : crowd) {
        EXPECT_EQ(member.state.position.z(), 0.0);
        EXPECT_NEAR(member.state.position.y(), yard.standing, 1e-6);
        EXPECT_TRUE(member.state.grounded);
    }
}

// The first one cannot give way, so the other one stops: the centres are two radii apart.
TEST(Crowd, AWallBehindTheOtherStopsThePusher) {
    Yard yard;
    Crowd crowd{yard.member(0, 0, wish(1, 0)), yard.member(2)};
    run(yard, crowd, 300);
    const double radius = yard.settings.radii.x();
    EXPECT_NEAR(crowd[1].state.position.x(), 5.0 - radius - yard.settings.skin, 1e-3);
    EXPECT_NEAR(crowd[0].state.position.x(), 5.0 - 3.0 * radius - yard.settings.skin, 2e-3);
    EXPECT_FALSE(overlaps_any(yard.world(), yard.settings.radii, crowd[1].state.position));
}

TEST(Crowd, TheFastestMeetInTheMiddle) {
    for (const double speed : {5.0, 30.0, 120.0, 400.0}) {
        Yard yard;
        Crowd crowd{yard.member(-4), yard.member(3.9)};
        crowd[0].state.velocity.x() = speed;
        crowd[1].state.velocity.x() = -speed;
        run(yard, crowd, 3);
        EXPECT_LT(crowd[0].state.position.x(), crowd[1].state.position.x()) << speed;
        EXPECT_GE(closest(crowd), 1.0 - 1e-9) << speed;
    }
}

TEST(Crowd, OneStandsOnAnotherAndJumpsFromThere) {
    Yard yard;
    Crowd crowd{yard.member(0.1), yard.member(0)};
    crowd[0].state.position.y() += 3.0;
    run(yard, crowd, 90);
    const PlayerState rest = crowd[0].state;
    EXPECT_TRUE(rest.grounded);
    EXPECT_GT(rest.ground_normal.y(), 0.9);
    EXPECT_NEAR(distance(crowd[0], crowd[1]), 1.0, 1e-9);
    EXPECT_NEAR(rest.position.x(), 0.1, 1e-12);
    EXPECT_NEAR(crowd[1].state.position.y(), yard.standing, 1e-6);  // not pressed into the floor
    run(yard, crowd, 60);
    EXPECT_NEAR((crowd[0].state.position - rest.position).norm(), 0.0, 1e-9);

    double top = 0.0;
    for (int i = 0; i < 60; ++i) {
        crowd[0].input.buttons.set(Button::jump, i == 5);
        run(yard, crowd, 1);
        top = std::max(top, crowd[0].state.position.y());
    }
    const MovementSettings& s = yard.settings;
    EXPECT_NEAR(top - rest.position.y(), s.jump_speed * s.jump_speed / (2.0 * s.gravity), 0.15);
    EXPECT_TRUE(crowd[0].state.grounded);
}

TEST(Crowd, ATowerIsCarried) {
    Yard yard;
    Crowd crowd{yard.member(0), yard.member(0), yard.member(0)};
    for (int i = 1; i < 3; ++i)
        crowd[static_cast<std::size_t>(i)].state.position.y() += 2.0 * i;
    run(yard, crowd, 90);
    crowd[0].input = wish(-1, 0);
    run(yard, crowd, 60);
    const double moved = crowd[0].state.position.x();
    EXPECT_LT(moved, -3.0);
    for (const CrowdMember& member : crowd) {
        EXPECT_NEAR(member.state.position.x(), moved, 1e-6);
        EXPECT_TRUE(member.state.grounded);
    }
    EXPECT_NEAR(distance(crowd[0], crowd[1]), 1.0, 1e-6);
    EXPECT_NEAR(distance(crowd[1], crowd[2]), 1.0, 1e-6);
}

// Steeper than max_slope nobody stands: the upper one glides off and reaches the floor.
TEST(Crowd, NobodyStandsOnAShoulder) {
    Yard yard;
    Crowd crowd{yard.member(0.5), yard.member(0)};
    crowd[0].state.position.y() += 3.0;
    run(yard, crowd, 120);
    EXPECT_NEAR(crowd[0].state.position.y(), yard.standing, 1e-6);
    EXPECT_GE(closest(crowd), 1.0 - 1e-9);
}

// All want through a door that is a little wider than one of them.
TEST(Crowd, ADoorForOneLetsAllThrough) {
    Random random(1129);
    for (int run_of = 0; run_of < 12; ++run_of) {
        Yard yard;
        const double half = 0.5 * random.between(0.9, 1.4), middle = random.between(-1, 1);
        Lab lab;
        lab.floor();
        for (const double side : {-1.0, 1.0}) {
            lab.wall({0, middle + side * half}, {0, middle + side * 12});
            lab.wall({0, middle + side * 12}, {0, middle + side * half});
        }
        lab.ready();
        Crowd crowd;
        for (int i = 0; i < 24; ++i)
            crowd.push_back(yard.member(-1.5 - 1.2 * (i % 4) + random.between(-0.1, 0.1),
                                        1.2 * (i / 4) - 3 + random.between(-0.1, 0.1)));
        const auto is_through = [](const CrowdMember& member) { return member.state.position.x() > 0.7; };
        int ticks = 0;
        for (; ticks < 1200 && !std::all_of(crowd.begin(), crowd.end(), is_through); ++ticks) {
            for (CrowdMember& member : crowd) {
                const Vec3& at = member.state.position;
                const Vec2 way = at.x() > 0.0 ? Vec2(1, 0) : Vec2(0.3 - at.x(), middle - at.z());
                member.input.wish = way.normalized();
            }
            step_crowd(lab.scene(), crowd, tick);
        }
        EXPECT_LT(ticks, 1200) << 2 * half << " m";
    }
}

TEST(Crowd, TwoAtOnePlacePart) {
    Yard yard;
    Crowd crowd{yard.member(1), yard.member(1)};
    run(yard, crowd, 30);
    EXPECT_GE(closest(crowd), 1.0 - 1e-6);
}

TEST(Crowd, BodiesOfAnySizeStayOutsideOfEverythingInAnyOrder) {
    for (std::uint64_t seed = 0; seed < 12; ++seed) {
        SCOPED_TRACE(seed);
        Random random(seed);
        Lab lab;
        lab.floor();
        for (int i = 0; i < 4; ++i) {
            const double side = 0.5 * pi * i;
            const Vec2 out(6 * std::cos(side), 6 * std::sin(side)), along(-out.y(), out.x());
            lab.wall(out - along, out + along);
        }
        for (int i = 0; i < 20; ++i) {
            const Vec3 centre(random.between(-5, 5), random.between(0, 2), random.between(-5, 5));
            const auto corner = [&] {
                return Vec3(centre +
                            Vec3(random.between(-1, 1), random.between(-1, 1), random.between(-1, 1)));
            };
            lab.polygon({corner(), corner(), corner()});
        }
        lab.ready();
        std::vector<MovementSettings> settings(30, seed % 2 == 0 ? basic_settings() : every_hack());
        Crowd crowd;
        for (MovementSettings& s : settings) {
            s.radii = {random.between(0.2, 0.5), random.between(0.4, 1.0), 0.0};
            s.radii.z() = s.radii.x();
            for (int tries = 0; tries < 50; ++tries) {
                const Vec3 position(random.between(-5, 5), random.between(0.5, 5), random.between(-5, 5));
                if (overlaps_any(lab.world(), s.radii, position)) continue;
                crowd.push_back({&s, at(position), {}});
                break;
            }
        }
        Crowd other(crowd.rbegin(), crowd.rend());
        for (int i = 0; i < 300; ++i) {
            for (std::size_t k = 0; k < crowd.size(); ++k) {
                if (i % 40 == 0) crowd[k].input = wish(random.between(-1, 1), random.between(-1, 1));
                crowd[k].input.buttons.set(Button::jump, random.below(30) == 0);
                other[crowd.size() - 1 - k].input = crowd[k].input;
            }
            step_crowd(lab.scene(), crowd, tick);
            step_crowd(lab.scene(), other, tick);
            for (std::size_t k = 0; k < crowd.size(); ++k) {
                ASSERT_EQ(crowd[k].state, other[crowd.size() - 1 - k].state) << i << ' ' << k;
                ASSERT_FALSE(overlaps_any(lab.world(), crowd[k].settings->radii, crowd[k].state.position))
                    << i << ' ' << k;
            }
        }
        EXPECT_GT(closest(crowd), 0.8);
    }
}

// However large and wherever they are, and also beside one of another size.
TEST(Crowd, EveryTwoThatMeetAreTakenApart) {
    for (std::uint64_t seed = 0; seed < 10; ++seed) {
        SCOPED_TRACE(seed);
        Random random(seed);
        Lab lab;
        lab.floor(-1e6);
        lab.ready();
        std::vector<MovementSettings> settings(400);
        Crowd crowd;
        for (std::size_t i = 0; i < settings.size(); ++i) {
            const double radius = std::pow(10.0, random.between(-1.5, 1.0));
            settings[i].radii = {radius, radius * random.between(1, 2.5), radius};
            settings[i].skin = 1e-3 * radius;
            Vec3 place(60.0 * static_cast<double>(i / 2 % 10), 90.0 * static_cast<double>(i / 20 % 5),
                       60.0 * static_cast<double>(i / 100) + 1e4 * static_cast<double>(seed));
            if (i % 2 == 1) {
                const Vec3 sum = settings[i - 1].radii + settings[i].radii;
                const Vec3 out(random.between(-1, 1), random.between(-1, 1), random.between(-1, 1));
                place = crowd.back().state.position +
                        0.9 * random.between(0.1, 1) * out.normalized().cwiseProduct(sum);
            }
            crowd.push_back({&settings[i], at(place), {}});
        }
        run(lab, crowd, 1);
        for (std::size_t i = 0; i < crowd.size(); i += 2)
            EXPECT_GE(distance(crowd[i], crowd[i + 1]), 1.0 - 1e-9) << i;
    }
}

TEST(Crowd, APileComesApartToAllSides) {
    Yard yard;
    Crowd crowd(80, yard.member(0));
    run(yard, crowd, 300);
    Aabb box;
    for (const CrowdMember& member : crowd) {
        box.add(member.state.position);
        EXPECT_NEAR(member.state.position.y(), yard.standing, 1e-6);
    }
    EXPECT_GT(closest(crowd), 0.98);
    EXPECT_LT(box.size().x(), 2.0 * box.size().z());
    EXPECT_LT(box.size().z(), 2.0 * box.size().x());
}

TEST(Crowd, ThreadsAndTheOrderOfMembersChangeNoBit) {
    Yard yard;
    for (std::uint64_t seed = 0; seed < 3; ++seed) {
        Random random(seed);
        Crowd crowd;
        std::vector<Rest> rests(400);
        for (int i = 0; i < 400; ++i) {
            crowd.push_back(yard.member(-45 + 0.7 * (i % 20) + random.between(-0.05, 0.05),
                                        0.7 * (i / 20) + random.between(-0.05, 0.05)));
            if (random.below(2) == 0) crowd.back().input = wish(random.between(-1, 1), random.between(-1, 1));
        }
        Crowd other(crowd.rbegin(), crowd.rend());
        for (std::size_t i = 0; i < crowd.size(); ++i)
            crowd[i].rest = &rests[i];
        for (int i = 0; i < 60; ++i) {
            {
                const ThreadLimit threads(4);
                step_crowd(yard.scene(), crowd, tick);
            }
            const ThreadLimit threads(1);
            step_crowd(yard.scene(), other, tick);
            for (std::size_t k = 0; k < crowd.size(); ++k)
                ASSERT_EQ(crowd[k].state, other[crowd.size() - 1 - k].state) << i << ' ' << k;
        }
    }
}

TEST(Crowd, StepManyIsAStepOfEach) {
    Yard yard;
    Crowd crowd;
    for (int i = 0; i < 100; ++i)
        crowd.push_back(yard.member(0.01 * i, 0, wish(0.01 * i, 0.5)));
    const Crowd before = crowd;
    step_many(yard.scene(), crowd, tick);
    for (std::size_t i = 0; i < crowd.size(); ++i)
        EXPECT_EQ(crowd[i].state,
                  step(yard.scene(), yard.settings, before[i].state, before[i].input, tick).state);
}

}  // namespace slipface::test
