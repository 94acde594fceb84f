#include <array>
#include <deque>
#include <map>
#include <type_traits>

#include "calls.h"
#include "slipface/base/parallel.h"
#include "slipface/movement/crowd.h"
#include "slipface/movement/triggers.h"

using namespace slipface;
using namespace slipface::c;

namespace {

// What hacks add to the lists of PlayerState has room in slipface_player.
constexpr std::size_t named_vectors = 4;
static_assert(PlayerState::numbers.size() <= std::extent_v<decltype(slipface_player::numbers)>);
static_assert(PlayerState::vectors.size() <=
              named_vectors + std::extent_v<decltype(slipface_player::vectors)>);
static_assert(PlayerState::counts.size() <= std::extent_v<decltype(slipface_player::counts)>);
static_assert(PlayerState::flags.size() <= 32);
static_assert(PlayerState::vectors[0] == &PlayerState::position &&
              PlayerState::vectors[1] == &PlayerState::velocity &&
              PlayerState::vectors[2] == &PlayerState::ground_normal &&
              PlayerState::vectors[3] == &PlayerState::air_frame);
static_assert(TriggerMemory::capacity == std::extent_v<decltype(slipface_player::trigger_type)>);

static_assert(sizeof(slipface_player) == sizeof(std::uint32_t[4 + 3 + 8]) + sizeof(std::uint8_t[12 + 8]) +
                                             sizeof(double[4 * 3 + 20 + 4 * 3]),
              "no padding: equal players have equal bytes");

// In the order of PlayerState::vectors.
template <class Player>
auto& vector_of(Player& player, std::size_t i) {
    switch (i) {
        case 0: return player.position;
        case 1: return player.velocity;
        case 2: return player.ground_normal;
        case 3: return player.air_frame;
        default: return player.vectors[i - named_vectors];
    }
}

PlayerState state_of(const World& in, const slipface_player& player) {
    if (player.size != sizeof player)
        refuse(SLIPFACE_WRONG_ARGUMENT,
               "player: found one of {} bytes, expected {}, as slipface_player_at writes it", player.size,
               sizeof player);
    PlayerState state;
    constexpr std::array<const char*, named_vectors> names{"position", "velocity", "ground_normal",
                                                           "air_frame"};
    for (std::size_t i = 0; i < PlayerState::vectors.size(); ++i)
        state.*PlayerState::vectors[i] =
            finite(vector_of(player, i), i < names.size() ? names[i] : "vectors");
    for (std::size_t i = 0; i < PlayerState::numbers.size(); ++i) {
        if (!std::isfinite(player.numbers[i]))
            refuse(SLIPFACE_WRONG_ARGUMENT, "player: found {}, expected finite numbers", player.numbers[i]);
        state.*PlayerState::numbers[i] = player.numbers[i];
    }
    for (std::size_t i = 0; i < PlayerState::counts.size(); ++i)
        state.*PlayerState::counts[i] = player.counts[i];
    for (std::size_t i = 0; i < PlayerState::flags.size(); ++i)
        state.*PlayerState::flags[i] = ((player.flags >> i) & 1U) != 0;
    std::copy_n(player.sector, 3, state.sector.begin());
    state.ground_face = player.ground_face;
    state.ground_platform = player.ground_platform;
    if (player.ground_platform != SLIPFACE_NONE && player.ground_platform >= in.now->platforms.size())
        refuse(SLIPFACE_WRONG_ARGUMENT, "ground_platform: found {}, expected one below {} or SLIPFACE_NONE",
               player.ground_platform, in.now->platforms.size());
    if (player.ground_type >= in.now->surfaces.size())
        refuse(SLIPFACE_WRONG_ARGUMENT, "ground_type: found {}, expected one below {}", player.ground_type,
               in.now->surfaces.size());
    state.ground_surface = player.ground_type;
    if (player.carrier > static_cast<std::uint8_t>(Carrier::character))
        refuse(SLIPFACE_WRONG_ARGUMENT, "carrier: found {}, expected a slipface_carrier", player.carrier);
    state.carrier = static_cast<Carrier>(player.carrier);
    if (player.trigger_count > TriggerMemory::capacity)
        refuse(SLIPFACE_WRONG_ARGUMENT, "trigger_count: found {}, expected at most {}", player.trigger_count,
               TriggerMemory::capacity);
    return state;
}

TriggerMemory triggers_of(const slipface_player& player) {
    TriggerMemory memory;
    memory.count = player.trigger_count;
    for (std::size_t i = 0; i < memory.count; ++i)
        memory.inside[i] = {player.trigger_platform[i], player.trigger_type[i]};
    return memory;
}

slipface_player player_of(const PlayerState& state, const TriggerMemory& triggers = {}) {
    slipface_player player{};
    player.size = sizeof player;
    for (std::size_t i = 0; i < PlayerState::vectors.size(); ++i)
        vector_of(player, i) = vec(state.*PlayerState::vectors[i]);
    for (std::size_t i = 0; i < PlayerState::numbers.size(); ++i)
        player.numbers[i] = state.*PlayerState::numbers[i];
    for (std::size_t i = 0; i < PlayerState::counts.size(); ++i)
        player.counts[i] = state.*PlayerState::counts[i];
    for (std::size_t i = 0; i < PlayerState::flags.size(); ++i)
        player.flags |= (state.*PlayerState::flags[i] ? 1U : 0U) << i;
    std::copy_n(state.sector.begin(), 3, player.sector);
    player.carrier = static_cast<std::uint8_t>(state.carrier);
    player.ground_face = state.ground_face;
    player.ground_platform = state.ground_platform;
    player.ground_type = state.ground_surface;
    player.trigger_count = static_cast<std::uint8_t>(triggers.count);
    for (std::size_t i = 0; i < triggers.count; ++i) {
        player.trigger_platform[i] = triggers.inside[i].platform;
        player.trigger_type[i] = triggers.inside[i].surface;
    }
    return player;
}

PlayerInput input_of(const slipface_input& given) {
    const slipface_input input = taken(given, "input");
    if (!std::isfinite(input.wish_x) || !std::isfinite(input.wish_z))
        refuse(SLIPFACE_WRONG_ARGUMENT, "wish: found ({}, {}), expected finite numbers", input.wish_x,
               input.wish_z);
    ButtonSet buttons;
    buttons.bits = input.buttons;
    return {.wish = {input.wish_x, input.wish_z}, .buttons = buttons};
}

void need_dt(double dt) {
    if (!(dt >= 1e-4) || !std::isfinite(dt))
        refuse(SLIPFACE_WRONG_ARGUMENT, "dt: found {}, expected 1e-4 or more", dt);
}

class Caller final : public TraceSink {
  public:
    Caller(slipface_trace trace, void* user, const MovementScene& scene)
        : trace_(trace), user_(user), scene_(scene) {}

    void add(const TraceRecord& record) override {
        slipface_record made{};
        made.name = made.text = "";
        made.contact = no_contact();
        made.face = SLIPFACE_NONE;
        std::visit([&](const auto& one) { fill(made, one); }, record);
        trace_(user_, &made);
    }

  private:
    void fill(slipface_record& made, const SweepRecord& sweep) const {
        made.kind = SLIPFACE_SWEEP;
        made.name = pass_name(sweep.pass);
        made.from = vec(sweep.from);
        made.move = vec(sweep.move);
        made.to = vec(sweep.reached);
        if (!sweep.contact) return;
        const bool moves = sweep.platform < scene_.platforms.size();
        made.contact = contact_of(*sweep.contact, sweep.platform,
                                  moves ? scene_.platforms[sweep.platform].triangles : scene_.triangles);
        made.face = sweep.contact->face;
    }
    static void fill(slipface_record& made, const ResponseRecord& response) {
        made.kind = SLIPFACE_RESPONSE;
        made.name = rule_name(response.rule);
        made.from = vec(response.remainder_before);
        made.to = vec(response.remainder_after);
        made.contact.normal = vec(response.normal);
        made.contact.face = made.face = response.face;
        made.contact.type = response.surface;
    }
    static void fill(slipface_record& made, const DecisionRecord& decision) {
        const DecisionInfo& info = decision_info(decision.kind);
        made.kind = SLIPFACE_DECISION;
        made.name = info.hack;
        made.text = info.sentence;
        made.value = decision.value;
        made.limit = decision.limit;
        made.face = decision.face;
    }
    static void fill(slipface_record& made, const PushOutRecord& push) {
        made.kind = SLIPFACE_PUSH_OUT;
        made.name = "push_out";
        made.from = vec(push.from);
        made.to = vec(push.to);
        made.value = push.planes;
        made.limit = push.free ? 1.0 : 0.0;
    }

    slipface_trace trace_;
    void* user_;
    const MovementScene& scene_;
};

// What a caller asks of a step besides the player. Contacts are found here and then written where the caller
// wants them.
class Report {
  public:
    explicit Report(slipface_report* to) : to_(to) {
        if (to == nullptr) return;
        asked_ = taken(*to, "report");
        if (asked_.contact_room > 0) need("contacts", asked_.contacts);
        if (asked_.event_room > 0) need("events", asked_.events);
        if (asked_.contact_room > most || asked_.event_room > most)
            refuse(SLIPFACE_WRONG_ARGUMENT,
                   "report: found room for {} contacts and {} events, expected at most {}",
                   asked_.contact_room, asked_.event_room, most);
    }
    Report(const Report&) = delete;
    Report& operator=(const Report&) = delete;

    // Null if nobody asks. Events are read from contacts, so they want some in any case.
    StepContacts* contacts() {
        if (asked_.contact_room == 0 && asked_.event_room == 0) return nullptr;
        contacts_.out = room_;
        return &contacts_;
    }
    slipface_trace trace() const { return asked_.trace; }
    void* user() const { return asked_.user; }

    // Sets the caller's report, and returns the player after the step.
    slipface_player finish(const MovementScene& scene, const MovementSettings& settings,
                           const PlayerState& before, const slipface_player& player,
                           const PlayerState& after) {
        TriggerMemory triggers = triggers_of(player);
        if (to_ == nullptr) return player_of(after, triggers);
        const std::size_t shown = std::min<std::size_t>(contacts_.count, asked_.contact_room);
        for (std::size_t i = 0; i < shown; ++i)
            asked_.contacts[i] = contact_of(room_[i]);
        to_->contact_count = static_cast<std::uint32_t>(shown);
        to_->contacts_left_out = contacts_.full || shown < contacts_.count ? 1 : 0;
        to_->event_count = 0;
        if (asked_.event_room == 0) return player_of(after, triggers);
        std::array<StepEvent, most + 32> events;
        std::size_t found = find_events(settings, before, after, contacts_, events);
        found = std::min(found, events.size());
        found += track_triggers(scene, settings.radii, position_in_scene(scene, before),
                                position_in_scene(scene, after), triggers, std::span(events).subspan(found));
        found = std::min(found, events.size());
        for (std::size_t i = 0; i < std::min<std::size_t>(found, asked_.event_room); ++i)
            asked_.events[i] = {static_cast<std::uint32_t>(events[i].kind),
                                events[i].surface,
                                events[i].platform,
                                events[i].face,
                                events[i].value,
                                {}};
        to_->event_count = static_cast<std::uint32_t>(found);
        return player_of(after, triggers);
    }

  private:
    static constexpr std::size_t most = 64;

    static slipface_contact contact_of(const StepContact& one) {
        slipface_contact made{};
        made.normal = vec(one.normal);
        made.point = vec(one.point);
        made.triangle = one.triangle;
        made.face = one.face;
        made.type = one.surface;
        made.platform = one.platform;
        made.feature = static_cast<std::uint32_t>(one.feature);
        made.pass = static_cast<std::uint32_t>(one.pass);
        made.speed = one.speed;
        return made;
    }

    slipface_report* to_;
    slipface_report asked_{};
    std::array<StepContact, most> room_;
    StepContacts contacts_;
};

// Of arrays that may be null.
template <class Sized>
Sized* nth_of(Sized* first, std::size_t i) {
    return first == nullptr ? nullptr : &nth(first, i);
}

slipface_player step_one(const World& in, const MovementSettings& settings, const slipface_player& player,
                         const slipface_input& input, double dt, const slipface_filter* filter,
                         slipface_report* to) {
    const Seen seen(in, filter);
    Report report(to);
    Caller caller(report.trace(), report.user(), seen.scene());
    const PlayerState before = state_of(in, player);
    const PlayerState after = step(seen.scene(), settings, before, input_of(input), dt,
                                   report.trace() == nullptr ? nullptr : &caller, report.contacts())
                                  .state;
    return report.finish(seen.scene(), settings, before, player, after);
}

}  // namespace

slipface_status slipface_player_at(slipface_world world, slipface_vec3 position, slipface_player* player,
                                   slipface_error* error) {
    return run(error, [&] {
        need("player", player);
        const SharedWorld in(world.id);
        PlayerState state;
        put_in_scene(*in->now, finite(position, "position"), state);
        *player = player_of(state);
    });
}

slipface_status slipface_step(slipface_world world, slipface_settings settings, const slipface_player* player,
                              const slipface_input* input, double dt, const slipface_filter* filter,
                              slipface_report* report, slipface_player* next, slipface_error* error) {
    return run(error, [&] {
        need("player, input and next", player, input, next);
        need_dt(dt);
        const SharedWorld in(world.id);
        const SharedSettings with(settings.id);
        *next = step_one(*in, with->values, *player, *input, dt, filter, report);
    });
}

slipface_status slipface_step_many(slipface_world world, slipface_settings settings, slipface_player* players,
                                   const slipface_input* inputs, size_t count, double dt,
                                   const slipface_filter* filters, slipface_report* reports,
                                   slipface_error* error) {
    return run(error, [&] {
        if (count > 0) need("players and inputs", players, inputs);
        need_dt(dt);
        const SharedWorld in(world.id);
        const SharedSettings with(settings.id);
        for (std::size_t i = 0; i < count; ++i) {  // first, so that no player moves if one is wrong
            (void)state_of(*in, players[i]), (void)input_of(nth(inputs, i));
            const Seen seen(*in, nth_of(filters, i));
            const Report report(nth_of(reports, i));
        }
        parallel_for(count, 8, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i)
                players[i] = step_one(*in, with->values, players[i], nth(inputs, i), dt, nth_of(filters, i),
                                      nth_of(reports, i));
        });
    });
}

slipface_status slipface_step_crowd(slipface_world world, const slipface_settings* settings,
                                    slipface_player* players, const slipface_input* inputs, size_t count,
                                    double dt, const slipface_filter* filters, slipface_report* reports,
                                    slipface_error* error) {
    return run(error, [&] {
        if (count > 0) need("settings, players and inputs", settings, players, inputs);
        need_dt(dt);
        const SharedWorld in(world.id);
        // Players mostly have few settings between them.
        std::map<std::uint64_t, MovementSettings> values;
        std::deque<Seen> seen;
        std::deque<Report> report;
        std::vector<CrowdMember> crowd(count);
        for (std::size_t i = 0; i < count; ++i) {
            const std::uint64_t id = settings[i].id;
            if (!values.contains(id)) values.emplace(id, SharedSettings(id)->values);
            if (filters != nullptr) seen.emplace_back(*in, &nth(filters, i));
            if (reports != nullptr) report.emplace_back(&nth(reports, i));
            crowd[i] = {&values.at(id), state_of(*in, players[i]), input_of(nth(inputs, i)),
                        filters != nullptr ? seen[i].filter() : nullptr,
                        reports != nullptr ? report[i].contacts() : nullptr};
        }
        step_crowd(*in->now, crowd, dt);
        for (std::size_t i = 0; i < count; ++i) {
            if (reports == nullptr) {
                players[i] = player_of(crowd[i].state, triggers_of(players[i]));
                continue;
            }
            const MovementScene& scene = filters != nullptr ? seen[i].scene() : *in->now;
            players[i] = report[i].finish(scene, *crowd[i].settings, state_of(*in, players[i]), players[i],
                                          crowd[i].state);
        }
    });
}

slipface_status slipface_change_body(slipface_world world, slipface_settings settings,
                                     const slipface_player* player, slipface_vec3 radii,
                                     const slipface_filter* filter, slipface_player* next, uint8_t* done,
                                     slipface_error* error) {
    return run(error, [&] {
        need("player, next and done", player, next, done);
        const Vec3 body = positive(radii, "radii");
        const SharedWorld in(world.id);
        const SharedSettings with(settings.id);
        const Seen seen(*in, filter);
        const auto changed = change_body(seen.scene(), with->values, state_of(*in, *player), body);
        *next = changed ? player_of(*changed, triggers_of(*player)) : *player;
        *done = changed ? 1 : 0;
    });
}

slipface_status slipface_put_player(slipface_world world, slipface_settings settings,
                                    const slipface_player* player, double farthest,
                                    const slipface_filter* filter, slipface_player* next, uint8_t* done,
                                    slipface_error* error) {
    return run(error, [&] {
        need("player, next and done", player, next, done);
        if (!(farthest >= 0.0 && farthest <= 1e6))
            refuse(SLIPFACE_WRONG_ARGUMENT, "farthest: found {}, expected 0 to 1e6 m", farthest);
        const SharedWorld in(world.id);
        const SharedSettings with(settings.id);
        const Seen seen(*in, filter);
        const auto put = put_player(seen.scene(), with->values, state_of(*in, *player), farthest);
        *next = put ? player_of(*put) : *player;
        *done = put ? 1 : 0;
    });
}

slipface_status slipface_motion_velocity(const slipface_player* player, slipface_vec3* velocity,
                                         slipface_error* error) {
    return run(error, [&] {
        need("player and velocity", player, velocity);
        PlayerState state;
        state.velocity = finite(player->velocity, "velocity");
        state.ground_normal = finite(player->ground_normal, "ground_normal");
        state.grounded = (player->flags & SLIPFACE_GROUNDED) != 0;
        state.climbing = (player->flags & SLIPFACE_CLIMBING) != 0;
        state.stuck = (player->flags & SLIPFACE_STUCK) != 0;
        *velocity = vec(motion_velocity(state));
    });
}
