// What of a change broke a goal.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <set>

#include "slipface/reach/report.h"
#include "slipface/sim/story.h"

namespace slipface {
namespace {

constexpr int max_partings = 8;

class FacesTouched final : public TraceSink {
  public:
    void add(const TraceRecord& record) override {
        if (const auto* response = std::get_if<ResponseRecord>(&record)) faces.insert(response->face);
    }
    std::set<FaceId> faces;
};

// The faces touched in the first tick in which a run differs between two levels.
struct Parting {
    std::set<FaceId> before, now;
};

bool same_motion(const PlayerState& a, const PlayerState& b) {
    return a.position == b.position && a.sector == b.sector && a.velocity == b.velocity &&
           a.grounded == b.grounded && a.climbing == b.climbing && a.stuck == b.stuck &&
           a.hanging == b.hanging;
}

std::optional<Parting> parting_of(const Level& before, const Level& now, const Tape& tape) {
    MovementSettings settings;
    Result<LevelScene> scene_before = LevelScene::build(before), scene_now = LevelScene::build(now);
    if (!scene_before || !scene_now || !apply_tape_settings(settings, tape, "tape")) return std::nullopt;
    struct Side {
        explicit Side(LevelScene& scene, const Vec3& at)
            : ticks(scene), start(run_start(ticks, at)), state(start.player) {}
        TickScene ticks;
        RunStart start;
        PlayerState state;
        std::set<FaceId> touched;
        void tick(std::size_t number, const MovementSettings& settings, const PlayerInput& input, double dt) {
            FacesTouched sink;
            sink.faces = {state.ground_face};
            state = play_tick(ticks.at(number, dt), settings, state, input, dt, start, &sink).state;
            touched = std::move(sink.faces);
            touched.insert(state.ground_face);
            touched.erase(no_id);
        }
    };
    Side a(*scene_before, *tape.start), b(*scene_now, *tape.start);
    std::size_t number = 0;
    for (const TapeSegment& segment : tape.segments) {
        for (int i = 0; i < segment.ticks; ++i, ++number) {
            a.tick(number, settings, segment.input, tape.dt);
            b.tick(number, settings, segment.input, tape.dt);
            if (!same_motion(a.state, b.state)) return Parting{a.touched, b.touched};
        }
    }
    return std::nullopt;
}

// Faces of a mesh by their corners.
class FacesByKey {
  public:
    explicit FacesByKey(const Mesh& mesh) {
        for (FaceId face = 0; face < mesh.face_count(); ++face)
            faces_.emplace(face_key(mesh, face).loop_hash, face);
    }
    FaceId find(const Mesh& other, FaceId face) const {
        const auto found = faces_.find(face_key(other, face).loop_hash);
        return found == faces_.end() ? no_id : found->second;
    }

  private:
    std::map<std::uint64_t, FaceId> faces_;
};

// Where a way that was possible in one of the levels, by its tape, parts from itself in the other: at faces
// that are gone, new or of another type.
void add_changed_faces(const Level& before, Level now, const Tape& tape, std::vector<std::string>& causes) {
    const FacesByKey of_before(*before.mesh), of_now(*now.mesh);
    const ResolvedSurfaces types_before = resolve_surfaces(before);
    const auto place = [](const Level& level, FaceId face) {
        const Vec3 at = face_centroid(*level.mesh, face);
        return fmt::format("at ({:.2f}, {:.2f}, {:.2f}) m", at.x(), at.y(), at.z());
    };
    now.overrides.resize(now.mesh->face_count());
    for (int i = 0; i < max_partings; ++i) {
        const std::optional<Parting> parting = parting_of(before, now, tape);
        if (!parting) return;
        const ResolvedSurfaces types_now = resolve_surfaces(now);
        bool painted = false;
        for (const FaceId face : parting->before) {
            const FaceId same = of_now.find(*before.mesh, face);
            if (same == no_id) {
                causes.push_back(
                    fmt::format("{} of before, {}, is gone", thing_text(before, face), place(before, face)));
                continue;
            }
            const std::string& was = before.surfaces[types_before.surface[face]].name;
            const std::string& is = now.surfaces[types_now.surface[same]].name;
            if (was == is) continue;
            causes.push_back(
                fmt::format("{}, {}, is {} and was {}", thing_text(now, same), place(now, same), is, was));
            // With its type of before the way may go on and part again.
            const auto type = std::find_if(now.surfaces.begin(), now.surfaces.end(),
                                           [&](const SurfaceType& one) { return one.name == was; });
            if (type == now.surfaces.end()) continue;
            now.overrides[same] = static_cast<SurfaceId>(type - now.surfaces.begin());
            painted = true;
        }
        for (const FaceId face : parting->now)
            if (of_before.find(*now.mesh, face) == no_id)
                causes.push_back(fmt::format("{}, {}, is new", thing_text(now, face), place(now, face)));
        if (!painted) return;
    }
}

// Whether the goal holds in `level`, which has it or not; and what proves it.
std::optional<GoalAnswer> answer_in(Level level, const Level& goals_of, std::size_t goal, const Vec3& start,
                                    const ReachOptions& options, const ReachLimits& limits) {
    const std::string& from = goals_of.goals[goal].from;
    level.goals = {goals_of.goals[goal]};
    for (const Goal& named : goals_of.goals)
        if (named.name == from) level.goals.push_back(named);
    auto answers = check_goals(level, start, options, limits);
    if (!answers || answers->empty()) return std::nullopt;
    return std::move(answers->front());
}

}  // namespace

std::vector<std::string> causes_of(const GoalAnswer& broken, const Level& before, const Level& now,
                                   const Vec3& start, const ReachOptions& options,
                                   const ReachLimits& limits) {
    std::vector<std::string> causes;
    const auto holds = [&](const Level& level) {
        const auto answer = answer_in(level, now, broken.goal, start, options, limits);
        return answer && answer->holds;
    };
    const std::vector<std::string> changes = setting_changes(now.movement, before.movement);
    for (const std::string& change : changes) {
        Level other = now;
        if (set_setting(other.movement, change) && holds(other)) causes.push_back("holds with " + change);
    }
    for (SurfaceType type : before.surfaces) {
        Level other = now;
        const auto same = std::find_if(other.surfaces.begin(), other.surfaces.end(),
                                       [&](const SurfaceType& one) { return one.name == type.name; });
        if (same == other.surfaces.end() || *same == type) continue;
        *same = std::move(type);
        if (holds(other)) causes.push_back(fmt::format("holds with the type {} of before", same->name));
    }
    const auto named = [](std::vector<Platform>& platforms, const std::string& name) {
        return std::find_if(platforms.begin(), platforms.end(),
                            [&](const Platform& one) { return one.name == name; });
    };
    for (const Platform& platform : before.platforms) {
        Level other = now;
        const auto same = named(other.platforms, platform.name);
        if (same == other.platforms.end())
            other.platforms.push_back(platform);
        else if (*same == platform)
            continue;
        else
            *same = platform;
        if (holds(other))
            causes.push_back(fmt::format("holds with the platform {} of before", platform.name));
    }
    for (const Platform& platform : now.platforms) {
        Level old = before, other = now;
        if (named(old.platforms, platform.name) != old.platforms.end()) continue;
        other.platforms.erase(named(other.platforms, platform.name));
        if (holds(other)) causes.push_back(fmt::format("holds without the new platform {}", platform.name));
    }
    if (!causes.empty()) return causes;
    Level other = now;
    other.movement = before.movement;
    if (changes.size() > 1 && holds(other))
        return {fmt::format("holds with {} together", fmt::join(changes, " and "))};
    if (before.mesh == now.mesh && before.overrides == now.overrides) return causes;
    // The way that held, or the one that should not be: where does it part?
    const auto way = answer_in(before, now, broken.goal, start, options, limits);
    if (way && !way->holds) return {"did not hold before, either"};
    const bool never = now.goals[broken.goal].kind == GoalKind::never;
    const std::optional<Tape>& tape = never ? broken.tape : way ? way->tape : std::nullopt;
    if (tape) add_changed_faces(before, now, *tape, causes);
    return causes;
}

}  // namespace slipface
