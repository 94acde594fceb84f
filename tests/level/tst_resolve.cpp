// Which type a face has, and why: override before suffix before rule before default.
#include "level/faces.h"

namespace slipface::test {
namespace {

Level one_face(const std::string& material) {
    Faces faces = tiles(1);
    faces[0].material = material;
    return level_of(faces);
}

std::pair<std::string, SurfaceSource> resolved(const Level& level) {
    const ResolvedSurfaces surfaces = resolve_surfaces(level);
    return {level.surfaces.at(surfaces.surface.at(0)).name, surfaces.source.at(0)};
}

using Found = std::pair<std::string, SurfaceSource>;

TEST(Resolve, WithoutAnythingAFaceIsDefault) {
    EXPECT_EQ(resolved(one_face("stone")), Found("default", SurfaceSource::none));
}

TEST(Resolve, ARuleMatchesTheMaterialsName) {
    Level level = one_face("Frozen Lake.003");
    level.rules = {{"frozen_*", "ice"}};
    EXPECT_EQ(resolved(level), Found("ice", SurfaceSource::rule));
    level.rules = {{"FROZEN LAKE", "ice"}};
    EXPECT_EQ(resolved(level), Found("ice", SurfaceSource::rule));
    level.rules = {{"Frozen Lake.001", "ice"}};
    EXPECT_EQ(resolved(level), Found("ice", SurfaceSource::rule));
    level.rules = {{"lake", "ice"}};
    EXPECT_EQ(resolved(level), Found("default", SurfaceSource::none));
}

TEST(Resolve, OnlyThreeDigitsBehindADotAreAnEnding) {
    Level level = one_face("tile.12");
    level.rules = {{"tile", "ice"}};
    EXPECT_EQ(resolved(level).second, SurfaceSource::none);
}

TEST(Resolve, TheLastMatchingRuleCounts) {
    Level level = one_face("stone_wet");
    level.rules = {{"*", "sticky"}, {"*_wet", "ice"}, {"wood*", "ladder"}};
    EXPECT_EQ(resolved(level), Found("ice", SurfaceSource::rule));
    std::swap(level.rules[0], level.rules[1]);
    EXPECT_EQ(resolved(level), Found("sticky", SurfaceSource::rule));
}

TEST(Resolve, ARuleWithoutItsTypeIsPassedOver) {
    Level level = one_face("stone");
    level.rules = {{"stone", "ice"}, {"stone", "lava"}};
    EXPECT_EQ(resolved(level), Found("ice", SurfaceSource::rule));
}

TEST(Resolve, TheSuffixComesBeforeRules) {
    Level level = one_face("Stone__Ladder.001");
    level.rules = {{"stone*", "ice"}};
    EXPECT_EQ(resolved(level), Found("ladder", SurfaceSource::suffix));
}

TEST(Resolve, ASuffixThatIsNoTypeIsPartOfTheName) {
    Level level = one_face("stone__mossy");
    level.rules = {{"stone__mossy", "ice"}};
    EXPECT_EQ(resolved(level), Found("ice", SurfaceSource::rule));
}

TEST(Resolve, TheOverrideComesFirstAndDefaultIsOne) {
    Level level = one_face("stone__ladder");
    level.overrides[0] = default_surface;
    EXPECT_EQ(resolved(level), Found("default", SurfaceSource::override_));
    level.overrides[0].reset();
    EXPECT_EQ(resolved(level), Found("ladder", SurfaceSource::suffix));
}

TEST(Resolve, AnOverrideOfNoTypeCountsAsUnset) {
    Level level = one_face("stone");
    level.overrides[0] = SurfaceId{200};
    EXPECT_EQ(resolved(level), Found("default", SurfaceSource::none));
    level.overrides.clear();
    EXPECT_EQ(resolved(level), Found("default", SurfaceSource::none));
}

TEST(Resolve, ALevelWithoutMeshHasNoFaces) {
    EXPECT_TRUE(resolve_surfaces(Level{}).surface.empty());
}

TEST(SurfaceSource, HasANameForEach) {
    EXPECT_STREQ(surface_source_name(SurfaceSource::none), "none");
    EXPECT_STREQ(surface_source_name(SurfaceSource::rule), "rule");
    EXPECT_STREQ(surface_source_name(SurfaceSource::suffix), "suffix");
    EXPECT_STREQ(surface_source_name(SurfaceSource::override_), "override");
}

TEST(LevelCollision, CarriesTheResolvedSurfacesAndTheirRules) {
    Faces faces = tiles(2);
    faces[2].painted = 1;
    Level level = level_of(faces);
    level.surfaces[1].solid = false;
    Result<CollisionWorld> world = build_collision_world(level);
    ASSERT_TRUE(world.ok()) << world.error().text();
    EXPECT_EQ(world->triangle_count(), 8u);
    EXPECT_EQ(world->face_surface(2), 1);
    EXPECT_EQ(world->face_surface(1), default_surface);
    EXPECT_FALSE(world->surface_rule(1).solid);

    // The tile that is not solid lets a ray pass, its neighbour does not.
    const auto above = [&](FaceId face) { return Vec3(face_centroid(*level.mesh, face) + Vec3(0, 1, 0)); };
    EXPECT_FALSE(cast_ray(*world, above(2), -Vec3::UnitY()).has_value());
    EXPECT_TRUE(cast_ray(*world, above(1), -Vec3::UnitY()).has_value());
    level.overrides[2].reset();
    apply_surfaces(*world, level);
    EXPECT_TRUE(cast_ray(*world, above(2), -Vec3::UnitY()).has_value());
}

TEST(LevelCollision, WithoutMeshIsRefused) {
    EXPECT_FALSE(build_collision_world(Level{}).ok());
}

}  // namespace
}  // namespace slipface::test
