#include "calls.h"
#include "slipface/base/parallel.h"
#include "slipface/movement/crowd.h"

using namespace slipface;
using namespace slipface::c;

namespace {

// The members that are a number, a count or a flag on both sides: each(of the engine, of C).
template <class State, class Player, class Each>
void each_member(State& state, Player& player, const Each& each) {
    each(state.ground_rise, player.ground_rise);
    each(state.coyote_s, player.coyote_s);
    each(state.jump_buffer_s, player.jump_buffer_s);
    each(state.wall_x, player.wall_x);
    each(state.wall_z, player.wall_z);
    each(state.wall_lock_s, player.wall_lock_s);
    each(state.move_s, player.move_s);
    each(state.air_jumps, player.air_jumps);
    each(state.dashes, player.dashes);
    each(state.grounded, player.grounded);
    each(state.climbing, player.climbing);
    each(state.stuck, player.stuck);
    each(state.jump_held, player.jump_held);
    each(state.hazard, player.hazard);
    each(state.jumping, player.jumping);
    each(state.trapped, player.trapped);
    each(state.crushed, player.crushed);
    each(state.dash_held, player.dash_held);
    each(state.hanging, player.hanging);
    each(state.crouched, player.crouched);
    each(state.wants_to_stand, player.wants_to_stand);
    each(state.dropping, player.dropping);
}

PlayerState state_of(const World& in, const slipface_player& player) {
    PlayerState state;
    state.position = finite(player.position, "position");
    state.velocity = finite(player.velocity, "velocity");
    state.ground_normal = finite(player.ground_normal, "ground_normal");
    state.air_frame = finite(player.air_frame, "air_frame");
    each_member(state, player, [](auto& to, const auto& from) {
        if constexpr (std::is_same_v<decltype(to), double&>)
            if (!std::isfinite(from))
                refuse(SLIPFACE_WRONG_ARGUMENT, "player: found {}, expected finite numbers", from);
        if constexpr (std::is_same_v<decltype(to), bool&>)
            to = from != 0;
        else
            to = from;
    });
    for (std::size_t axis = 0; axis < 3; ++axis)
        state.sector[axis] = player.sector[axis];
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
    return state;
}

slipface_player player_of(const PlayerState& state) {
    slipface_player player{};
    player.position = vec(state.position);
    player.velocity = vec(state.velocity);
    player.ground_normal = vec(state.ground_normal);
    player.air_frame = vec(state.air_frame);
    player.carrier = static_cast<std::uint8_t>(state.carrier);
    each_member(state, player, [](const auto& from, auto& to) { to = from; });
    for (std::size_t axis = 0; axis < 3; ++axis)
        player.sector[axis] = state.sector[axis];
    player.ground_face = state.ground_face;
    player.ground_platform = state.ground_platform;
    player.ground_type = state.ground_surface;
    return player;
}

PlayerInput input_of(const slipface_input& input) {
    if (!std::isfinite(input.wish_x) || !std::isfinite(input.wish_z))
        refuse(SLIPFACE_WRONG_ARGUMENT, "wish: found ({}, {}), expected finite numbers", input.wish_x,
               input.wish_z);
    ButtonSet buttons{Button::jump, input.jump != 0};
    buttons.bits |= input.buttons;
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
                              const slipface_input* input, double dt, slipface_trace trace, void* user,
                              slipface_player* next, slipface_error* error) {
    return run(error, [&] {
        need("player, input and next", player, input, next);
        need_dt(dt);
        const SharedWorld in(world.id);
        const SharedSettings with(settings.id);
        Caller caller(trace, user, *in->now);
        *next = player_of(step(*in->now, with->values, state_of(*in, *player), input_of(*input), dt,
                               trace == nullptr ? nullptr : &caller)
                              .state);
    });
}

slipface_status slipface_step_many(slipface_world world, slipface_settings settings, slipface_player* players,
                                   const slipface_input* inputs, size_t count, double dt,
                                   slipface_error* error) {
    return run(error, [&] {
        if (count > 0) need("players and inputs", players, inputs);
        need_dt(dt);
        const SharedWorld in(world.id);
        const SharedSettings with(settings.id);
        for (std::size_t i = 0; i < count; ++i)  // first, so that no player moves if one is wrong
            (void)state_of(*in, players[i]), (void)input_of(inputs[i]);
        parallel_for(count, 8, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i)
                players[i] = player_of(
                    step(*in->now, with->values, state_of(*in, players[i]), input_of(inputs[i]), dt).state);
        });
    });
}

slipface_status slipface_step_crowd(slipface_world world, const slipface_settings* settings,
                                    slipface_player* players, const slipface_input* inputs, size_t count,
                                    double dt, slipface_error* error) {
    return run(error, [&] {
        if (count > 0) need("settings, players and inputs", settings, players, inputs);
        need_dt(dt);
        const SharedWorld in(world.id);
        std::vector<MovementSettings> values(count);
        std::vector<CrowdMember> crowd(count);
        for (std::size_t i = 0; i < count; ++i) {
            values[i] = SharedSettings(settings[i].id)->values;
            crowd[i] = {&values[i], state_of(*in, players[i]), input_of(inputs[i])};
        }
        step_crowd(*in->now, crowd, dt);
        for (std::size_t i = 0; i < count; ++i)
            players[i] = player_of(crowd[i].state);
    });
}

slipface_status slipface_change_body(slipface_world world, slipface_settings settings,
                                     const slipface_player* player, slipface_vec3 radii,
                                     slipface_player* next, uint8_t* done, slipface_error* error) {
    return run(error, [&] {
        need("player, next and done", player, next, done);
        if (!(finite(radii, "radii").minCoeff() > 0.0))
            refuse(SLIPFACE_WRONG_ARGUMENT, "radii: found ({}, {}, {}), expected numbers above 0", radii.x,
                   radii.y, radii.z);
        const SharedWorld in(world.id);
        const SharedSettings with(settings.id);
        const auto changed = change_body(*in->now, with->values, state_of(*in, *player), vec(radii));
        *next = changed ? player_of(*changed) : *player;
        *done = changed ? 1 : 0;
    });
}

slipface_status slipface_put_player(slipface_world world, slipface_settings settings,
                                    const slipface_player* player, double farthest, slipface_player* next,
                                    uint8_t* done, slipface_error* error) {
    return run(error, [&] {
        need("player, next and done", player, next, done);
        if (!(farthest >= 0.0 && farthest <= 1e6))
            refuse(SLIPFACE_WRONG_ARGUMENT, "farthest: found {}, expected 0 to 1e6 m", farthest);
        const SharedWorld in(world.id);
        const SharedSettings with(settings.id);
        const auto put = put_player(*in->now, with->values, state_of(*in, *player), farthest);
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
        state.grounded = player->grounded != 0;
        state.climbing = player->climbing != 0;
        state.stuck = player->stuck != 0;
        *velocity = vec(motion_velocity(state));
    });
}
