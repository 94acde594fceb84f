#include "slipface/sim/stops.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "story_words.h"

namespace slipface {
namespace {

// Stops closer together than this are one: a player who trembles at a wall touches it every other tick.
constexpr double joined_within_s = 0.1;
// Of a long stop the first ticks say what stopped it; after them the player only leans on it.
constexpr std::size_t looked_at = 12;

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
        const Vec2 heading = input.wish.normalized();
        const double own = before.velocity.x() * heading.x() + before.velocity.z() * heading.y();
        const double from = goes_on ? std::max(speed_, own) : own;
        const bool typed =
            before.surface < names_.surfaces.size() && before.ground_face != no_id && s.surface_types;
        const bool slippery = typed && names_.surfaces[before.surface].keeps_energy;
        const double friction = typed ? names_.surfaces[before.surface].friction : 1.0;
        const double acceleration = slippery          ? s.slippery_acceleration * friction
                                    : before.grounded ? s.ground_acceleration * friction
                                    : s.air_control   ? s.air_acceleration
                                                      : 0.0;
        const double requested = s.walk_speed * push;
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

// Two upright faces that both took at least this fraction hold the player between them.
constexpr double gap_fraction = 0.2;

// What each face took in the first ticks of a stop, and the tick in which it took most.
struct Blame {
    FaceId face = no_id;
    double lost_m = 0.0;
    std::size_t worst = 0;
    Loss loss = {};
};

Blame& blame_of(std::vector<Blame>& all, FaceId face) {
    const auto known = std::find_if(all.begin(), all.end(), [&](const Blame& b) { return b.face == face; });
    if (known != all.end()) return *known;
    all.push_back({.face = face});
    return all.back();
}

// The loss that took most of the first ticks, all ticks of a face together.
void find_loss(const TickScene& scene, const TapeRun& run, Stop& stop) {
    std::vector<Blame> blamed;
    std::vector<Blame> seconds;  // as the second face of another's loss
    for (const TickTrace& trace :
         run.traces(scene, stop.first, std::min(stop.last, stop.first + looked_at))) {
        const std::size_t tick = trace.tick;
        const std::optional<Loss> loss = loss_of(trace);
        if (!loss) continue;
        // A cause that is no contact has no metres; it stands for its part of the stop.
        const double lost = loss->lost_m > 0.0 ? loss->lost_m : stop.lost_m / static_cast<double>(looked_at);
        Blame& blame = blame_of(blamed, loss->face);
        if (blame.lost_m == 0.0 || loss->lost_m > blame.loss.lost_m) {
            blame.worst = tick;
            blame.loss = *loss;
        }
        blame.lost_m += lost;
        if (loss->other != no_id) blame_of(seconds, loss->other).lost_m += loss->other_m;
    }
    const auto less = [](const Blame& a, const Blame& b) { return a.lost_m < b.lost_m; };
    const auto maximum = std::max_element(blamed.begin(), blamed.end(), less);
    if (maximum == blamed.end()) {
        stop.lost_m = 0.0;
        return;
    }
    stop.worst = maximum->worst;
    stop.loss = maximum->loss;
    const auto upright = [](const Loss& loss) {
        return loss.cause == StopCause::wall || loss.cause == StopCause::back;
    };
    if (!upright(stop.loss)) return;
    for (const Blame& blame : blamed)
        if (blame.face != maximum->face && upright(blame.loss))
            blame_of(seconds, blame.face).lost_m += blame.lost_m;
    std::erase_if(seconds, [&](const Blame& b) { return b.face == maximum->face; });
    const auto second = std::max_element(seconds.begin(), seconds.end(), less);
    stop.loss.other = no_id;
    if (second == seconds.end() || second->lost_m < gap_fraction * (maximum->lost_m + second->lost_m)) return;
    stop.loss.cause = StopCause::gap;
    stop.loss.other = second->face;
}

// Where a fall out of the level began: the ground stood on before it.
Loss fall_after(const TapeRun& run, std::size_t tick, const Vec3& end) {
    Loss loss{.cause = StopCause::fall, .position = end};
    for (std::size_t i = tick; i-- > 0;) {
        const TickSample& sample = run.samples()[i];
        if (sample.respawned) break;
        if (!sample.grounded || sample.ground_face == no_id) continue;
        loss.face = sample.ground_face;
        loss.surface = sample.surface;
        loss.normal = sample.ground_normal;
        loss.position = sample.position - Vec3(0.0, run.settings_at(i).radii.y(), 0.0);
        break;
    }
    return loss;
}

void write_headline(Stop& stop, const MovementSettings& settings, const StoryNames& names) {
    const Loss& loss = stop.loss;
    Words words(stop.headline, stop.numbers);
    const std::string what = thing_text(names, loss.face);
    // The feet stand a skin above the floor.
    const double height = loss.in_air ? loss.height_m : loss.height_m + settings.skin;
    const auto because = [&] {
        if (!loss.because) return;
        words.say(". ").decision(*loss.because);
    };
    switch (loss.cause) {
        case StopCause::wall: words.say("A wall of ").say(what).say(" stopped you"); break;
        case StopCause::back:
            words.say("The back of ").say(what).say(" stopped you: it collides from both sides");
            break;
        case StopCause::step:
            if (loss.in_air) {
                words.say("The edge of ").say(what).say(" stopped you in the air, ");
                words.size(height).say(" above your feet");
                break;
            }
            words.say("The ").size(height).say(" edge of ").say(what).say(" stopped you");
            if (!settings.step_up) {
                words.say(": Step up is off");
            } else if (height > settings.step_height) {
                words.say(": higher than Step height, ").size(settings.step_height);
            } else {
                because();
            }
            break;
        case StopCause::slope:
            words.say("The slope of ").say(what).say(" stopped you");
            because();
            break;
        case StopCause::overhead:
            words.say(what).say(" is too low: you touched it ").size(height);
            words.say(" above your feet, and you are ").size(2.0 * settings.radii.y()).say(" tall");
            break;
        case StopCause::gap:
            words.say("You are held between ").say(what).say(" and ").say(thing_text(names, loss.other));
            words.say(": you are ").size(2.0 * std::max(settings.radii.x(), settings.radii.z())).say(" wide");
            break;
        case StopCause::sticky: words.say("The sticky ").say(what).say(" holds you until you jump"); break;
        case StopCause::carried:
            words.say("The moving surface of ").say(what).say(" carried you against the stick");
            break;
        case StopCause::slippery:
            words.say("The slope of ").say(what).say(" is too slippery to walk up");
            if (loss.surface < names.surfaces.size())
                words.say(": friction ").ratio(names.surfaces[loss.surface].friction);
            break;
        case StopCause::platform: words.say("The moving platform ").say(what).say(" stopped you"); break;
        case StopCause::ladder_end:
            words.say("The ladder ends: the wall above it, ").say(what).say(", cannot be climbed");
            break;
        case StopCause::inside:
            if (loss.because) {
                words.decision(*loss.because);
            } else {
                words.say("You are inside geometry");
            }
            break;
        case StopCause::terrain:
            words.say("The terrain stopped you");
            because();
            break;
        case StopCause::hazard: words.say("The hazard ").say(what).say(" sent you back to the start"); break;
        case StopCause::crushed:
            words.say("Crushed between ").say(what).say(" and ").say(thing_text(names, loss.other));
            words.say(", back to the start");
            break;
        case StopCause::fall:
            words.say("You fell out of the level");
            if (loss.face != no_id) words.say(", last from ").say(what);
            words.say(", back to the start");
            break;
    }
}

}  // namespace

const char* stop_cause_name(StopCause cause) {
    static constexpr std::array<const char*, 16> names{
        "wall",     "back",     "step",       "slope",  "overhead", "gap",    "sticky",  "carried",
        "slippery", "platform", "ladder end", "inside", "terrain",  "hazard", "crushed", "fall"};
    return names[static_cast<std::size_t>(cause)];
}

std::vector<Stop> find_stops(const TickScene& scene, const TapeRun& run, const StoryNames& names) {
    std::vector<Stop> stops;
    const auto samples = run.samples();
    const auto joined = static_cast<std::size_t>(joined_within_s / run.dt());
    FreeWalk free(run, names);
    bool open = false;
    Stop now;
    const auto close = [&] {
        if (open) stops.push_back(now);
        open = false;
    };
    Vec2 heading = Vec2::Zero();
    for (std::size_t tick = 0; tick < samples.size(); ++tick) {
        const PlayerInput input = run.input_at(tick);
        const MovementSettings settings = run.settings_at(tick);
        if (samples[tick].respawned) {
            close();
            stops.push_back({.first = tick, .last = tick, .worst = tick, .lost_s = least_stop_s});
            continue;
        }
        if (open && tick > now.last + joined) close();
        const Vec2 direction = input.wish.isZero(0.0) ? Vec2(Vec2::Zero()) : input.wish.normalized();
        if (direction.dot(heading) < 0.7) close();  // another wish
        heading = direction;
        const double wished = free.metres(tick, settings, input, open);
        if (!(wished > 0.0)) continue;
        const double lost = wished - made_metres(run, tick, input);
        if (lost <= 0.5 * wished) continue;
        if (!open) now = Stop{.first = tick};
        open = true;
        now.last = tick;
        now.lost_m += lost;
        const double requested = settings.walk_speed * std::min(input.wish.norm(), 1.0);
        if (requested > 0.0) now.lost_s += lost / requested;
    }
    close();
    std::erase_if(stops, [](const Stop& stop) { return stop.lost_s < least_stop_s; });
    for (Stop& stop : stops) {
        const bool back = samples[stop.first].respawned;
        if (!back) {
            find_loss(scene, run, stop);
            if (stop.lost_m > 0.0) write_headline(stop, run.settings_at(stop.worst), names);
            continue;
        }
        const TickTrace trace = run.trace(scene, stop.first);
        const std::optional<Loss> loss = loss_of(trace);
        const bool known = loss && (loss->cause == StopCause::hazard || loss->cause == StopCause::crushed);
        stop.loss = known ? *loss : fall_after(run, stop.first, trace.to);
        if (trace.after.respawn == Respawn::hazard) stop.loss.cause = StopCause::hazard;
        if (trace.after.respawn == Respawn::crushed) stop.loss.cause = StopCause::crushed;
        write_headline(stop, trace.settings, names);
    }
    // What nothing took was no stop: a turn in the air, a slide that goes on.
    std::erase_if(stops, [](const Stop& stop) { return stop.headline.empty(); });
    return stops;
}

const Stop* headline_stop(std::span<const Stop> stops) {
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
