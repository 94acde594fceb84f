#include "slipface/sim/run_events.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "fell_short.h"
#include "story_words.h"

namespace slipface {
namespace {

// Decisions that are an event as they are; the sentence is the decision's own.
struct Reported {
    Decision kind;
    const char* word;
    bool idle_only = false;  // only while the stick is at rest
    bool sums = false;       // the values of joined ones add up
};
constexpr auto reported =
    std::to_array<Reported>({{Decision::bounced, "bounced"},
                             {Decision::bounce_off, "no bounce"},
                             {Decision::bounce_too_slow, "no bounce"},
                             {Decision::stuck, "stuck"},
                             {Decision::hazard_touched, "hazard"},
                             {Decision::ladder_grabbed, "climbed"},
                             {Decision::ladder_passed, "not climbed"},
                             {Decision::ladder_overhead, "not climbed"},
                             {Decision::ladder_ended, "left the ladder"},
                             {Decision::ladder_top, "left the ladder"},
                             {Decision::ladder_beside, "left the ladder"},
                             {Decision::ladder_ground, "left the ladder"},
                             {Decision::ladder_wall_above, "left the ladder"},
                             {Decision::platform_pushed, "pushed", false, true},
                             {Decision::platform_crushed, "crushed"},
                             {Decision::platform_off, "left behind"},
                             {Decision::ground_velocity_lost, "left behind"},
                             {Decision::ground_velocity_kept, "kept the ground's velocity"},
                             {Decision::platform_carried, "carried", true},
                             {Decision::surface_carried, "carried", true},
                             {Decision::too_steep_to_stand, "slid off"},
                             {Decision::terrain_slid, "slid off"},
                             {Decision::nudge_failed, "inside"},
                             {Decision::never_inside, "moved back"},
                             {Decision::push_out_off, "inside"},
                             {Decision::speed_braked, "slowed"},
                             {Decision::fell_at_terminal_speed, "slowed"},
                             {Decision::energy_capped, "slowed"},
                             {Decision::air_control_off, "not steered"},
                             {Decision::stepped_up, "stepped up", false, true},
                             {Decision::wall_slid, "slid down a wall"},
                             {Decision::wall_slide_not_pushed, "fell along a wall"},
                             {Decision::dashed, "dashed"},
                             {Decision::dash_blocked, "dash stopped"},
                             {Decision::dashes_used, "no dash"},
                             {Decision::dash_no_way, "no dash"},
                             {Decision::dash_held_back, "no dash"},
                             {Decision::dash_off, "no dash"},
                             {Decision::crouched, "crouched"},
                             {Decision::stood_up, "stood up"},
                             {Decision::crouch_no_room, "wants to stand"},
                             {Decision::crouch_off, "no crouch"},
                             {Decision::ledge_grabbed, "grabbed a ledge"},
                             {Decision::ledge_climbed, "climbed a ledge"},
                             {Decision::ledge_let_go, "left a ledge"},
                             {Decision::ledge_lost, "left a ledge"},
                             {Decision::ledge_no_room, "not climbed"},
                             {Decision::ledge_forbidden, "no ledge"},
                             {Decision::ledge_not_steep, "no ledge"},
                             {Decision::dropped_through, "dropped through"},
                             {Decision::drop_through_off, "not dropped through"},
                             {Decision::glided, "glided"}});
// What a jump starts with.
constexpr std::initializer_list<Decision> jump_starts{Decision::jumped, Decision::jumped_off,
                                                      Decision::air_jumped, Decision::wall_jumped};

// Events of one word and face that are this close are one.
constexpr double joined_s = 0.15;
// Falls and flights below this are steps down.
constexpr double least_flight_s = 0.15, least_fall_m = 0.3;
// A jump that comes less high than this part of what it could was cut short.
constexpr double full_height = 0.95;
constexpr double least_turn = 0.98;  // cosine: less is no turn
constexpr double least_speed = 0.9;  // of the speed that the stick requests
constexpr double slower_for_s = 0.25;
constexpr double least_push_m = 1e-3, least_slide_m = 2e-4;

class EventReader {
  public:
    EventReader(const TickScene& scene, const TapeRun& run, const StoryNames& names)
        : scene_(scene), run_(run), names_(names) {}

    void read(const TickTrace& trace) {
        for (const TraceRecord& record : trace.records) {
            if (const auto* decision = std::get_if<DecisionRecord>(&record)) tell(trace, *decision);
            if (const auto* push = std::get_if<PushOutRecord>(&record)) tell(trace, *push);
        }
        read_jump(trace);
        read_ground(trace);
        read_way(trace);
    }

    std::vector<RunEvent> finish() {
        std::ranges::stable_sort(events_, {}, &RunEvent::first);
        return std::move(events_);
    }

  private:
    // The event that goes on in this tick.
    RunEvent* open_event(const TickTrace& trace, const char* word, FaceId face) {
        const auto joined = static_cast<std::size_t>(joined_s / run_.dt()) + 1;
        for (std::size_t i = events_.size(); i-- > 0;)
            if (events_[i].word == word && events_[i].face == face)
                return trace.tick > events_[i].last + joined ? nullptr : &events_[i];
        return nullptr;
    }

    // Of joined events the one with the largest `weight` is reported.
    template <class Write>
    void add(const TickTrace& trace, const char* word, FaceId face, Write write, double weight = 0.0) {
        RunEvent* open = open_event(trace, word, face);
        std::size_t i = open == nullptr ? 0 : static_cast<std::size_t>(open - events_.data()) + 1;
        if (open == nullptr) {
            RunEvent& event = events_.emplace_back();
            event.word = word;
            event.first = trace.tick;
            event.face = face;
            event.position = trace.to;
            weights_.push_back(-1.0);
            i = events_.size();
        }
        RunEvent& event = events_[i - 1];
        event.last = trace.tick;
        if (weight <= weights_[i - 1]) return;
        weights_[i - 1] = weight;
        event.text.clear();
        event.numbers.clear();
        write(Words(event.text, event.numbers));
    }

    std::string ground_text(FaceId face) const {
        return face == no_id ? "the terrain" : thing_text(names_, face);
    }

    const DecisionRecord* decided(const TickTrace& trace, std::initializer_list<Decision> kinds) const {
        for (const TraceRecord& record : trace.records)
            if (const auto* decision = std::get_if<DecisionRecord>(&record))
                if (std::ranges::find(kinds, decision->kind) != kinds.end()) return decision;
        return nullptr;
    }

    void tell(const TickTrace& trace, const DecisionRecord& decision) {
        const auto row = std::ranges::find(reported, decision.kind, &Reported::kind);
        if (row == reported.end()) return;
        if (row->idle_only) {
            const Vec3 moved = trace.to - trace.from;
            if (!trace.input.wish.isZero(0.0) || std::hypot(moved.x(), moved.z()) < least_slide_m) return;
        }
        // A ceiling slides nobody off.
        if (decision.kind == Decision::too_steep_to_stand && !(decision.value > 0.0)) return;
        const FaceId face = decision.face;
        // A step or a push that takes several ticks is reported as a whole.
        DecisionRecord all = decision;
        const RunEvent* before = row->sums ? open_event(trace, row->word, face) : nullptr;
        if (before != nullptr) all.value += weights_[static_cast<std::size_t>(before - events_.data())];
        const double weight = row->sums ? all.value : 0.0;
        add(
            trace, row->word, face,
            [&](Words words) {
                words.decision(all);
                if (face != no_id) words.say(": ").say(thing_text(names_, face));
            },
            weight);
    }

    void tell(const TickTrace& trace, const PushOutRecord& push) {
        const double moved = (push.to - push.from).norm();
        if (moved < least_push_m) return;
        add(trace, "pushed out", no_id, [&](Words words) {
            words.say("Moved ").length(moved).say(" out of what the player was inside of");
            if (!push.free) words.say(", and is still inside");
        });
    }

    // Presses of the button, and what became of each jump.
    void read_jump(const TickTrace& trace) {
        const PlayerState& after = trace.after.stepped;
        const bool pressed = trace.input.buttons.has(Button::jump) && !trace.before.jump_held;
        const auto* jumped = decided(trace, jump_starts);
        if (jumped != nullptr) {
            rising_ = Rising{.from = trace.from.y(), .speed = jumped->value, .tick = trace.tick};
            add(trace, "jumped", jumped->face, [&](Words words) {
                words.decision(*jumped);
                if (const auto* how = decided(trace, {Decision::coyote_jump, Decision::jump_buffered}))
                    words.say(". ").decision(*how);
            });
        } else if (pressed) {
            const auto* why = decided(trace, {Decision::coyote_over, Decision::coyote_off});
            const auto* in_air = decided(
                trace, {Decision::air_jumps_used, Decision::wall_jump_same, Decision::wall_jump_no_wall});
            const auto* buffer = decided(trace, {Decision::jump_remembered, Decision::jump_buffer_off});
            const auto* steep = decided(trace, {Decision::too_steep_to_stand, Decision::wall});
            add(trace, "no jump", no_id, [&](Words words) {
                if (steep != nullptr)
                    words.say("Did not jump: ").decision(*steep);
                else if (why != nullptr)
                    words.decision(*why);
                else
                    words.say("Did not jump");
                if (left_ground_ && steep == nullptr) {
                    words.say(". The ground was left ")
                        .count(static_cast<double>(trace.tick - *left_ground_));
                    words.say(" ticks before");
                }
                if (in_air != nullptr) words.say(". ").decision(*in_air);
                if (buffer != nullptr) words.say(". ").decision(*buffer);
            });
        } else if (trace.input.buttons.has(Button::jump) && after.grounded && !trace.before.grounded) {
            add(trace, "no jump", no_id, [&](Words words) {
                words.say(
                    "Did not jump on landing: the button was held, and a jump starts when it is pressed");
            });
        }
        if (!rising_) return;
        if (decided(trace, {Decision::jump_cut}) != nullptr) rising_->cut = trace.tick;
        for (const TraceRecord& record : trace.records) {
            const auto* response = std::get_if<ResponseRecord>(&record);
            if (response == nullptr || response->normal.y() > -0.1) continue;
            rising_->under = response->face;
        }
        rising_->highest = std::max(rising_->highest, trace.to.y() - rising_->from);
        if (after.velocity.y() > 0.0 && !after.grounded && trace.after.respawn == Respawn::none) return;
        const Rising jump = *rising_;
        rising_.reset();
        const double gravity = trace.settings.gravity;
        const double could = gravity > 0.0 ? jump.speed * jump.speed / (2.0 * gravity) : 0.0;
        if (jump.highest >= full_height * could - jump.speed * run_.dt()) return;
        add(trace, "jumped lower", jump.under, [&](Words words) {
            words.say("Jumped ").size(jump.highest).say(" high instead of ").size(could).say(": ");
            if (jump.under != no_id)
                words.say(thing_text(names_, jump.under)).say(" was above");
            else if (jump.cut)
                words.say("the button was released after ")
                    .count(static_cast<double>(*jump.cut - jump.tick))
                    .say(" ticks");
            else
                words.say("it ended early");
        });
    }

    // Landing, and leaving the ground without a jump.
    void read_ground(const TickTrace& trace) {
        const PlayerState& before = trace.before;
        const PlayerState& after = trace.after.stepped;
        if (!is_held(before) && !left_ground_) {  // at the start
            left_ground_ = trace.tick;
            highest_ = trace.from.y();
        }
        if (is_held(before) && !is_held(after)) {
            left_ground_ = trace.tick;
            highest_ = trace.to.y();
            if (decided(trace, {Decision::jumped, Decision::jumped_off}) == nullptr && before.grounded) {
                add(trace, "walked off", before.ground_face, [&](Words words) {
                    words.say("Left ").say(ground_text(before.ground_face)).say(" without a jump");
                    const auto* why =
                        decided(trace, {Decision::snap_off, Decision::snap_no_floor, Decision::snap_too_deep,
                                        Decision::snap_own_response, Decision::snap_too_steep});
                    if (why != nullptr) words.say(". ").decision(*why);
                });
            }
        }
        if (!is_held(after)) highest_ = std::max(highest_, trace.to.y());
        if (trace.after.respawn != Respawn::none) left_ground_.reset();
        if (!left_ground_ || !is_held(after)) return;
        const double flew = static_cast<double>(trace.tick - *left_ground_) * run_.dt();
        const double fell = highest_ - trace.to.y();
        const double speed = -before.velocity.y();
        const std::size_t left = *left_ground_;
        left_ground_.reset();
        if (!after.grounded || flew < least_flight_s || fell < least_fall_m) return;
        add(trace, "landed", after.ground_face, [&](Words words) {
            words.say("Landed on ").say(ground_text(after.ground_face)).say(" after a fall of ");
            words.size(fell).say(" at ").speed(speed).say(", ").seconds(flew).say(" in the air");
        });
        const auto missed = fell_short(scene_, run_, left, trace.tick);
        if (!missed) return;
        add(trace, "fell short", missed->face, [&](Words words) {
            if (missed->low_m > 0.0)
                words.say("The jump was ").size(missed->low_m).say(" too low for ");
            else
                words.say("The jump fell ").size(missed->short_m).say(" short of ");
            words.say(ground_text(missed->face));
        });
    }

    // Turned aside by a wall, or slower than the stick asks.
    void read_way(const TickTrace& trace) {
        const PlayerState& after = trace.after.stepped;
        const double push = std::min(trace.input.wish.norm(), 1.0);
        const Vec3 moved = (trace.to - trace.from) / run_.dt();
        const Vec2 way(moved.x(), moved.z());
        const ResponseRecord* aside = nullptr;
        for (const TraceRecord& record : trace.records) {
            const auto* response = std::get_if<ResponseRecord>(&record);
            if (response != nullptr && std::abs(response->normal.y()) < 0.5) aside = response;
        }
        read_rest(trace, push == 0.0 && after.grounded && trace.after.respawn == Respawn::none, way.norm());
        if (push == 0.0 || trace.after.respawn != Respawn::none || !after.grounded) {
            slow_ticks_ = 0;
            return;
        }
        const double speed = way.norm(), asked = trace.settings.walk_speed * push;
        const Vec2 wish = trace.input.wish.normalized();
        if (aside != nullptr && speed > 0.05 * asked && way.dot(wish) < least_turn * speed) {
            add(
                trace, "turned aside", aside->face,
                [&](Words words) {
                    words.say(thing_text(names_, aside->face)).say(" turned you aside by ");
                    words.degrees(std::acos(std::clamp(way.dot(wish) / speed, -1.0, 1.0)) *
                                  57.29577951308232);
                    words.say(": ").speed(speed).say(" of ").speed(asked);
                },
                speed > 0.0 ? 1.0 - way.dot(wish) / speed : 0.0);
        }
        const bool slow = aside == nullptr && speed < least_speed * asked && speed <= last_speed_ + 1e-3;
        last_speed_ = speed;
        slow_ticks_ = slow ? slow_ticks_ + 1 : 0;
        if (static_cast<double>(slow_ticks_) * run_.dt() < slower_for_s) return;
        add(trace, "slower", after.ground_face, [&](Words words) {
            words.say("Slower than asked on ").say(ground_text(after.ground_face)).say(": ");
            words.speed(speed).say(" of ").speed(asked);
            const auto* why = decided(
                trace, {Decision::slope_speed_off, Decision::surface_carried, Decision::platform_carried,
                        Decision::friction_slid, Decision::coasted, Decision::stepped_up});
            if (why != nullptr) words.say(". ").decision(*why);
            if (after.ground_surface < names_.surfaces.size() &&
                names_.surfaces[after.ground_surface].friction < 1.0)
                words.say(". Friction ").ratio(names_.surfaces[after.ground_surface].friction);
        });
    }

    // Moving on although the stick is at rest, for longer than braking takes.
    void read_rest(const TickTrace& trace, bool idle, double speed) {
        const bool carried = decided(trace, {Decision::surface_carried, Decision::platform_carried,
                                             Decision::platform_pushed}) != nullptr;
        idle_ticks_ = idle && !carried && speed * run_.dt() > least_slide_m ? idle_ticks_ + 1 : 0;
        if (static_cast<double>(idle_ticks_) * run_.dt() < slower_for_s) return;
        const PlayerState& after = trace.after.stepped;
        add(trace, "slid", after.ground_face, [&](Words words) {
            words.say("Slid without the stick on ").say(ground_text(after.ground_face)).say(" at ");
            words.speed(speed);
            const auto* why = decided(trace, {Decision::friction_slid, Decision::too_steep_to_stand,
                                              Decision::static_friction_off});
            if (why != nullptr) words.say(". ").decision(*why);
            if (after.ground_surface >= names_.surfaces.size()) return;
            const SurfaceType& type = names_.surfaces[after.ground_surface];
            if (type.keeps_energy) words.say(": the type `" + type.name + "` keeps energy");
            if (type.friction < 1.0) words.say(": friction ").ratio(type.friction);
        });
    }

    struct Rising {
        double from = 0.0, speed = 0.0, highest = 0.0;
        std::size_t tick = 0;
        std::optional<std::size_t> cut = {};
        FaceId under = no_id;
    };

    const TickScene& scene_;
    const TapeRun& run_;
    const StoryNames& names_;
    std::vector<RunEvent> events_;
    std::vector<double> weights_;  // [event]
    std::optional<Rising> rising_;
    std::optional<std::size_t> left_ground_;
    double highest_ = 0.0;
    std::size_t slow_ticks_ = 0, idle_ticks_ = 0;
    double last_speed_ = 0.0;
};

}  // namespace

std::vector<RunEvent> find_events(const TickScene& scene, const TapeRun& run, const StoryNames& names,
                                  const std::function<bool()>& cancelled) {
    EventReader reader(scene, run, names);
    constexpr std::size_t at_once = TapeRun::keyframe_ticks;
    const std::size_t ticks = run.samples().size();
    for (std::size_t first = 0; first < ticks && !(cancelled && cancelled()); first += at_once)
        for (const TickTrace& trace : run.traces(scene, first, std::min(ticks, first + at_once) - 1))
            reader.read(trace);
    return reader.finish();
}

std::string events_text(std::span<const RunEvent> events, double dt) {
    std::string text;
    for (const RunEvent& event : events)
        text += fmt::format("at {:.2f} s  {:<12}  {}\n", static_cast<double>(event.first) * dt, event.word,
                            event.text);
    return text;
}

std::vector<VelocityChange> velocity_changes(const TickTrace& trace, const StoryNames& names) {
    std::vector<VelocityChange> changes;
    const auto add = [&](std::string text, const Vec3& change, std::optional<std::size_t> record) {
        constexpr double unseen = 1e-9;
        if (change.norm() > unseen) changes.push_back({std::move(text), change, record});
    };
    const Vec3 end = trace.after.stepped.velocity;
    Vec3 now = trace.before.velocity;
    // Until the first contact the stick, gravity and the button act.
    bool driven = false, jumped = false;
    const auto drive = [&](const Vec3& to) {
        if (std::exchange(driven, true)) return add("Other rules", to - now, {});
        const Vec3 change = to - now;
        add(trace.input.wish.isZero(0.0) ? "Braking" : "Stick", Vec3(change.x(), 0.0, change.z()), {});
        add(jumped                  ? "Jump"
            : trace.before.grounded ? "Pressed to the ground"
                                    : "Gravity",
            Vec3(0.0, change.y(), 0.0), {});
    };
    for (const TraceRecord& record : trace.records)
        if (const auto* decision = std::get_if<DecisionRecord>(&record))
            jumped = jumped || std::ranges::find(jump_starts, decision->kind) != jump_starts.end();
    for (std::size_t i = 0; i < trace.records.size(); ++i) {
        const auto* response = std::get_if<ResponseRecord>(&trace.records[i]);
        if (response == nullptr) continue;
        drive(response->velocity_before);
        add(std::string(rule_name(response->rule)) + " at " +
                face_text(names, response->face, response->surface),
            response->velocity_after - response->velocity_before, i);
        now = response->velocity_after;
    }
    if (driven)
        add("What holds the player", end - now, {});
    else
        drive(end);
    return changes;
}

std::string velocity_text(const TickTrace& trace, const StoryNames& names) {
    const auto vector = [](const Vec3& v) {
        return fmt::format("({:.2f}, {:.2f}, {:.2f})", v.x(), v.y(), v.z());
    };
    std::string text = fmt::format("Velocity from {} to {} m/s\n", vector(trace.before.velocity),
                                   vector(trace.after.stepped.velocity));
    for (const VelocityChange& change : velocity_changes(trace, names))
        text += fmt::format("  {:<28} {}\n", vector(change.change), change.text);
    return text;
}

}  // namespace slipface
