#include "slipface/sim/simulate.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "slipface/base/hash.h"

namespace slipface {
namespace {

constexpr double farthest_fall_m = 60.0;  // below the level and the start

// Whole seconds in `ticks` steps of `dt`; the fraction of a tick added keeps 60 steps of 1/60 one second.
std::size_t whole_seconds(std::size_t ticks, double dt) {
    return static_cast<std::size_t>((static_cast<double>(ticks) + 1e-6) * dt);
}

}  // namespace

RunStart run_start(const TickScene& scene, const Vec3& start) {
    RunStart begin{.player = scene.player_at(start)};
    const double height = start.y() + scene.offset().y();
    const Aabb bounds = scene.bounds();
    begin.lowest = bounds.empty() ? -std::numeric_limits<double>::infinity()
                                  : std::min(bounds.min.y(), height) - farthest_fall_m;
    if (scene.fall_limit() && *scene.fall_limit() < height) begin.lowest = *scene.fall_limit();
    return begin;
}

TickResult play_tick(const MovementScene& scene, const MovementSettings& settings, const PlayerState& before,
                     const PlayerInput& input, double dt, const RunStart& start, TraceSink* trace,
                     StepFunction mover) {
    const StepResult step_result = mover(scene, settings, before, input, dt, trace, nullptr);
    TickResult result{.state = step_result.state,
                      .stepped = step_result.state,
                      .respawn = Respawn::none,
                      .contacts = step_result.contacts,
                      .end_is_free = step_result.end_is_free,
                      .crowded = step_result.crowded};
    if (result.state.hazard) {
        result.respawn = Respawn::hazard;
    } else if (result.state.crushed) {
        result.respawn = Respawn::crushed;
    } else if (position_in_scene(scene, result.state).y() < start.lowest) {
        result.respawn = Respawn::fall;
    }
    if (result.respawn != Respawn::none) {
        result.state = start.player;
        result.state.jump_held = input.buttons.has(Button::jump);
    }
    return result;
}

void EventLog::add(std::size_t tick, const PlayerState& before, const PlayerInput& input,
                   const TickResult& result) {
    const PlayerState& after = result.stepped;
    if (after.hazard) log(tick, "hazard", after);
    if (after.crushed) log(tick, "crushed", after);
    const bool jumped_in_air = after.air_jumps > before.air_jumps || after.wall_lock_s > before.wall_lock_s;
    if (jumped_in_air) {
        log(tick, "jump", before);
    } else if (is_held(before) && !is_held(after) && input.buttons.has(Button::jump) && !before.jump_held) {
        log(tick, "jump", before);
    } else if (before.grounded && !after.grounded) {
        log(tick, "leave ground", before);
    }
    if (after.grounded && !before.grounded) log(tick, "land", after);
    if (after.climbing && !before.climbing) log(tick, "climb", after);
    if (after.stuck && !before.stuck) log(tick, "stick", after);
    if (after.hanging && !before.hanging) log(tick, "grab", after);
    if (after.move_s > before.move_s && !after.hanging) log(tick, "dash", before);
    if (after.crouched != before.crouched) log(tick, after.crouched ? "crouch" : "stand up", after);
    if (is_held(after) && after.ground_surface != surface_) {
        surface_ = after.ground_surface;
        log(tick, "surface", after);
    }
    if (result.respawn == Respawn::fall) events_.push_back({tick, "fall", ""});
}

void EventLog::log(std::size_t tick, const char* kind, const PlayerState& state) {
    const bool known = state.ground_surface < surfaces_.size();
    events_.push_back({tick, kind, known ? surfaces_[state.ground_surface].name : std::string()});
}

std::uint64_t state_hash(const PlayerState& state, std::uint64_t previous) {
    Hasher hasher;
    hasher.u64(previous);
    // What a hack adds to the state counts only while it is set, so that tapes that end without it keep the
    // hash of their end.
    constexpr std::size_t first_vectors = 3, first_flags = 7, first_numbers = 3;
    for (std::size_t i = 0; i < PlayerState::vectors.size(); ++i) {
        const Vec3& vector = state.*PlayerState::vectors[i];
        if (i >= first_vectors && vector.isZero(0.0)) continue;
        if (i >= first_vectors) hasher.u64(i);
        for (int axis = 0; axis < 3; ++axis)
            hasher.f64(vector[axis]);
    }
    std::uint64_t flags = 0;
    for (std::size_t i = 0; i < PlayerState::flags.size(); ++i) {
        const bool flag = state.*PlayerState::flags[i];
        flags |= std::uint64_t{flag} << (i < first_flags ? first_flags - 1 - i : i);
    }
    hasher.u64(flags);
    for (const std::int32_t number : state.sector)
        hasher.u64(static_cast<std::uint32_t>(number));
    hasher.u64(state.ground_face);
    hasher.u64(state.ground_surface);
    hasher.u64(state.ground_platform);
    for (std::size_t i = 0; i < PlayerState::numbers.size(); ++i) {
        const double number = state.*PlayerState::numbers[i];
        if (i >= first_numbers && number == 0.0) continue;
        if (i >= first_numbers) hasher.u64(i);
        hasher.f64(number);
    }
    for (std::size_t i = 0; i < PlayerState::counts.size(); ++i) {
        const std::uint8_t count = state.*PlayerState::counts[i];
        if (count > 0) hasher.u64((i + 1) * 256 + count);
    }
    if (state.carrier > Carrier::level) hasher.u64(static_cast<std::uint64_t>(state.carrier));
    return hasher.value();
}

Status apply_tape_settings(MovementSettings& settings, const Tape& tape, const std::string& location) {
    MovementSettings changed = tape.from_basic ? basic_settings() : settings;
    for (const std::string& assignment : tape.settings) {
        const Status status = set_setting(changed, assignment);
        if (!status.ok()) return Error{location, "set " + assignment + ": " + status.error().text()};
    }
    settings = changed;
    return {};
}

SimulationReport simulate(const TickScene& scene, const MovementSettings& settings, const Vec3& start,
                          const Tape& tape, const SimulationOptions& options) {
    SimulationReport report;
    EventLog log(scene.surfaces(), report.events);
    MovementSettings now = settings;
    auto change = tape.changes.begin();
    const RunStart begin = run_start(scene, start);
    PlayerState state = begin.player;
    std::uint64_t hash = 0;
    for (const TapeSegment& segment : tape.segments) {
        for (int i = 0; i < segment.ticks; ++i) {
            for (; change != tape.changes.end() && change->tick <= report.ticks; ++change)
                (void)set_setting(now, change->setting);
            const PlayerState before = state;
            const TickResult result = play_tick(scene.at(report.ticks, tape.dt), now, before, segment.input,
                                                tape.dt, begin, options.trace, step_of(tape));
            state = result.state;
            if (result.respawn == Respawn::fall) ++report.falls;
            if (result.respawn == Respawn::hazard) ++report.hazards;
            if (result.respawn == Respawn::crushed) ++report.crushed;
            report.distance += (scene.to_level(result.stepped) - scene.to_level(before)).norm();
            log.add(report.ticks, before, segment.input, result);
            hash = state_hash(state, hash);
            ++report.ticks;
            if (options.keep_states) report.states.push_back(state);
            if (whole_seconds(report.ticks, tape.dt) > whole_seconds(report.ticks - 1, tape.dt)) {
                report.second_hashes.push_back(hash);
            }
        }
    }
    const bool hashed = whole_seconds(report.ticks, tape.dt) >
                        whole_seconds(std::max<std::size_t>(report.ticks, 1) - 1, tape.dt);
    if (report.ticks > 0 && !hashed) report.second_hashes.push_back(hash);
    report.final_state = state;
    report.end_hash = hash;
    return report;
}

std::uint64_t scene_fingerprint(const MovementScene& scene) {
    Hasher hasher;
    // A parameter that is added later counts only where it is set, so that tapes keep their fingerprints.
    constexpr std::size_t first_fields = 13;
    const SurfaceType plain;
    for (const SurfaceType& surface : scene.surfaces) {
        for (const SurfaceField& field : surface_fields()) {
            const auto number = static_cast<std::size_t>(&field - surface_fields().data());
            const auto as_plain = [&](auto member) { return surface.*member == plain.*member; };
            if (number >= first_fields && std::visit(as_plain, field.member)) continue;
            if (number >= first_fields) hasher.u64(number);
            std::visit(
                [&](auto member) {
                    const auto& value = surface.*member;
                    using Value = std::decay_t<decltype(value)>;
                    if constexpr (std::is_same_v<Value, Vec3>) {
                        for (int axis = 0; axis < 3; ++axis)
                            hasher.f64(value[axis]);
                    } else if constexpr (std::is_same_v<Value, std::optional<double>>) {
                        hasher.f64(value.value_or(-1.0));
                    } else {
                        hasher.f64(static_cast<double>(value));
                    }
                },
                field.member);
        }
    }
    FaceId last = no_id;
    for (std::size_t i = 0; i < scene.collision.triangle_count(); ++i) {
        const FaceId face = scene.collision.triangle_face(static_cast<TriangleId>(i));
        if (face != last) hasher.u64(scene.collision.face_surface(face));
        last = face;
    }
    for (const MovingPart& part : scene.platforms) {
        const Pose& pose = part.end;
        hasher.u64(part.triangles.size());
        for (int axis = 0; axis < 3; ++axis) {
            hasher.f64(pose.apply(Vec3::Zero())[axis]);
            hasher.f64(part.velocity[axis]);
            hasher.f64(part.angular_velocity[axis]);
        }
    }
    return hasher.value();
}

}  // namespace slipface
