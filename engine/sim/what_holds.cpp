#include "what_holds.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>

#include "story_words.h"
#include "trial.h"

namespace slipface {
namespace trying {

// What must be regained of the motion that was lost; cures ask for the same.
constexpr double regained = 0.5;
// Trials start this long before the stop, so that the player arrives as it did.
constexpr double run_up_s = 0.1;
// What makes a player fall is looked for this long before the ground is left.
constexpr double before_fall_s = 1.5;
// What leans with the stick by this much is at the player's back.
constexpr double least_behind = 0.3;
// What stopped the player is measured this far from where it begins: the first step of stairs, not the
// flight.
constexpr double measured_m = 0.1;
// The ground before it ends at its foot.
constexpr double just_before_m = 0.01;
constexpr int max_rounds = 24;
constexpr std::size_t max_obstacles = 40;
// Faces are of one plane if their normals and their offsets differ by no more.
constexpr double same_normal = 0.999, same_offset_m = 0.002;

struct Meeting {
    FaceId face = no_id;
    bool within = false;  // touched inside the face, and not at its rim
    Vec3 normal = Vec3::Zero();
    Vec3 point = Vec3::Zero();
    double lost_m = 0.0;
};

// The contacts of a trial that may hold the player: they lean against the stick, or hang over the head.
class Meetings final : public TraceSink {
  public:
    std::vector<Meeting> all;
    Vec3 heading = Vec3::Zero();
    Vec3 offset = Vec3::Zero();  // of the records' coordinates to the level's
    const StoryNames* names = nullptr;
    MovementSettings settings;
    bool every = false;                 // whatever is touched
    std::optional<SurfaceId> carrying;  // the type that is climbed: as the floor, it is not to blame
    FaceId behind = no_id;              // an edge at the player's back

    void add(const TraceRecord& record) override {
        if (const auto* sweep = std::get_if<SweepRecord>(&record)) take(*sweep);
        if (const auto* response = std::get_if<ResponseRecord>(&record)) take(*response);
        const auto* decision = std::get_if<DecisionRecord>(&record);
        if (every && decision && decision->kind == Decision::platform_pushed && decision->face != no_id)
            of(decision->face);
    }

  private:
    Meeting& of(FaceId face) {
        const auto known = std::ranges::find(all, face, &Meeting::face);
        if (known != all.end()) return *known;
        all.push_back({.face = face});
        return all.back();
    }
    void take(const SweepRecord& sweep) {
        if (!sweep.contact || sweep.contact->face == no_id) return;
        const Vec3& normal = sweep.contact->normal;
        const bool within = sweep.contact->feature == Feature::interior;
        if (carrying && sweep.contact->surface == *carrying) return;
        if (!within && normal.dot(heading) > least_behind && normal.y() > 0.0) behind = sweep.contact->face;
        const bool against =
            normal.dot(heading) < -1e-3 && !is_walkable(*names, settings, normal, sweep.contact->surface);
        if (!every && !against && normal.y() > -1e-3) return;
        Meeting& meeting = of(sweep.contact->face);
        if (!meeting.normal.isZero(0.0) && (meeting.within || !within)) return;
        meeting.within = within;
        meeting.normal = normal;
        meeting.point = sweep.contact->point + offset;
    }
    void take(const ResponseRecord& response) {
        const double lost = heading.dot(response.remainder_before - response.remainder_after);
        const auto known = std::ranges::find(all, response.face, &Meeting::face);
        if (known != all.end() && lost > 0.0) known->lost_m += lost;
    }
};

// Of the angle between two directions as seen from above.
double level_cosine(const Vec3& a, const Vec3& b) {
    return Vec2(a.x(), a.z()).normalized().dot(Vec2(b.x(), b.z()).normalized());
}

// A polygon cut by a plane: what lies where inside(x) >= 0.
template <class Inside>
void cut(std::vector<Vec3>& polygon, Inside inside) {
    std::vector<Vec3> kept;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Vec3& a = polygon[i];
        const Vec3& b = polygon[(i + 1) % polygon.size()];
        const double at_a = inside(a), at_b = inside(b);
        if (at_a >= 0.0) kept.push_back(a);
        if ((at_a < 0.0) != (at_b < 0.0)) kept.push_back(a + (b - a) * (at_a / (at_a - at_b)));
    }
    polygon = std::move(kept);
}

}  // namespace trying

using namespace trying;

struct WhatHolds::Impl {
    const Level& level;
    const TapeRun& run;
    StoryNames names;
    std::optional<LevelScene> built;
    std::optional<TickScene> scene;
    RunStart start;
    std::optional<SurfaceId> nothing;
    MeshPtr mesh;
    std::vector<Obstacle> obstacles;
    std::vector<double> lost;                                  // [obstacle] in all trials
    std::optional<std::pair<std::size_t, PlayerState>> began;  // a tick, and the state before it
    // Of the stop that was looked at last.
    std::size_t begin = 0, end = 0;
    double needed = 0.0;
    Meetings met;
    std::vector<Meeting> met_first;  // in the run as it was
    FaceId behind = no_id;

    void forget() {
        obstacles.clear();
        lost.clear();
        met = {};
        met.offset = -built->offset();
        met.names = &names;
    }
    void look_along(std::size_t tick) {
        const TickSample before = tick > 0 ? run.samples()[tick - 1] : TickSample{};
        if (before.climbing) met.carrying = before.surface;
        const Vec2 wish = run.input_at(tick).wish;
        if (!wish.isZero(0.0)) met.heading = Vec3(wish.x(), 0.0, wish.y()).normalized();
        met.settings = run.settings_at(tick);
    }
    std::vector<std::size_t> all() const {
        std::vector<std::size_t> indices(obstacles.size());
        std::iota(indices.begin(), indices.end(), std::size_t{0});
        return indices;
    }

    Impl(const Level& in, const TapeRun& of) : level(in), run(of), names(in) {}

    bool build() {
        if (built) return nothing.has_value();
        Result<LevelScene> result = LevelScene::build(level, run.settings());
        if (!result) return false;
        built.emplace(std::move(*result));
        scene.emplace(*built);
        start = run_start(*scene, run.start());
        nothing = built->nothing();
        mesh = level.mesh;
        return nothing.has_value();
    }

    // Plays the ticks from `first` up to `end` without the obstacles in `gone`.
    Trial play(std::size_t first, std::size_t last, const std::vector<std::size_t>& gone, TraceSink* trace,
               std::vector<std::string> settings = {}) {
        Trial trial;
        trial.state = state_before(first);
        for (const std::size_t i : gone)
            built->try_surface(obstacles[i].faces, *nothing);
        trial.tick = first;
        trial.end = std::min(last, run.length());
        trial.settings = std::move(settings);
        trial.advance(*scene, run, start, run.length(), trace);
        built->end_trial();
        return trial;
    }

    // In the level as it is.
    const PlayerState& state_before(std::size_t tick) {
        if (!began || began->first != tick) began.emplace(tick, run.state_before(*scene, tick));
        return began->second;
    }

    std::uint32_t platform_of(FaceId face) const {
        const auto platforms = built->face_platforms();
        return face < platforms.size() ? platforms[face] : no_id;
    }

    // All faces around that lie in the plane of `face`, or all of its platform.
    std::vector<FaceId> plane_of(FaceId face) {
        std::vector<FaceId> faces;
        if (const std::uint32_t platform = platform_of(face); platform != no_id) {
            for (FaceId other = 0; other < mesh->face_count(); ++other)
                if (platform_of(other) == platform) faces.push_back(other);
            return faces;
        }
        const Vec3 normal = face_normal(*mesh, face), at = face_centroid(*mesh, face);
        Aabb box;
        const std::uint32_t first = mesh->face_first_corner[face];
        for (std::uint32_t i = 0; i < mesh->face_corner_count(face); ++i)
            box.add(mesh->corner_position(first + i).cast<double>() + built->offset());
        box.min.array() -= 4.0;
        box.max.array() += 4.0;
        const CollisionWorld& world = scene->at(0, run.dt()).collision;
        for (const TriangleId triangle : world.triangles_in(box)) {
            const FaceId other = world.triangle_face(triangle);
            if (!faces.empty() && faces.back() == other) continue;
            if (mesh->face_group[other] != mesh->face_group[face]) continue;
            const bool same =
                other == face || (std::abs(face_normal(*mesh, other).dot(normal)) > same_normal &&
                                  std::abs((face_centroid(*mesh, other) - at).dot(normal)) < same_offset_m);
            if (same) faces.push_back(other);
        }
        if (faces.empty()) faces.push_back(face);
        std::ranges::sort(faces);
        faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
        return faces;
    }

    std::vector<FaceId> object_of(FaceId face) const {
        std::vector<FaceId> faces;
        for (FaceId other = 0; other < mesh->face_count(); ++other)
            if (mesh->face_group[other] == mesh->face_group[face]) faces.push_back(other);
        return faces;
    }

    // The obstacles of these meetings; true if one of them is new.
    bool note(const std::vector<Meeting>& meetings) {
        bool more = false;
        for (const Meeting& meeting : meetings) {
            auto known = std::ranges::find_if(obstacles, [&](const Obstacle& o) {
                return std::ranges::binary_search(o.faces, meeting.face);
            });
            if (known == obstacles.end()) {
                if (obstacles.size() >= max_obstacles) continue;
                obstacles.push_back({.faces = plane_of(meeting.face),
                                     .face = meeting.face,
                                     .normal = meeting.normal,
                                     .point = meeting.point,
                                     .platform = platform_of(meeting.face)});
                lost.push_back(0.0);
                known = obstacles.end() - 1;
                more = true;
            }
            lost[static_cast<std::size_t>(known - obstacles.begin())] += meeting.lost_m;
        }
        return more;
    }

    // The height of the ground that the player stands on, `ahead` metres from its middle; of its feet where
    // there is none near.
    double ground_ahead(std::size_t tick, const PlayerState& state, const MovementSettings& settings,
                        double ahead) const {
        const MovementScene at = scene->at(tick, run.dt());
        const double half = settings.radii.y();
        const Vec3 centre = position_in_scene(at, state);
        const Vec3 from = centre + std::max(0.0, ahead - just_before_m) * met.heading;
        const double feet = scene->to_level(state).y() - half - settings.skin;
        if (!state.grounded) return feet;
        const double down = half + std::max(settings.step_height, settings.snap_distance);
        const auto hit = cast_ray(at.collision, from, Vec3(0.0, -down, 0.0), 1.0, RayStops::as_movement);
        return hit ? feet + half + settings.skin - hit->t * down : feet;
    }

    Holding holding(const std::vector<std::size_t>& which) const {
        Holding all;
        for (const std::size_t i : which)
            all.push_back(obstacles[i]);
        return all;
    }

    // What made the player fall, of all that it touched from before it left the ground: a type, in whose
    // place plain ground would have kept it up, or a platform.
    std::optional<Carrier> of_touch(std::size_t left, std::size_t last) {
        begin = ticks_before(run, left, before_fall_s);
        const PlayerState leaving = state_before(left);
        const double lowest = scene->to_level(leaving).y() - run.settings_at(left).step_height;
        const auto stays = [&](std::span<const FaceId> faces, SurfaceId type) {
            Trial trial;
            trial.state = state_before(begin);
            built->try_surface(faces, type);
            trial.tick = begin;
            trial.end = std::min(last + 1, run.length());
            trial.advance(*scene, run, start, run.length());
            built->end_trial();
            return !trial.sent_back && is_held(trial.state) && scene->to_level(trial.state).y() > lowest;
        };
        forget();
        met.every = true;
        play(begin, last + 1, {}, &met);
        const ResolvedSurfaces resolved = resolve_surfaces(level);
        std::vector<SurfaceId> tried{default_surface};
        for (const Meeting& meeting : met.all) {
            const SurfaceId type = resolved.surface[meeting.face];
            if (std::ranges::find(tried, type) != tried.end()) continue;
            tried.push_back(type);
            Obstacle touched;
            touched.face = meeting.face;
            for (FaceId face = 0; face < resolved.surface.size(); ++face)
                if (resolved.surface[face] == type) touched.faces.push_back(face);
            if (stays(touched.faces, default_surface))
                return Carrier{{touched}, FallCause::by_type, leaving.ground_face, type};
        }
        note(met.all);
        // What stands still pushes only who is carried against it.
        const bool rides = leaving.ground_platform != no_id;
        for (Obstacle& obstacle : obstacles) {
            if (obstacle.platform == no_id) {
                if (!rides) continue;
                obstacle.faces = object_of(obstacle.face);
            }
            if (stays(obstacle.faces, *nothing))
                return Carrier{{obstacle}, FallCause::pushed, leaving.ground_face};
        }
        return std::nullopt;
    }

    // The sets that suffice: single obstacles, else single objects, else one set without anything that may
    // stay.
    template <class Frees>
    std::vector<Holding> smallest(std::vector<std::size_t> all, Frees frees) {
        std::vector<Holding> found;
        std::ranges::stable_sort(all, std::greater(), [&](std::size_t i) { return lost[i]; });
        for (const std::size_t i : all)
            if (frees(std::vector{i})) found.push_back(holding({i}));
        if (!found.empty()) return found;
        for (std::size_t i = 0; i < all.size(); ++i) {
            const std::uint32_t group = mesh->face_group[obstacles[all[i]].face];
            const auto of_group = [&](std::size_t j) { return mesh->face_group[obstacles[j].face] == group; };
            if (std::any_of(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(i), of_group)) continue;
            std::vector<std::size_t> met_of_group;
            std::ranges::copy_if(all, std::back_inserter(met_of_group), of_group);
            if (met_of_group.size() < all.size() && frees(met_of_group)) {
                found.push_back(holding(reduced(met_of_group, frees)));
            } else if (mesh->groups.size() > 1) {
                // With what would be met of it next.
                Obstacle whole = obstacles[all[i]];
                whole.faces = object_of(whole.face);
                obstacles.push_back(std::move(whole));
                if (frees(std::vector{obstacles.size() - 1})) found.push_back({obstacles.back()});
                obstacles.pop_back();
            }
        }
        if (found.empty()) found.push_back(holding(reduced(all, frees)));
        return found;
    }

    // One by one, the last met first, what need not go stays.
    template <class Frees>
    std::vector<std::size_t> reduced(std::vector<std::size_t> set, Frees frees) {
        for (std::size_t i = set.size(); i-- > 0 && set.size() > 1;) {
            std::vector<std::size_t> fewer = set;
            fewer.erase(fewer.begin() + static_cast<std::ptrdiff_t>(i));
            if (frees(fewer)) set = std::move(fewer);
        }
        return set;
    }
};

WhatHolds::WhatHolds(const Level& level, const TapeRun& run) : impl_(std::make_unique<Impl>(level, run)) {}
WhatHolds::~WhatHolds() = default;

std::vector<Holding> WhatHolds::of_stop(std::size_t first, double lost_m) {
    Impl& impl = *impl_;
    if (impl.run.input_at(first).wish.isZero(0.0) || !(lost_m > 0.0) || !impl.build()) return {};
    impl.forget();
    impl.look_along(first);
    impl.begin = ticks_before(impl.run, first, run_up_s);
    impl.end = first + ticks_in(impl.run, looked_at_s);
    impl.needed = impl.play(impl.begin, impl.end, {}, &impl.met).advanced_m + regained * lost_m;
    impl.met_first = impl.met.all;
    impl.behind = impl.met.behind;
    const auto frees = [&](const std::vector<std::size_t>& gone, TraceSink* trace = nullptr) {
        const Trial trial = impl.play(impl.begin, impl.end, gone, trace);
        return trial.advanced_m >= impl.needed && !trial.sent_back;
    };
    for (int round = 0; round < max_rounds && impl.note(impl.met.all); ++round) {
        impl.met.all.clear();
        if (frees(impl.all(), &impl.met)) return impl.smallest(impl.all(), frees);
    }
    return {};
}

std::optional<Obstacle> WhatHolds::beside(const Obstacle& wall, std::size_t first, std::size_t last) {
    Impl& impl = *impl_;
    Meetings at_rest;
    at_rest.heading = impl.met.heading;
    at_rest.offset = impl.met.offset;
    at_rest.names = &impl.names;
    at_rest.settings = impl.met.settings;
    at_rest.all = impl.met_first;
    impl.play(std::max(first, last - std::min(last, ticks_in(impl.run, looked_at_s))), last + 1, {},
              &at_rest);
    const Meeting* found = nullptr;
    for (const Meeting& other : at_rest.all) {
        if (other.face == wall.face) continue;
        const bool upright = std::abs(other.normal.y()) < 0.5 && other.normal.dot(at_rest.heading) < -0.05;
        // A post has two sides, too, but neither stands before the other.
        const bool before = (other.point - wall.point).dot(wall.normal) > 1e-3;
        if (!upright || !before || level_cosine(other.normal, wall.normal) > 0.9) continue;
        if (found == nullptr || other.lost_m > found->lost_m) found = &other;
    }
    if (found == nullptr) return std::nullopt;
    return Obstacle{{found->face}, found->face, found->normal, found->point, impl.platform_of(found->face)};
}

FaceId WhatHolds::rim_before(double nearest, std::size_t tick) {
    Impl& impl = *impl_;
    const PlayerState state = impl.state_before(tick);
    const MovementSettings settings = settings_of_body(impl.run.settings_at(tick), state);
    // What moves under the feet is not among what the ray below sees.
    if (!state.grounded || state.ground_platform != no_id) return no_id;
    if (impl.behind != no_id) return impl.behind;
    const MovementScene scene = impl.scene->at(tick, impl.run.dt());
    const Vec3 feet = position_in_scene(scene, state) - Vec3(0.0, settings.radii.y(), 0.0);
    // Ground that falls no more than by a step, or by 45 degrees.
    const double half = 0.5 * settings.radii.y();
    for (const double part : {0.5, 0.75, 0.95}) {
        const double ahead = part * nearest, down = half + settings.step_height + std::max(ahead, 0.0);
        const Vec3 above = feet + ahead * impl.met.heading + Vec3(0.0, half, 0.0);
        if (!cast_ray(scene.collision, above, Vec3(0.0, -down, 0.0), 1.0, RayStops::as_movement))
            return state.ground_face;
    }
    return no_id;
}

bool WhatHolds::lets_thin_through() {
    constexpr double thin = 0.25;
    Impl& impl = *impl_;
    const Vec3 radii = thin * impl.run.settings_at(impl.begin).radii;
    const Trial trial =
        impl.play(impl.begin, impl.end, {}, nullptr,
                  {fmt::format("radius_x={}", radii.x()), fmt::format("radius_z={}", radii.z())});
    return trial.advanced_m >= impl.needed;
}

std::vector<Holding> WhatHolds::of_crush(std::size_t tick) {
    Impl& impl = *impl_;
    if (!impl.build()) return {};
    impl.forget();
    impl.met.every = true;
    impl.begin = ticks_before(impl.run, tick, run_up_s);
    impl.end = tick + 1;
    impl.play(impl.begin, impl.end, {}, &impl.met);
    impl.note(impl.met.all);
    std::vector<Holding> found;
    for (const std::size_t i : impl.all())
        if (!impl.play(impl.begin, impl.end, {i}, nullptr).sent_back) found.push_back(impl.holding({i}));
    return found;
}

std::optional<WhatHolds::Carrier> WhatHolds::of_fall(std::size_t left, std::size_t end, double lowest) {
    Impl& impl = *impl_;
    if (!impl.build()) return std::nullopt;
    impl.forget();
    impl.look_along(left);

    // The face on which the player lands high enough before the end of the trial, if it does.
    const auto lands = [&](std::span<const FaceId> faces, SurfaceId type) -> std::optional<FaceId> {
        Trial trial;
        trial.state = impl.state_before(left);
        impl.built->try_surface(faces, type);
        trial.tick = left;
        trial.end = std::min(end + 1, impl.run.length());
        std::optional<FaceId> ground;
        while (!trial.done() && !ground) {
            trial.advance(*impl.scene, impl.run, impl.start, 1);
            // Not the ground that it leaves in the first tick.
            if (trial.sent_back || !trial.state.grounded || trial.tick <= left + 1) continue;
            if (!(impl.scene->to_level(trial.state).y() > lowest)) continue;
            // Nor the inside of what was taken away.
            const FaceId face = trial.state.ground_face;
            const bool inside = type == *impl.nothing && face < impl.mesh->face_count() &&
                                face_normal(*impl.mesh, face).y() < -0.1;
            if (!inside) ground = face;
        }
        impl.built->end_trial();
        return ground;
    };
    const ResolvedSurfaces resolved = resolve_surfaces(impl.level);
    const auto let_through = [&](FallCause cause, auto&& lets) -> std::optional<Carrier> {
        std::vector<FaceId> faces;
        for (FaceId face = 0; face < resolved.surface.size(); ++face)
            if (lets(impl.level.surfaces[resolved.surface[face]])) faces.push_back(face);
        if (faces.empty()) return std::nullopt;
        const std::optional<FaceId> ground = lands(faces, default_surface);
        if (!ground || !std::ranges::binary_search(faces, *ground)) return std::nullopt;
        return Carrier{
            {{.faces = {*ground}, .face = *ground, .platform = impl.platform_of(*ground)}}, cause, *ground};
    };
    if (auto found = let_through(FallCause::not_solid, [](const SurfaceType& type) { return !type.solid; }))
        return found;
    if (auto found =
            let_through(FallCause::one_sided, [](const SurfaceType& type) { return type.one_sided; }))
        return found;

    impl.play(left, end + 1, {}, &impl.met);
    std::optional<FaceId> ground;
    const auto frees = [&](const std::vector<std::size_t>& set) {
        std::vector<FaceId> faces;
        for (const std::size_t i : set)
            faces.insert(faces.end(), impl.obstacles[i].faces.begin(), impl.obstacles[i].faces.end());
        const std::optional<FaceId> found = lands(faces, *impl.nothing);
        if (found) ground = found;
        return found.has_value();
    };
    // One at a time: what is met after that may be where it lands.
    const auto note_next = [&] {
        return std::ranges::any_of(impl.met.all, [&](const Meeting& one) { return impl.note({one}); });
    };
    for (int round = 0; round < max_rounds && note_next(); ++round) {
        if (frees(impl.all())) {
            Holding holding = impl.smallest(impl.all(), frees).front();
            // Who would have stayed on what it stood on was in no jump.
            const FaceId stood_on = impl.state_before(left).ground_face;
            const bool rides = stood_on < impl.mesh->face_count() && impl.platform_of(stood_on) != no_id &&
                               impl.mesh->face_group[stood_on] == impl.mesh->face_group[*ground];
            return Carrier{std::move(holding), rides ? FallCause::pushed : FallCause::cut_short, *ground};
        }
        impl.met.all.clear();
        impl.play(left, end + 1, impl.all(), &impl.met);
    }
    return impl.of_touch(left, end);
}

std::optional<WhatHolds::Extent> WhatHolds::extent(const Holding& holding, std::size_t tick) {
    Impl& impl = *impl_;
    if (!impl.build()) return std::nullopt;
    const PlayerState state = impl.state_before(tick);
    const MovementSettings settings = settings_of_body(impl.run.settings_at(tick), state);
    const Vec2 wish = impl.run.input_at(tick).wish;
    if (wish.isZero(0.0)) return std::nullopt;
    const Vec3 heading = Vec3(wish.x(), 0.0, wish.y()).normalized();
    const Vec3 aside(-heading.z(), 0.0, heading.x());
    const Vec3 centre = impl.scene->to_level(state);
    const double wide = std::max(settings.radii.x(), settings.radii.z()) + 2.0 * settings.skin;
    const double time = static_cast<double>(tick) * impl.run.dt();
    std::vector<std::vector<Vec3>> polygons;  // relative to the player's middle
    double nearest = std::numeric_limits<double>::infinity();
    const auto cut_out = [&](double half) {
        for (const Obstacle& obstacle : holding) {
            if (impl.mesh->face_group[obstacle.face] != impl.mesh->face_group[holding.front().face]) continue;
            const bool moves = obstacle.platform != no_id;
            const Pose pose = moves ? platform_pose(impl.level.platforms[obstacle.platform], time) : Pose{};
            for (const FaceId face : obstacle.faces) {
                const Mesh& mesh = *impl.mesh;
                for (std::uint32_t t = mesh.face_first_triangle[face]; t < mesh.face_first_triangle[face + 1];
                     ++t) {
                    std::vector<Vec3> polygon;
                    for (const std::uint32_t corner : mesh.triangles[t]) {
                        const Vec3 rest = mesh.corner_position(corner).cast<double>();
                        polygon.push_back((moves ? pose.apply(rest) : rest) - centre);
                    }
                    cut(polygon, [&](const Vec3& p) { return half - p.dot(aside); });
                    cut(polygon, [&](const Vec3& p) { return half + p.dot(aside); });
                    cut(polygon, [&](const Vec3& p) { return p.dot(heading) + half; });
                    for (const Vec3& p : polygon)
                        nearest = std::min(nearest, p.dot(heading));
                    if (!polygon.empty()) polygons.push_back(std::move(polygon));
                }
            }
        }
    };
    // A wall that the player's side touches is in its way only if nothing else is.
    cut_out(0.9 * wide);
    if (polygons.empty()) cut_out(wide);
    const double feet = impl.ground_ahead(tick, state, settings, nearest);
    std::optional<Extent> all;
    for (std::vector<Vec3>& polygon : polygons) {
        cut(polygon, [&](const Vec3& p) { return nearest + measured_m - p.dot(heading); });
        for (const Vec3& p : polygon) {
            const double height = p.y() + centre.y() - feet;
            if (!all) all = Extent{height, height, nearest, feet};
            all->lowest = std::min(all->lowest, height);
            all->highest = std::max(all->highest, height);
        }
    }
    return all;
}

}  // namespace slipface
