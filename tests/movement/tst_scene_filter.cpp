// A step with a filter is a step in a scene that has only what the filter sees: the same bits.
#include <functional>

#include "collision/scenes.h"
#include "slipface/movement/crowd.h"
#include "slipface/movement/first_contact.h"
#include "test_geometry.h"

namespace slipface::test {

namespace {

// Random boxes and leaning plates over a floor, of random groups and types, and two platforms among them.
struct Clutter {
    scenes::Soup soup;
    std::vector<std::uint32_t> groups;
    std::vector<SurfaceId> types;

    void plate(Random& random, const Vec3& at, double half) {
        const Vec3 a(half, random.between(-half, half), 0.0), b(0.0, random.between(-half, half), half);
        soup.add_quad(at - a - b, at - a + b, at + a + b, at + a - b);
        const auto group = std::uint32_t{1} << random.below(3);
        const auto type = static_cast<SurfaceId>(random.below(6));
        for (int i = 0; i < 2; ++i) {
            groups.push_back(group);
            types.push_back(type);
        }
    }
    // Those that `seen` lets through; all have their own faces.
    CollisionWorld world(const std::function<bool(std::size_t)>& seen, bool movable) const {
        scenes::Soup some;
        some.positions = soup.positions;
        for (std::size_t i = 0; i < soup.triangles.size(); ++i) {
            if (!seen(i)) continue;
            some.triangles.push_back(soup.triangles[i]);
            some.faces.push_back(static_cast<FaceId>(i));
        }
        CollisionWorld made = movable ? CollisionWorld::build_movable(some.view()).value() : some.world();
        for (std::size_t i = 0; i < types.size(); ++i)
            made.set_face_surface(static_cast<FaceId>(i), types[i]);
        apply_surface_rules(made, preset_surface_types());
        return made;
    }
};

// The triangles that the callback does not see, by their place.
struct Hidden {
    bool fixed, moving;  // every third triangle of what stands still, or of the platforms
    static bool ask(void* user, std::uint32_t platform, TriangleId triangle) {
        const Hidden& hidden = *static_cast<const Hidden*>(user);
        return !(platform == no_id ? hidden.fixed : hidden.moving) || triangle % 3 != 0;
    }
};

}  // namespace

TEST(SceneFilter, AStepMeetsWhatTheFilterSees) {
    const std::vector<SurfaceType> surfaces = preset_surface_types();
    int differs = 0;
    for (int round = 0; round < 60; ++round) {
        Random random(static_cast<std::uint64_t>(round) + 1);
        Clutter fixed, moving;
        for (int i = 0; i < 40; ++i)
            fixed.plate(random, Vec3(random.between(-6, 6), random.between(-1, 2), random.between(-6, 6)),
                        random.between(0.2, 2.5));
        fixed.plate(random, Vec3::Zero(), 12.0);
        for (int i = 0; i < 4; ++i)
            moving.plate(random, Vec3(random.between(-2, 2), random.between(-1, 1), random.between(-2, 2)),
                         random.between(0.5, 2.0));
        SceneFilter filter{.mask = static_cast<std::uint32_t>(random.below(7)) + 1};
        filter.ignored[static_cast<std::size_t>(random.below(6))] = true;
        Hidden hidden{random.below(2) == 0, random.below(2) == 0};
        filter.ask = Hidden::ask;
        filter.user = &hidden;

        const auto seen_of = [&](const Clutter& of, std::uint32_t platform) {
            return [&of, &filter, platform](std::size_t i) {
                return (of.groups[i] & filter.mask) != 0 && !filter.ignored[of.types[i]] &&
                       Hidden::ask(filter.user, platform, static_cast<TriangleId>(i));
            };
        };
        const auto all = [](std::size_t) { return true; };
        const CollisionWorld whole = fixed.world(all, false), whole_part = moving.world(all, true);
        const CollisionWorld only = fixed.world(seen_of(fixed, no_id), false),
                             only_part = moving.world(seen_of(moving, 0), true);
        MovementSettings settings = round % 2 == 0 ? MovementSettings{} : every_hack();
        PlayerState filtered = at({random.between(-4, 4), 3.0, random.between(-4, 4)}), alone = filtered,
                    unfiltered = filtered;
        PlayerInput input;
        for (int i = 0; i < 120; ++i) {
            if (i % 15 == 0) input = wish(random.between(-1, 1), random.between(-1, 1), random.below(3) == 0);
            MovingPart part;
            part.rest = &whole_part;
            part.groups = moving.groups;
            part.begin.offset = Vec3(0.02 * i, 0.0, 0.01 * i);
            part.end.offset = Vec3(0.02 * (i + 1), 0.0, 0.01 * (i + 1));
            part.pivot = part.end.offset;
            part.velocity = (part.end.offset - part.begin.offset) / tick;
            MovingPart same = part;
            same.rest = &only_part;
            same.groups = {};
            const MovementScene scene{.collision = whole,
                                      .surfaces = surfaces,
                                      .platforms = {&part, 1},
                                      .groups = fixed.groups,
                                      .filter = &filter};
            MovementScene plain = scene;
            plain.filter = nullptr;
            const MovementScene built{.collision = only, .surfaces = surfaces, .platforms = {&same, 1}};
            filtered = step(scene, settings, filtered, input, tick).state;
            alone = step(built, settings, alone, input, tick).state;
            unfiltered = step(plain, settings, unfiltered, input, tick).state;
            ASSERT_EQ(filtered, alone) << "round " << round << ", tick " << i;
            const Vec3 move(random.between(-3, 3), random.between(-3, 1), random.between(-3, 3));
            const auto a = first_contact(scene, settings.radii, filtered.position, move);
            const auto b = first_contact(built, settings.radii, filtered.position, move);
            ASSERT_EQ(a.has_value(), b.has_value());
            ASSERT_TRUE(!a || (a->t == b->t && a->face == b->face));
            ASSERT_EQ(slide_move(scene, settings, filtered.position, move).position,
                      slide_move(built, settings, filtered.position, move).position);
        }
        differs += filtered != unfiltered;
    }
    EXPECT_GT(differs, 40);  // the filters matter
}

TEST(SceneFilter, CharactersOfOtherGroupsPassThroughEachOther) {
    Lab lab;
    lab.floor();
    lab.ready();
    const MovementSettings settings = basic_settings();
    const double height = centre_height(settings, Vec3::UnitY());
    const SceneFilter red{.mask = ~std::uint32_t{2}, .groups = 1}, blue{.groups = 2};
    for (const SceneFilter* second : {&blue, &red}) {
        std::vector<CrowdMember> crowd(2);
        for (int i = 0; i < 2; ++i) {
            crowd[static_cast<std::size_t>(i)].settings = &settings;
            crowd[static_cast<std::size_t>(i)].state = at({i == 0 ? -2.0 : 2.0, height, 0.0});
            crowd[static_cast<std::size_t>(i)].input = wish(i == 0 ? 1 : -1, 0);
        }
        crowd[0].filter = &red;
        crowd[1].filter = second;
        PlayerState alone = crowd[0].state;
        for (int i = 0; i < 60; ++i) {
            step_crowd(lab.scene(), crowd, tick);
            alone = step(lab.scene(), settings, alone, crowd[0].input, tick).state;
        }
        if (second == &blue) {
            EXPECT_EQ(crowd[0].state, alone);  // red does not meet blue, so neither meets the other
        } else {
            EXPECT_LT(crowd[0].state.position.x(), 0.0);
        }
    }
}

}  // namespace slipface::test
