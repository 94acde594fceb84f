// Random scenes of random sizes, turned and moved: clean ones in which the doctor must find nothing, and ones
// with a planted defect that it must find, with the consequence that a walker meets.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "level/faces.h"
#include "slipface/doctor/doctor.h"
#include "slipface/movement/step.h"

namespace slipface {
namespace {

using test::Face;
using test::Faces;

class Random {
  public:
    explicit Random(unsigned seed) : engine_(seed) {}
    double between(double low, double high) { return low + (high - low) * unit(); }
    int between(int low, int high) {
        return low + static_cast<int>(engine_() % static_cast<unsigned>(high - low + 1));
    }
    bool coin() { return engine_() % 2 == 0; }

  private:
    double unit() { return static_cast<double>(engine_()) / 4294967296.0; }
    std::mt19937 engine_;
};

// A scene in its own coordinates, and how it is turned about the vertical and moved.
struct Scene {
    explicit Scene(Random& random)
        : turn(random.between(0.0, 6.28)),
          offset(random.between(-50.0, 50.0), random.between(-5.0, 5.0), random.between(-50.0, 50.0)) {}

    Vec3 placed(const Vec3& p) const {
        const double c = std::cos(turn), s = std::sin(turn);
        return Vec3(c * p.x() - s * p.z(), p.y(), s * p.x() + c * p.z()) + offset;
    }
    // Rounded as modelling tools write: vertices that were one stay one.
    void add(const std::vector<Vec3>& corners) {
        Face face;
        for (const Vec3& corner : corners) {
            const Vec3 p = placed(corner);
            face.corners.emplace_back(static_cast<float>(std::round(p.x() * 1e6) * 1e-6),
                                      static_cast<float>(std::round(p.y() * 1e6) * 1e-6),
                                      static_cast<float>(std::round(p.z() * 1e6) * 1e-6));
        }
        faces.push_back(face);
    }
    // Seen from above, from (x0, z0) to (x1, z1), its height y0 at x0 and y1 at x1.
    void floor(double x0, double z0, double x1, double z1, double y0, double y1) {
        add({{x0, y0, z0}, {x0, y0, z1}, {x1, y1, z1}, {x1, y1, z0}});
    }
    void floor(double x0, double z0, double x1, double z1, double y = 0.0) { floor(x0, z0, x1, z1, y, y); }
    // Looks towards -x.
    void wall(double x, double z0, double z1, double low, double high) {
        add({{x, low, z0}, {x, low, z1}, {x, high, z1}, {x, high, z0}});
    }
    Level level(const MovementSettings& settings) const {
        Level made = test::level_of(faces);
        made.movement = settings;
        return made;
    }

    double turn;
    Vec3 offset;
    Faces faces;
};

// Of a body of that size, with step up and snap: what a level begins with.
MovementSettings random_settings(Random& random) {
    MovementSettings settings;
    const double radius = random.between(0.25, 0.5);
    settings.radii = {radius, random.between(0.7, 1.1), radius};
    settings.walk_speed = random.between(3.0, 8.0);
    settings.max_slope = random.between(0.7, 0.95);
    settings.step_up = settings.snap_down = true;
    settings.step_height = settings.snap_distance = random.between(0.25, 0.4);
    return settings;
}

std::string explained(const DoctorReport& report) {
    std::string text;
    for (const Problem& problem : report.problems)
        text += std::string(info_of(problem.kind).name) + ": " + problem.text + "\n";
    return text;
}

// A floor of tiles of different sizes in a room.
Scene room(Random& random) {
    Scene scene(random);
    std::vector<double> xs{0.0}, zs{0.0};
    for (int i = random.between(2, 6); i > 0; --i)
        xs.push_back(xs.back() + random.between(0.4, 3.0));
    for (int i = random.between(2, 6); i > 0; --i)
        zs.push_back(zs.back() + random.between(0.4, 3.0));
    for (std::size_t i = 1; i < xs.size(); ++i)
        for (std::size_t j = 1; j < zs.size(); ++j)
            scene.floor(xs[i - 1], zs[j - 1], xs[i], zs[j]);
    const double high = random.between(2.2, 5.0);
    for (std::size_t j = 1; j < zs.size(); ++j)
        scene.wall(xs.back(), zs[j - 1], zs[j], 0.0, high);
    return scene;
}

// A flight between two floors, with cheeks to both sides down to the ground.
Scene stairs(Random& random, double rise, double run, int steps) {
    Scene scene(random);
    const double wide = random.between(1.5, 4.0);
    scene.floor(-4.0, 0.0, 0.0, wide);
    for (int i = 0; i < steps; ++i) {
        scene.wall(i * run, 0.0, wide, i * rise, (i + 1) * rise);
        const double end = i + 1 < steps ? (i + 1) * run : i * run + 4.0;
        scene.floor(i * run, 0.0, end, wide, (i + 1) * rise);
    }
    return scene;
}

Scene ramp(Random& random, double slope, double high) {
    Scene scene(random);
    const double wide = random.between(1.5, 4.0), run = high / std::tan(slope);
    scene.floor(-4.0, 0.0, 0.0, wide);
    scene.floor(0.0, 0.0, run, wide, 0.0, high);
    scene.floor(run, 0.0, run + 4.0, wide, high);
    return scene;
}

// Two floors with a strip between them that is missing.
Scene gap(Random& random, double width) {
    Scene scene(random);
    const double wide = random.between(5.0, 8.0);
    scene.floor(-4.0, 0.0, 0.0, wide);
    scene.floor(width, 0.0, width + 4.0, wide);
    return scene;
}

TEST(DoctorRandom, FindsNothingInCleanScenes) {
    int scenes = 0;
    for (unsigned seed = 0; seed < 400; ++seed) {
        Random random(seed);
        const MovementSettings settings = random_settings(random);
        const auto check = [&](const Scene& scene, const char* what) {
            const DoctorReport report = examine(scene.level(settings));
            EXPECT_EQ(report.total(), 0u) << what << ", seed " << seed << "\n" << explained(report);
            ++scenes;
        };
        switch (seed % 4) {
            case 0:
                check(room(random), "room");
                break;
            case 1: {
                const double rise = random.between(0.1, 0.9 * settings.step_height);
                check(stairs(random, rise, random.between(1.3, 2.0) * rise + 0.1, random.between(1, 8)),
                      "stairs");
                break;
            }
            case 2:
                check(ramp(random, random.between(0.1, settings.max_slope - 0.02), random.between(0.5, 3.0)),
                      "ramp");
                break;
            default: {  // terraces, too high to be steps
                const double rise = random.between(0.55, 2.0) * settings.radii.y();
                check(stairs(random, rise, random.between(1.0, 4.0), random.between(1, 4)), "terraces");
            }
        }
    }
    EXPECT_EQ(scenes, 400);
}

struct Found {
    int planted = 0, found = 0;
    std::string missed;
    void count(bool was_found, unsigned seed, const DoctorReport& report) {
        ++planted;
        if (was_found)
            ++found;
        else
            missed += "seed " + std::to_string(seed) + "\n" + explained(report);
    }
    void expect_almost_all() const {
        EXPECT_GE(found, 0.98 * planted) << found << "/" << planted << "\n" << missed;
    }
};

enum class Fate { passes, stops, falls };

// What becomes of a walker that the test itself sends over the middle of a gap, in every direction across it.
Fate fate_at_gap(const Scene& scene, const Level& level, double width, double z) {
    const MovementSettings& settings = level.movement;
    const CollisionWorld world = build_collision_world(level).value();
    const MovementScene in{.collision = world, .surfaces = level.surfaces};
    const double reach = 1.5 * settings.radii.x();
    Fate worst = Fate::passes;
    for (int i = 0; i < 36; ++i) {
        const double angle = 0.174532925 * i + 0.01;
        const Vec3 along(std::cos(angle), 0.0, std::sin(angle));
        const Vec3 middle = scene.placed(Vec3(0.5 * width, 0.0, z));
        // Only where both ends stand on a floor.
        const auto stands = [&](const Vec3& feet) {
            const auto floor =
                sweep_ellipsoid(world, settings.radii, feet + Vec3(0, 2.0, 0), Vec3(0, -2.0, 0));
            return floor && floor->normal.y() > std::cos(settings.max_slope) &&
                   std::abs(feet.y() + 2.0 - 2.0 * floor->t - settings.radii.y() - feet.y()) < 0.4;
        };
        if (!stands(middle - reach * along) || !stands(middle + reach * along)) continue;
        PlayerState state;
        state.position = middle - reach * along + Vec3(0.0, settings.radii.y() + settings.skin, 0.0);
        const auto floor =
            sweep_ellipsoid(world, settings.radii, state.position + Vec3(0, 0.5, 0), Vec3(0, -1, 0));
        if (floor) state.position.y() += 0.5 - floor->t + settings.skin;
        state.grounded = true;
        const Vec3 start = state.position;
        const double patience = 2.0 * (2.0 * reach / settings.walk_speed) +
                                settings.walk_speed / settings.ground_acceleration + 0.2;
        Fate fate = Fate::stops;
        for (int tick = 0; tick * (1.0 / 60.0) < patience; ++tick) {
            state = step(in, settings, state, {.wish = Vec2(along.x(), along.z())}, 1.0 / 60.0).state;
            if ((state.position - start).dot(along) >= 1.96 * reach) fate = Fate::passes;
            if (state.position.y() < start.y() - settings.radii.y()) fate = Fate::falls;
            if (fate != Fate::stops) break;
        }
        worst = std::max(worst, fate);
    }
    return worst;
}

TEST(DoctorRandom, FindsGapsUpToTheBodysWidth) {
    Found found;
    for (unsigned seed = 0; seed < 300; ++seed) {
        Random random(seed);
        const MovementSettings settings = random_settings(random);
        const double widest = 2.0 * settings.radii.x();
        // As many of tenths of a millimetre as of decimetres.
        const double width = 1e-4 * std::pow(0.98 * widest / 1e-4, random.between(0.0, 1.0));
        const DoctorReport report = examine(gap(random, width).level(settings));
        found.count(
            report.count(ProblemKind::crack) > 0 && report.total() == report.count(ProblemKind::crack), seed,
            report);
    }
    found.expect_almost_all();
}

// Whether a player gets over a gap, and whether it falls through, is what a walker meets that the test sends
// over it in headings of its own. Between catching and falling a few degrees may decide.
TEST(DoctorRandom, WhatAGapDoesIsWhatAWalkerMeets) {
    int agreed = 0, checked = 0, falls_claimed = 0, falls_found = 0;
    std::array<int, 3> fates{};
    std::string differing;
    for (unsigned seed = 0; seed < 150; ++seed) {
        Random random(1000 + seed);
        MovementSettings settings = random_settings(random);
        if (random.coin()) settings.step_up = settings.snap_down = false;
        const double width = random.between(0.02, 1.95) * settings.radii.x();
        const Scene scene = gap(random, width);
        const Level level = scene.level(settings);
        const DoctorReport report = examine(level);
        for (const Problem& problem : report.problems) {
            if (problem.kind != ProblemKind::crack) continue;
            const bool falls = problem.text.find("falls through it") != std::string::npos;
            const bool catches = problem.text.find("catches on it") != std::string::npos;
            const Fate claimed = falls ? Fate::falls : catches ? Fate::stops : Fate::passes;
            // Where the doctor looked: inside from the corner that it names.
            const Vec3 local = problem.position - scene.offset;
            const double z = -std::sin(scene.turn) * local.x() + std::cos(scene.turn) * local.z();
            const double inside = z < 1.0 ? width : -width;
            const Fate hit = fate_at_gap(scene, level, width, z + inside);
            ++checked;
            ++fates[static_cast<std::size_t>(hit)];
            falls_claimed += claimed == Fate::falls ? 1 : 0;
            falls_found += claimed == Fate::falls && hit == Fate::falls ? 1 : 0;
            if ((hit == Fate::passes) == (claimed == Fate::passes))
                ++agreed;
            else
                differing += "seed " + std::to_string(seed) + ", width " + std::to_string(width) + ": " +
                             problem.text + ", met " + std::to_string(static_cast<int>(hit)) + "\n";
        }
    }
    EXPECT_GE(checked, 147);
    EXPECT_GE(agreed, 0.98 * checked) << agreed << "/" << checked << "\n" << differing;
    EXPECT_GE(falls_found, 0.95 * falls_claimed);
    for (const int fate : fates)
        EXPECT_GT(fate, 5) << "every fate is there";
}

TEST(DoctorRandom, FindsRampsThatAreALittleTooSteep) {
    Found found;
    for (unsigned seed = 0; seed < 200; ++seed) {
        Random random(2000 + seed);
        const MovementSettings settings = random_settings(random);
        const double slope = settings.max_slope + random.between(0.003, 0.085);
        const DoctorReport report = examine(ramp(random, slope, random.between(0.8, 3.0)).level(settings));
        found.count(report.count(ProblemKind::slope_limit) == 1, seed, report);
    }
    found.expect_almost_all();
}

TEST(DoctorRandom, FindsStairsThatTheSettingsDoNotClimb) {
    Found found;
    for (unsigned seed = 0; seed < 200; ++seed) {
        Random random(3000 + seed);
        MovementSettings settings = random_settings(random);
        double lowest = 1.02 * settings.step_height;
        if (random.coin()) {  // without step up: what an ellipsoid rolls over by itself, and a little more
            settings.step_up = settings.snap_down = false;
            const double across = std::tan(settings.max_slope) * settings.radii.x() / settings.radii.y();
            lowest = 1.05 * settings.radii.y() * (1.0 - 1.0 / std::sqrt(1.0 + across * across));
        }
        const double rise = random.between(lowest, 0.49 * settings.radii.y());
        if (rise < lowest) continue;
        const DoctorReport report =
            examine(stairs(random, rise, random.between(1.3, 2.0) * rise + 0.1, random.between(1, 8))
                        .level(settings));
        found.count(report.count(ProblemKind::step_limit) == 1, seed, report);
    }
    EXPECT_GT(found.planted, 100);
    found.expect_almost_all();
}

// A tile whose neighbour on one side is cut in two has a corner on its edge. A walker does not notice: it
// ends where it ends on the floor in which that edge has a corner, too.
TEST(DoctorRandom, FindsTJunctionsThatAWalkerDoesNotNotice) {
    Found found;
    for (unsigned seed = 0; seed < 100; ++seed) {
        Random random(4000 + seed);
        const MovementSettings settings = random_settings(random);
        Scene scene(random), mended = scene;
        const double deep = random.between(3.0, 8.0), cut = random.between(0.05, 0.95) * deep;
        scene.floor(-4.0, 0.0, 0.0, deep);
        mended.add({{-4, 0, 0}, {-4, 0, deep}, {0, 0, deep}, {0, 0, cut}, {0, 0, 0}});
        for (Scene* each : {&scene, &mended}) {
            each->floor(0.0, 0.0, 4.0, cut);
            each->floor(0.0, cut, 4.0, deep);
        }
        const DoctorReport report = examine(scene.level(settings));
        found.count(report.count(ProblemKind::t_junction) == 1 && report.total() == 1, seed, report);
        EXPECT_EQ(examine(mended.level(settings)).total(), 0u);

        const Level broken = scene.level(settings), whole = mended.level(settings);
        const CollisionWorld a = build_collision_world(broken).value(),
                             b = build_collision_world(whole).value();
        const double angle = random.between(0.0, 6.28);
        const Vec3 along(std::cos(angle), 0.0, std::sin(angle));
        PlayerState one;
        one.position = scene.placed({0, 0, cut}) - along + Vec3(0, settings.radii.y() + settings.skin, 0);
        one.grounded = true;
        PlayerState other = one;
        for (int tick = 0; tick < 40; ++tick) {
            one = step({.collision = a, .surfaces = broken.surfaces}, settings, one,
                       {.wish = Vec2(along.x(), along.z())}, 1.0 / 60)
                      .state;
            other = step({.collision = b, .surfaces = whole.surfaces}, settings, other,
                         {.wish = Vec2(along.x(), along.z())}, 1.0 / 60)
                        .state;
        }
        EXPECT_LT((one.position - other.position).norm(), 1e-3) << "seed " << seed;
    }
    found.expect_almost_all();
}

// A wall that stands on a floor's edge, and is shorter, joins no surface.
TEST(DoctorRandom, AWallOnAFloorsEdgeIsNoTJunction) {
    for (unsigned seed = 0; seed < 50; ++seed) {
        Random random(5000 + seed);
        Scene scene(random);
        const double deep = random.between(3.0, 8.0);
        scene.floor(-4.0, 0.0, 0.0, deep);
        scene.wall(0.0, random.between(0.1, 0.4) * deep, random.between(0.6, 0.9) * deep, 0.0,
                   random.between(1.0, 3.0));
        const DoctorReport report = examine(scene.level(random_settings(random)));
        EXPECT_EQ(report.total(), 0u) << explained(report);
    }
}

}  // namespace
}  // namespace slipface
