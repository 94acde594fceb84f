#include "slipface/sim/stops.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <utility>

#include "fell_short.h"
#include "stop_parts.h"

namespace slipface {
namespace {

// Stops closer together than this are one: a player who trembles at a wall touches it every other tick.
constexpr double joined_within_s = 0.1;
// Of a long stop the first ticks say what stopped it; after them the player only leans on it.
constexpr std::size_t looked_at = 12;
// Of a stop whose cause no trace shows: shorter ones are turns and starts.
constexpr double reported_s = 0.25;
// How far a player comes in a tick if nothing is in the way: the speed along the stick goes on from tick to
// tick as its acceleration allows.
class FreeWalk {
  public:
    FreeWalk(const TapeRun& run, const StoryNames& names) : run_(run), names_(names) {}

    // Metres of tick `tick`, and 0 where nothing is asked. `goes_on`: from the free speed of the tick before,
    // not from the player's own.
    double metres(std::size_t tick, const MovementSettings& s, const PlayerInput& input, bool goes_on) {
        const double push = std::min(input.wish.norm(), 1.0);
        if (push == 0.0) {
            speed_ = 0.0;
            return 0.0;
        }
        const TickSample before = tick == 0 ? TickSample{} : run_.samples()[tick - 1];
        const TickSample& after = run_.samples()[tick];
        const double dt = run_.dt();
        if (before.climbing)
            return before.surface < names_.surfaces.size()
                       ? names_.surfaces[before.surface].climb_speed * push * dt
                       : 0.0;
        if (before.hanging || after.hanging) return speed_ = 0.0;  // nobody walks by the hands
        const Vec2 heading = input.wish.normalized();
        const double own = before.velocity.x() * heading.x() + before.velocity.z() * heading.y();
        const PlayerState body{.grounded = before.grounded, .crouched = after.crouched};
        const double requested = settings_of_body(s, body).walk_speed * push;
        const double from = goes_on ? std::max(std::min(speed_, requested), own) : own;
        const bool typed =
            before.surface < names_.surfaces.size() && before.ground_face != no_id && s.surface_types;
        const bool slippery = typed && names_.surfaces[before.surface].keeps_energy;
        const double friction = typed ? names_.surfaces[before.surface].friction : 1.0;
        const double acceleration = slippery          ? s.slippery_acceleration * friction
                                    : before.grounded ? s.ground_acceleration * friction
                                    : s.air_control   ? s.air_acceleration
                                                      : 0.0;
        const double to = from < requested ? std::min(requested, from + acceleration * dt) : from;
        speed_ = to;
        // A ramp is gone up by the cosine of its slope twice: along it, and as seen from above.
        const double up = after.grounded ? after.ground_normal.y() : 1.0;
        return std::max(0.0, 0.5 * (from + to) * dt * up * up);
    }

  private:
    const TapeRun& run_;
    const StoryNames& names_;
    double speed_ = 0.0;
};

double made_metres(const TapeRun& run, std::size_t tick, const PlayerInput& input) {
    const Vec3 from = tick == 0 ? run.start() : run.samples()[tick - 1].position;
    const Vec3 moved = run.samples()[tick].position - from;
    if (tick > 0 && run.samples()[tick - 1].climbing) return moved.norm();
    const Vec2 heading = input.wish.normalized();
    return moved.x() * heading.x() + moved.z() * heading.y();
}

// By the traces of the stop's first ticks; the face that took most comes first.
std::vector<Blame> blame_by_trace(const TickScene& scene, const TapeRun& run, const Stop& stop) {
    std::vector<Blame> blamed;
    for (const TickTrace& trace :
         run.traces(scene, stop.first, std::min(stop.last, stop.first + looked_at))) {
        const std::optional<Loss> loss = loss_of(trace);
        if (!loss) continue;
        auto blame = std::ranges::find(blamed, loss->face, &Blame::face);
        if (blame == blamed.end()) blame = blamed.insert(blamed.end(), {.face = loss->face});
        if (blame->lost_m == 0.0 || loss->lost_m > blame->loss.lost_m) {
            blame->worst = trace.tick;
            blame->loss = *loss;
        }
        // A cause that is no contact has no metres; it stands for its part of the stop.
        blame->lost_m += loss->lost_m > 0.0 ? loss->lost_m : stop.lost_m / static_cast<double>(looked_at);
    }
    std::ranges::stable_sort(blamed, std::greater(), &Blame::lost_m);
    return blamed;
}

bool is_of_geometry(StopCause cause) {
    switch (cause) {
        case StopCause::wall:
        case StopCause::back:
        case StopCause::step:
        case StopCause::slope:
        case StopCause::overhead:
        case StopCause::gap:
        case StopCause::corner:
        case StopCause::platform: return true;
        default: return false;
    }
}

// Where a fall began: the ground stood on before it, until the tick `left`.
Loss fall_after(const TapeRun& run, std::size_t tick, const Vec3& end, std::size_t& left) {
    Loss loss{.cause = StopCause::fall, .position = end};
    for (std::size_t i = tick; i-- > 0;) {
        const TickSample& sample = run.samples()[i];
        if (sample.respawned) break;
        if (!sample.grounded || sample.ground_face == no_id) continue;
        left = i + 1;
        loss.face = sample.ground_face;
        loss.surface = sample.surface;
        loss.normal = sample.ground_normal;
        loss.position = sample.position - Vec3(0.0, run.settings_at(i).radii.y(), 0.0);
        break;
    }
    return loss;
}

constexpr auto no_tick = std::numeric_limits<std::size_t>::max();

// Stretches in which less than half of the motion was made that the stick requested, the ways back, and the
// falls by more than the player's height.
struct Stretch {
    Stop stop;
    double early_m = 0.0;  // what was lost until WhatHolds::looked_at_s
};

std::vector<Stretch> find_stretches(const TapeRun& run, const StoryNames& names) {
    std::vector<Stretch> stretches;
    const auto samples = run.samples();
    const auto joined = static_cast<std::size_t>(joined_within_s / run.dt());
    const auto early = static_cast<std::size_t>(std::ceil(WhatHolds::looked_at_s / run.dt()));
    FreeWalk free(run, names);
    bool open = false;
    Stretch now;
    std::size_t stood = no_tick;  // the last tick on the ground; no_tick: held by something else since
    const auto close = [&] {
        if (open && now.stop.lost_s >= least_stop_s) stretches.push_back(now);
        open = false;
    };
    Vec2 heading = Vec2::Zero();
    for (std::size_t tick = 0; tick < samples.size(); ++tick) {
        const PlayerInput input = run.input_at(tick);
        const MovementSettings settings = run.settings_at(tick);
        if (samples[tick].respawned) {
            close();
            stretches.push_back(
                {Stop{.first = tick, .last = tick, .worst = tick, .left = tick, .lost_s = least_stop_s}});
            heading.setZero();
            stood = no_tick;
            continue;
        }
        if (samples[tick].grounded) {
            const double fell =
                stood == no_tick ? 0.0 : samples[stood].position.y() - samples[tick].position.y();
            if (tick - stood > 1 && fell > 2.0 * settings.radii.y()) {
                close();
                stretches.push_back({Stop{.first = tick,
                                          .last = tick,
                                          .worst = tick,
                                          .left = tick,
                                          .lost_s = least_stop_s,
                                          .fell_m = fell}});
            }
            stood = tick;
        } else if (samples[tick].climbing || samples[tick].hanging) {
            stood = no_tick;
        }
        if (open && tick > now.stop.last + joined) close();
        const Vec2 direction = input.wish.isZero(0.0) ? Vec2(Vec2::Zero()) : input.wish.normalized();
        const bool goes_on = direction.dot(heading) >= 0.7;
        if (!goes_on) close();  // another wish
        heading = direction;
        const double wished = free.metres(tick, settings, input, goes_on);
        if (!(wished > 0.0)) continue;
        const double lost = wished - made_metres(run, tick, input);
        if (lost <= 0.5 * wished) continue;
        if (!open) now = Stretch{Stop{.first = tick, .worst = tick, .left = tick}};
        open = true;
        now.stop.last = tick;
        now.stop.lost_m += lost;
        now.stop.wished_m += wished;
        if (tick < now.stop.first + early) now.early_m += lost;
        const double requested = settings.walk_speed * std::min(input.wish.norm(), 1.0);
        if (requested > 0.0) now.stop.lost_s += lost / requested;
    }
    close();
    return stretches;
}

// Whether the stick stays as it is for as long as it takes to see that one was sent back.
bool holds_on(const TapeRun& run, std::size_t tick) {
    constexpr double seen_s = 0.4;
    const Vec2 wish = run.input_at(tick).wish;
    const auto end = std::min(run.length(), tick + static_cast<std::size_t>(seen_s / run.dt()));
    for (std::size_t later = tick; later < end; ++later)
        if (run.input_at(later).wish != wish) return false;
    return !wish.isZero(0.0);
}

void explain_return(Stop& stop, const TickScene& scene, const TapeRun& run, WhatHolds* holds) {
    const TickTrace trace = run.trace(scene, stop.first);
    const std::optional<Loss> loss = loss_of(trace);
    const bool known = loss && (loss->cause == StopCause::hazard || loss->cause == StopCause::crushed);
    stop.loss = known ? *loss : fall_after(run, stop.first, trace.to, stop.left);
    if (trace.after.respawn == Respawn::hazard) stop.loss.cause = StopCause::hazard;
    if (trace.after.respawn == Respawn::crushed) stop.loss.cause = StopCause::crushed;
    if (holds == nullptr) return;
    constexpr double anywhere = -std::numeric_limits<double>::infinity();
    if (stop.loss.cause == StopCause::fall && !name_fall(stop, *holds, anywhere)) {
        if (const auto missed = fell_short(scene, run, stop.left, stop.first)) {
            stop.fall = FallCause::too_short;
            stop.loss.other = missed->face;
            stop.short_m = missed->short_m;
            stop.low_m = missed->low_m;
        }
    }
    if (stop.loss.cause == StopCause::crushed) name_press(stop, *holds);
}

// A player that fell deep did so by itself, unless something is found without which it would have stayed up.
bool explain_fall(Stop& stop, const TapeRun& run, WhatHolds& holds) {
    const Vec3 end = run.samples()[stop.first].position;
    stop.loss = fall_after(run, stop.first, end, stop.left);
    if (run.input_at(stop.left).buttons.has(Button::drop)) return false;
    const double lowest = end.y() + stop.fell_m - run.settings_at(stop.left).step_height;
    // A player that slid down a wall touched it, too: that cut no jump.
    return name_fall(stop, holds, lowest) && stop.fall != FallCause::cut_short;
}

// With `level`, by trying.
std::vector<Stop> explained(const TickScene& scene, const TapeRun& run, const StoryNames& names,
                            const Level* level, const std::function<bool()>& cancelled = {}) {
    std::vector<Stop> stops;
    std::optional<WhatHolds> holds;
    if (level != nullptr) holds.emplace(*level, run);
    for (Stretch& stretch : find_stretches(run, names)) {
        if (cancelled && cancelled()) break;
        Stop& stop = stretch.stop;
        const MovementSettings settings = settings_of_body(
            run.settings_at(stop.worst), PlayerState{.crouched = run.samples()[stop.worst].crouched});
        const bool back = run.samples()[stop.first].respawned;
        if (stop.fell_m > 0.0) {
            if (!holds || !explain_fall(stop, run, *holds)) continue;
        } else if (back) {
            explain_return(stop, scene, run, holds ? &*holds : nullptr);
        } else {
            const std::vector<Blame> by_trace = blame_by_trace(scene, run, stop);
            if (!by_trace.empty()) {
                stop.worst = by_trace.front().worst;
                stop.loss = by_trace.front().loss;
            }
            bool known = !by_trace.empty();
            const TickSample& before = run.samples()[stop.worst > 0 ? stop.worst - 1 : 0];
            stop.loss.in_air = !before.grounded && !before.climbing && !before.stuck && !before.hanging;
            if (holds && (!known || is_of_geometry(stop.loss.cause)) &&
                (known || stop.lost_s >= reported_s)) {
                const std::vector<Holding> found = holds->of_stop(stop.first, stretch.early_m);
                if (!found.empty()) name_cause(stop, *holds, found, by_trace, settings, *level->mesh);
                // What nothing freed the player from took little, or was not what held it.
                known = !found.empty() || (known && stop.lost_s >= reported_s);
            }
            // What nothing took was no stop: a turn in the air, a slide that goes on.
            if (!known) continue;
        }
        if (back) stop.blind_after = holds_on(run, stop.first);
        write_headline(stop, settings, names);
        stops.push_back(std::move(stop));
    }
    return stops;
}

}  // namespace

std::vector<Stop> find_stops(const TickScene& scene, const TapeRun& run, const Level& level,
                             const std::function<bool()>& cancelled) {
    return explained(scene, run, level, &level, cancelled);
}

std::vector<Stop> count_stops(const TickScene& scene, const TapeRun& run, const StoryNames& names) {
    return explained(scene, run, names, nullptr);
}

// The last one. A player who sees that it was sent back lets go of the stick; where it did not, what follows
// was meant for another place.
const Stop* headline_stop(std::span<const Stop> stops) {
    for (const Stop& stop : stops)
        if (stop.blind_after) return &stop;
    return stops.empty() ? nullptr : &stops.back();
}

std::string stops_text(std::span<const Stop> stops, double dt) {
    std::string text;
    for (const Stop& stop : stops) {
        text += fmt::format("at {:.2f} s (tick {}", static_cast<double>(stop.first) * dt, stop.worst);
        if (stop.loss.cause < StopCause::hazard) text += fmt::format(", {:.2f} s lost", stop.lost_s);
        text += "): " + stop.headline + "\n";
    }
    return text;
}

}  // namespace slipface
