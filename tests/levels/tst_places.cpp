// The shipped levels as places to play in: every ladder leads up, every platform carries who stands on it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <stdexcept>

#include "slipface/level/level_file.h"
#include "slipface/level/level_scene.h"

namespace slipface {
namespace {

constexpr double dt = 1.0 / 60.0;
const Vec3 radii(0.4, 0.9, 0.4);

Level load_shipped(const std::string& name) {
    Result<LoadedLevel> loaded =
        load_level(std::filesystem::path(SLIPFACE_SOURCE_DIR) / "assets/levels" / (name + ".obj"));
    if (!loaded) throw std::runtime_error(loaded.error().text());
    return std::move(loaded->level);
}

struct Triangle {
    std::array<Vec3, 3> corner;
    Vec3 normal;  // its length is the area
};
Triangle triangle_of(const Mesh& mesh, TriangleId id) {
    Triangle t;
    for (std::size_t k = 0; k < 3; ++k)
        t.corner[k] = mesh.corner_position(mesh.triangles[id][k]).cast<double>();
    t.normal = 0.5 * (t.corner[1] - t.corner[0]).cross(t.corner[2] - t.corner[0]);
    return t;
}

// Climbable triangles that share vertices and look the same way.
struct Ladder {
    Vec3 out = Vec3::Zero();
    double bottom = 1e9, top = -1e9;
    Vec3 foot = Vec3::Zero();  // the middle of the bottom rung
    FaceId face = no_id;
};

std::vector<Ladder> ladders_of(const Level& level) {
    const Mesh& mesh = *level.mesh;
    const auto surfaces = resolve_surfaces(level).surface;
    std::vector<std::vector<TriangleId>> groups;
    std::map<std::pair<std::uint32_t, std::array<int, 3>>, std::size_t> group_at;  // vertex, facing
    for (TriangleId id = 0; id < mesh.triangle_count(); ++id) {
        if (!level.surfaces[surfaces[mesh.triangle_face[id]]].climbable) continue;
        const Vec3 facing = 2.0 * triangle_of(mesh, id).normal.normalized();
        if (std::abs(facing.y()) > 1.0) continue;
        std::array<int, 3> rounded;
        for (Eigen::Index k = 0; k < 3; ++k)
            rounded[static_cast<std::size_t>(k)] = static_cast<int>(std::lround(facing[k]));
        std::size_t into = groups.size();
        groups.push_back({id});
        for (const std::uint32_t corner : mesh.triangles[id]) {
            const auto [known, fresh] = group_at.try_emplace({mesh.corner_vertex[corner], rounded}, into);
            if (fresh || known->second == into) continue;
            const std::size_t from = into;
            into = known->second;
            groups[into].insert(groups[into].end(), groups[from].begin(), groups[from].end());
            groups[from].clear();
            for (auto& [key, group] : group_at)
                if (group == from) group = into;
        }
    }
    std::vector<Ladder> ladders;
    for (const std::vector<TriangleId>& group : groups) {
        Ladder ladder;
        for (const TriangleId id : group) {
            const Triangle t = triangle_of(mesh, id);
            ladder.out += t.normal;
            ladder.face = mesh.triangle_face[id];
            for (const Vec3& corner : t.corner) {
                ladder.bottom = std::min(ladder.bottom, corner.y());
                ladder.top = std::max(ladder.top, corner.y());
            }
        }
        if (group.empty() || ladder.top - ladder.bottom < 1.0) continue;
        ladder.out.y() = 0.0;
        ladder.out.normalize();
        Aabb rung;
        for (const TriangleId id : group)
            for (const Vec3& corner : triangle_of(mesh, id).corner)
                if (corner.y() < ladder.bottom + 0.05) rung.add(corner);
        ladder.foot = 0.5 * (rung.min + rung.max);
        ladders.push_back(ladder);
    }
    return ladders;
}

class ShippedPlace : public testing::TestWithParam<const char*> {};

// The player walks against the foot of the ladder and keeps the stick there.
TEST_P(ShippedPlace, EveryLadderLeadsUp) {
    const Level level = load_shipped(GetParam());
    MovementSettings settings = level.movement;
    settings.radii = radii;
    Result<LevelScene> scene = LevelScene::build(level, settings);
    ASSERT_TRUE(scene.ok());
    int climbable = 0;
    for (const Ladder& ladder : ladders_of(level)) {
        SCOPED_TRACE(testing::Message() << "face " << ladder.face << ", foot " << ladder.foot.transpose()
                                        << ", out " << ladder.out.transpose() << ", top " << ladder.top);
        // On the floor before it, which may lie above the ladder's lower end.
        Vec3 start = ladder.foot + ladder.out * 0.6 + Vec3(0.0, radii.y() + 0.1, 0.0);
        const MovementScene at_rest = scene->at(0.0);
        for (int i = 0; i < 30 && overlaps_any(at_rest.collision, radii, scene->to_scene(start)); ++i)
            start.y() += 0.1;
        // The back of a ladder may lead to a ceiling; its front must not.
        const Vec3 motion(0.0, ladder.top + radii.y() - start.y(), 0.0);
        if (sweep_ellipsoid(at_rest.collision, radii, scene->to_scene(start), motion)) continue;
        ++climbable;
        PlayerState state = scene->player_at(start);
        const PlayerInput up{.wish = Vec2(-ladder.out.x(), -ladder.out.z())};
        const double highest_centre = ladder.top - radii.y();
        bool climbed = false;
        double reached = -1e9;
        for (int tick = 0; tick < 60 * 20 && reached < highest_centre; ++tick) {
            state = step(scene->at(tick * dt, dt), settings, state, up, dt).state;
            climbed = climbed || state.climbing;
            if (climbed) reached = std::max(reached, scene->to_level(state).y());
        }
        EXPECT_TRUE(climbed);
        EXPECT_GE(reached, highest_centre) << "the player's head does not reach the top rung";
    }
    EXPECT_GT(climbable, 0);
}

// Where on the platform the player stands, in the platform's own frame, stays the same while it moves.
TEST_P(ShippedPlace, EveryPlatformCarries) {
    const Level level = load_shipped(GetParam());
    MovementSettings settings = level.movement;
    settings.radii = radii;
    settings.platforms = true;
    Result<LevelScene> scene = LevelScene::build(level, settings);
    ASSERT_TRUE(scene.ok());
    for (std::uint32_t p = 0; p < scene->platform_count(); ++p) {
        SCOPED_TRACE(level.platforms[p].name);
        // The middle of its largest face that one can stand on.
        Vec3 top = Vec3::Zero();
        double maximum = 0.0;
        for (TriangleId id = 0; id < level.mesh->triangle_count(); ++id) {
            if (scene->face_platforms()[level.mesh->triangle_face[id]] != p) continue;
            const Triangle t = triangle_of(*level.mesh, id);
            if (!(t.normal.y() > 0.95 * t.normal.norm()) || t.normal.norm() <= maximum) continue;
            maximum = t.normal.norm();
            top = (t.corner[0] + t.corner[1] + t.corner[2]) / 3.0;
        }
        ASSERT_GT(maximum, 0.0) << "nothing to stand on";
        const Vec3 start = scene->to_scene(top);
        PlayerState state = scene->player_at(scene->pose(p, 0.0).apply(start) - scene->offset() +
                                             Vec3(0.0, radii.y() + 0.02, 0.0));
        std::optional<Vec3> stood;
        double slipped = 0.0;
        int carried = 0;
        for (int tick = 0; tick < 60 * 12; ++tick) {
            state = step(scene->at(tick * dt, dt), settings, state, {}, dt).state;
            const Pose pose = scene->pose(p, (tick + 1) * dt);
            if (!state.grounded || state.ground_platform == no_id) continue;
            ++carried;
            const Vec3 here = pose.undo(scene->to_scene(scene->to_level(state)));
            if (!stood) stood = here;
            slipped = std::max(slipped, (here - *stood).norm());
        }
        EXPECT_GT(carried, 60 * 11);
        EXPECT_LT(slipped, 0.05);
    }
}

INSTANTIATE_TEST_SUITE_P(All, ShippedPlace, testing::Values("easy", "hard", "island", "playground"),
                         [](const auto& test) { return std::string(test.param); });

}  // namespace
}  // namespace slipface
