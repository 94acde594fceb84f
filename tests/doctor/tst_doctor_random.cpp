// Random scenes of random sizes, turned and moved: clean ones in which the doctor must find nothing, and ones
// with a planted defect that it must find, with the consequence that a walker meets.
#include <gtest/gtest.h>

#include <array>
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

// A flight between two floors, with cheeks to both sides down to the ground. Some have a strip along the rim
// of each riser.
Scene stairs(Random& random, double rise, double run, int steps) {
    Scene scene(random);
    const double wide = random.between(1.5, 4.0);
    const double strip = random.coin() ? random.between(0.1, 0.9) * rise : 0.0;
    scene.floor(-4.0, 0.0, 0.0, wide);
    for (int i = 0; i < steps; ++i) {
        scene.wall(i * run, 0.0, wide, i * rise, (i + 1) * rise - strip);
        if (strip > 0.0) scene.wall(i * run, 0.0, wide, (i + 1) * rise - strip, (i + 1) * rise);
        const double end = i + 1 < steps ? (i + 1) * run : i * run + 4.0;
        scene.floor(i * run, 0.0, end, wide, (i + 1) * rise);
    }
    return scene;
}

// One slope between two floors: as one face, as several one above the other, or as triangles.
Scene ramp(Random& random, double slope, double high) {
    Scene scene(random);
    const double wide = random.between(1.5, 4.0), run = high / std::tan(slope);
    scene.floor(-4.0, 0.0, 0.0, wide);
    const int pieces = random.between(1, 3);
    const bool triangles = random.coin();
    for (int i = 0; i < pieces; ++i) {
        const double x0 = run * i / pieces, x1 = run * (i + 1) / pieces;
        const double y0 = high * i / pieces, y1 = high * (i + 1) / pieces;
        if (triangles) {
            scene.add({{x0, y0, 0.0}, {x0, y0, wide}, {x1, y1, wide}});
            scene.add({{x0, y0, 0.0}, {x1, y1, wide}, {x1, y1, 0.0}});
        } else {
            scene.floor(x0, 0.0, x1, wide, y0, y1);
        }
    }
    scene.floor(run, 0.0, run + 4.0, wide, high);
    return scene;
}

// A closed lump of triangles around a vertical axis: rings of corners at random distances and heights.
void add_boulder(Scene& scene, Random& random, const Vec3& foot, double radius, double height) {
    constexpr int sides = 7;
    std::vector<std::array<Vec3, sides>> rings;
    const double fraction[] = {-0.2, 0.42, 0.85}, swell[] = {1.0, 1.05, 0.6};
    for (std::size_t row = 0; row < 3; ++row) {
        std::array<Vec3, sides>& ring = rings.emplace_back();
        for (int side = 0; side < sides; ++side) {
            const double angle = 6.283185 * (side + random.between(-0.17, 0.17)) / sides;
            const double r = radius * swell[row] * random.between(0.8, 1.15);
            ring[static_cast<std::size_t>(side)] =
                foot + Vec3(r * std::cos(angle), height * fraction[row] * random.between(0.85, 1.15),
                            -r * std::sin(angle));
        }
    }
    const Vec3 top = foot + Vec3(0.1 * radius, height, 0.05 * radius);
    for (std::size_t side = 0; side < sides; ++side) {
        const std::size_t next = (side + 1) % sides;
        for (std::size_t row = 0; row < 2; ++row) {
            scene.add({rings[row][side], rings[row][next], rings[row + 1][next]});
            scene.add({rings[row][side], rings[row + 1][next], rings[row + 1][side]});
        }
        scene.add({rings[2][side], rings[2][next], top});
    }
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
            case 0: check(room(random), "room"); break;
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

// What becomes of a walker that the test itself sends over the middle of a gap, in every direction across it:
// the first that is not to pass.
Fate fate_at_gap(const Scene& scene, const Level& level, double width, double z) {
    const MovementSettings& settings = level.movement;
    const CollisionWorld world = build_collision_world(level).value();
    const MovementScene in{.collision = world, .surfaces = level.surfaces};
    const double reach = 1.5 * settings.radii.x();
    for (int i = 0; i < 180; ++i) {
        const double angle = 0.0349065850 * i + 0.01;
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
        if (fate != Fate::passes) return fate;
    }
    return Fate::passes;
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

// Whether a player gets over a gap is what a walker meets that the test sends over it in headings of its own.
// A gap that is narrower than the body lets nobody through.
TEST(DoctorRandom, WhatAGapDoesIsWhatAWalkerMeets) {
    int checked = 0;
    std::array<int, 3> fates{};
    std::string differing;
    int differ = 0;
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
            // Away from the ends of the gap, where a walker may leave the floors sideways.
            const Vec3 local = problem.position - scene.offset;
            const double z = -std::sin(scene.turn) * local.x() + std::cos(scene.turn) * local.z();
            const double inside = (z < 1.0 ? 2.5 : -2.5) * settings.radii.x();
            const Fate hit = fate_at_gap(scene, level, width, z + inside);
            ++checked;
            ++fates[static_cast<std::size_t>(hit)];
            if (hit == claimed) continue;
            ++differ;
            differing += "seed " + std::to_string(seed) + ", width " + std::to_string(width) + ": " +
                         problem.text + ", met " + std::to_string(static_cast<int>(hit)) + "\n";
        }
    }
    EXPECT_EQ(checked, 150);
    EXPECT_LE(differ, 1) << differing;  // the doctor walks at every fifth degree, the test at every second
    EXPECT_EQ(fates[2], 0);
    EXPECT_GT(fates[0], 40);
    EXPECT_GT(fates[1], 40);
}

// Where two gaps cross, a body falls through that neither of them lets through.
TEST(DoctorRandom, SaysWhereCrossingGapsLetThePlayerFall) {
    Found wide_enough, too_narrow;
    for (unsigned seed = 0; seed < 24; ++seed) {
        Random random(6000 + seed);
        const MovementSettings settings = random_settings(random);
        // The corners of four floors are `diagonal` bodies apart.
        const bool fits = random.coin();
        const double diagonal = fits ? random.between(1.2, 1.38) : random.between(0.5, 0.95);
        const double width = diagonal * 1.41421356 * settings.radii.x();
        Scene scene(random);
        for (const double x : {-4.0 - 0.5 * width, 0.5 * width})
            for (const double z : {-4.0 - 0.5 * width, 0.5 * width})
                scene.floor(x, z, x + 4.0, z + 4.0);
        const DoctorReport report = examine(scene.level(settings));
        const bool falls = explained(report).find("falls through it") != std::string::npos;
        (fits ? wide_enough : too_narrow)
            .count(falls == fits && report.count(ProblemKind::crack) > 0, seed, report);
    }
    wide_enough.expect_almost_all();
    too_narrow.expect_almost_all();
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

// Boulders have facets of every slope, and lead from no floor to another one; these have no ledge as low as a
// step.
TEST(DoctorRandom, FindsNothingInBoulders) {
    int facets_at_the_limit = 0;
    for (unsigned seed = 0; seed < 200; ++seed) {
        Random random(7000 + seed);
        const MovementSettings settings = random_settings(random);
        Scene scene(random);
        scene.floor(-6.0, -6.0, 6.0, 6.0);
        add_boulder(scene, random, Vec3::Zero(), random.between(0.8, 3.0), random.between(1.6, 3.2));
        const Level level = scene.level(settings);
        for (FaceId face = 1; face < level.mesh->face_count(); ++face) {
            const double slope = std::acos(face_normal(*level.mesh, face).y());
            if (slope > settings.max_slope && slope < settings.max_slope + 0.087) ++facets_at_the_limit;
        }
        const DoctorReport report = examine(level);
        EXPECT_EQ(report.total(), 0u) << "seed " << seed << "\n" << explained(report);
    }
    EXPECT_GT(facets_at_the_limit, 200);
}

// Upright faces as low as steps that are none: of a slab that is sunk into the floor, and of the rim of
// something higher than a step.
TEST(DoctorRandom, FindsNoStepsInSunkSlabsAndHighRims) {
    for (unsigned seed = 0; seed < 100; ++seed) {
        Random random(8000 + seed);
        MovementSettings settings = random_settings(random);
        settings.step_up = settings.snap_down = false;
        const double across = std::tan(settings.max_slope) * settings.radii.x() / settings.radii.y();
        const double rolls = settings.radii.y() * (1.0 - 1.0 / std::sqrt(1.0 + across * across));
        Scene scene(random);
        scene.floor(-6.0, -6.0, 6.0, 6.0);
        const bool sunk = random.coin();
        const double high =
            sunk ? random.between(0.2, 0.8) * rolls : random.between(0.55, 0.9) * settings.radii.y();
        const double low = sunk ? high - random.between(1.1, 2.0) * rolls
                                : high - random.between(1.1 * rolls, 0.49 * settings.radii.y());
        scene.floor(0.0, -1.0, 3.0, 1.0, high);
        scene.wall(0.0, -1.0, 1.0, low, high);
        if (!sunk) scene.wall(0.05, -1.0, 1.0, 0.0, low);  // the rim stands out
        const DoctorReport report = examine(scene.level(settings));
        EXPECT_EQ(report.total(), 0u) << "seed " << seed << "\n" << explained(report);
    }
}

// A step that can be climbed, on which a rail stands in the way.
TEST(DoctorRandom, FindsNoStepUnderARail) {
    for (unsigned seed = 0; seed < 100; ++seed) {
        Random random(8500 + seed);
        const MovementSettings settings = random_settings(random);
        const double radius = settings.radii.x();
        const double rise = random.between(0.5, 0.95) * settings.step_height;
        // So high that the doctor's rays for the floor behind the lower half of the riser begin inside it.
        const double rail = 0.5 * rise + random.between(0.51, 0.56) * settings.radii.y();
        const double to = random.between(-0.9, 0.9) * radius;
        Scene scene(random);
        scene.floor(-6.0, -6.0, 0.0, 6.0);
        scene.floor(0.0, -1.0, 3.0, 1.0, rise);
        scene.wall(0.0, -1.0, 1.0, 0.0, 0.5 * rise);
        scene.wall(0.0, -1.0, 1.0, 0.5 * rise, rise);
        const double deep = random.between(0.2, 0.5);
        scene.wall(0.0, -1.0, to, rise, rail);
        scene.floor(0.0, -1.0, deep, to, rail);
        scene.add({{0, rail, to}, {0, rise, to}, {deep, rise, to}, {deep, rail, to}});
        scene.add({{deep, rise, -1}, {deep, rail, -1}, {deep, rail, to}, {deep, rise, to}});
        const DoctorReport report = examine(scene.level(settings));
        for (const Problem& problem : report.problems)  // the rail may be a step itself
            EXPECT_TRUE(problem.kind != ProblemKind::step_limit || (problem.face != 2 && problem.face != 3))
                << "seed " << seed << ": " << problem.text;
    }
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
