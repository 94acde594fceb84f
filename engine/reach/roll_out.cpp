#include "roll_out.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "slipface/collision/collision_world.h"
#include "slipface/sim/reach.h"

namespace slipface {
namespace {

constexpr std::uint32_t longest_flight = 300;  // ticks after which a flight is left to later roll-outs
constexpr std::uint32_t air_note = 60;         // ticks in the air after which the state is kept
constexpr double patience_share = 0.95;        // a faster way to a cell must save a twentieth ...
constexpr std::uint32_t patience_ticks = 3;    // ... and so many ticks
constexpr double exit_spot_m = 2.0;            // exits nearer to each other count as one
constexpr std::size_t max_presses = 24;        // of one roll-out
constexpr std::uint32_t trail_length = 96;

// The order in which the eight and the sixteen main directions are tried: far apart first.
constexpr std::array<std::uint8_t, 16> spread{0, 32, 16, 48, 8, 40, 24, 56, 4, 36, 20, 52, 12, 44, 28, 60};

struct Cursor {
    PlayerState state;
    std::uint32_t tick = 0;
    std::uint64_t cell = 0;
    FaceId face = no_id;          // held last by it ...
    Vec3 held_at = Vec3::Zero();  // ... here, in the scene's coordinates
    std::uint32_t air = 0;        // ticks since then
    std::uint8_t count = 0;
    std::array<Press, max_presses> presses;
    bool alive = true;
};

std::uint64_t mix(std::uint64_t hash, std::uint64_t value) {
    hash = (hash ^ value) * 0x9e3779b97f4a7c15ULL;
    return hash ^ (hash >> 29);
}

std::uint64_t grid(double value, double size) {
    return static_cast<std::uint64_t>(static_cast<std::int64_t>(std::floor(value / size)));
}

std::uint64_t exit_spot(const Vec3& position) {
    std::uint64_t spot = 1;
    for (int axis = 0; axis < 3; ++axis)
        spot = mix(spot, grid(position[axis], exit_spot_m));
    return spot;
}

class Roller {
  public:
    Roller(const ReachWorld& world, TickScenes& scenes, const ReachKnown& known, NodeId from,
           Harvest& harvest, const TickWatcher* watcher)
        : world_(world),
          settings_(world.level->movement),
          dt_(world.options.dt),
          in_air_(jumps_in_air(settings_)),
          others_(buttons_at_moments(settings_)),
          flight_(static_cast<std::uint32_t>(
              std::clamp(2.0 * settings_.jump_speed / std::max(settings_.gravity * dt_, 1e-9), 3.0,
                         1.0 * longest_flight))),
          scenes_(scenes),
          known_(known),
          from_(from),
          returns_(known.archive.nodes[from].returns),
          harvest_(harvest),
          watcher_(watcher) {}

    Cursor begin() const {
        const ReachNode& node = known_.archive.nodes[from_];
        Cursor cursor;
        cursor.state = node.state;
        cursor.tick = node.tick;
        cursor.cell = node.cell;
        if (is_held(node.state) && !node.state.hanging) cursor.face = node.state.ground_face;
        const ReachNode& last = known_.archive.nodes[last_held()];
        cursor.held_at = position_in_scene(scenes_.at(last.tick), last.state);
        return cursor;
    }

    // One tick. False when the roll-out is over: out of the level, killed, or too many inputs.
    bool tick(Cursor& cursor, std::uint8_t stick, bool jump) {
        ButtonSet held(Button::jump, jump);
        const std::uint32_t age = cursor.tick - known_.archive.nodes[from_].tick;
        for (const Pulse& pulse : pulses_)
            if (const std::uint32_t came = came_[pulse.moment];
                age >= came && age - came >= pulse.delay && age - came - pulse.delay < pulse.length)
                held.bits ^= pulse.button.bits;
        const auto buttons = static_cast<std::uint8_t>(held.bits);
        if (!cursor.alive || !press(cursor, stick, buttons)) return cursor.alive = false;
        const MovementScene& now = scenes_.at(cursor.tick);
        const bool rose = cursor.state.velocity.y() > 0.0, was_held = is_held(cursor.state);
        const TickResult result =
            play_tick(now, settings_, cursor.state, input_of({1, stick, buttons}), dt_, world_.start);
        ++harvest_.steps;
        ++cursor.tick;
        if (result.respawn == Respawn::hazard || result.respawn == Respawn::crushed)
            return cursor.alive = false;
        if (result.respawn == Respawn::fall || position_in_scene(now, result.stepped).y() < world_.lowest) {
            note_exit(cursor);
            return cursor.alive = false;
        }
        cursor.state = result.state;
        note(cursor, now, rose);
        see_moments(cursor.state, was_held, rose, age + 1);
        if (watcher_ != nullptr)
            (*watcher_)(now, cursor.state, std::span(cursor.presses).first(cursor.count), cursor.tick);
        return true;
    }

    // So many ticks, or until something holds the player again if `until_held`.
    bool go(Cursor& cursor, std::uint32_t ticks, std::uint8_t stick, bool jump, bool until_held) {
        for (std::uint32_t i = 0; i < ticks; ++i) {
            if (!tick(cursor, stick, jump)) return false;
            if (until_held && is_held(cursor.state)) return true;
        }
        return true;
    }

    // Stands until what moves around it is in another stage: what comes once, and late, is worth the wait.
    void wait(Cursor& cursor) {
        const Vec3 at = position_in_scene(scenes_.at(cursor.tick), cursor.state);
        const std::size_t i = world_.moving_at(at);
        if (i == world_.moving.size()) return;
        const double seconds = world_.moving[i].until_next(cursor.tick * dt_);
        if (seconds > 0.0)
            go(cursor, static_cast<std::uint32_t>(seconds / dt_) + 1, stick_at_rest, false, false);
    }

    // Walks towards a goal that is not reached yet.
    void aim(Cursor cursor, ReachRandom& random) {
        if (world_.goals.empty()) return;
        const std::size_t goal = random.below(static_cast<std::uint32_t>(world_.goals.size()));
        constexpr std::uint32_t legs = 12, leg_ticks = 15;
        for (std::uint32_t leg = 0; leg < legs && !known_.goals[goal].found(); ++leg) {
            const Vec3 way = world_.goals[goal] - position_in_scene(scenes_.at(cursor.tick), cursor.state);
            if (!go(cursor, leg_ticks, stick_towards({way.x(), way.z()}), false, false)) return;
        }
    }

    // A press of jump, held for `hold` ticks; steered by `stick`, after `turn` ticks by `then`.
    // In the air it is let go and pressed again every `again` ticks; 0: never.
    void jump(Cursor cursor, std::uint8_t stick, std::uint32_t hold, std::uint32_t turn, std::uint8_t then,
              std::uint32_t again = 0) {
        if (cursor.state.jump_held && !tick(cursor, stick, false)) return;
        for (std::uint32_t i = 0; i < longest_flight; ++i) {
            const bool presses = again == 0 ? i < hold : i % again < std::min(hold, again - 1);
            if (!tick(cursor, i < turn ? stick : then, presses)) return;
            if (i > 0 && is_held(cursor.state)) break;
        }
        // What was landed on may slide, carry or be left again at once.
        go(cursor, 4, then, false, false);
    }

    // Turned at most `latest` ticks after it begins; without a stick towards any side.
    void random_jump(const Cursor& cursor, std::optional<std::uint8_t> stick, std::uint32_t latest,
                     std::uint32_t press, ReachRandom& random) {
        // Drawn one by one: the arguments of one call have no order.
        const std::uint8_t then = steer(random);
        const std::uint32_t turn = random.below(latest), held = hold(random);
        if (!stick) stick = steer(random);
        jump(cursor, *stick, held, turn, then, press);
    }

    // Runs until an edge or an obstacle, and jumps from before it, at it and after it.
    void run_and_branch(const Cursor& begin, std::uint8_t stick, std::uint32_t length, ReachRandom* random) {
        std::array<Cursor, trail_length> trail;
        std::uint32_t count = 0;
        const Vec2 ahead = direction_vector(stick);
        const double stride = settings_.walk_speed * dt_;
        Cursor cursor = begin;
        bool edge = false, wall = false;
        while (count < std::min(length, trail_length / 2) && !edge && !wall) {
            trail[count++] = cursor;
            const Vec3 before = cursor.state.position;
            edge = !tick(cursor, stick, false) || !is_held(cursor.state);
            const Vec3 moved = cursor.state.position - before;
            wall = !edge && count > 8 && moved.x() * ahead.x() + moved.z() * ahead.y() < 0.3 * stride;
        }
        if (!edge && !wall) return;
        const std::uint32_t at = count - 1;  // trail[at]: before the tick that lost the ground
        const auto late = static_cast<std::uint32_t>(
            edge && settings_.coyote ? std::clamp(std::floor(settings_.coyote_time / dt_), 0.0, 24.0) : 0.0);
        for (std::uint32_t i = 0; i <= late && edge && cursor.alive && !is_held(cursor.state); ++i) {
            trail[count++] = cursor;
            tick(cursor, stick, false);
        }
        if (edge && cursor.alive) go(cursor, longest_flight, stick, false, true);
        if (random != nullptr) {
            // Mostly from the edge, where jumps reach farthest; for what stands behind it, from before, too.
            const std::uint32_t run_up = edge && random->below(3) > 0 ? 4 : 40;
            const std::uint32_t begin_at = at - std::min(at, run_up);
            const std::uint32_t turn = random->below(40);
            const std::uint32_t from = begin_at + random->below(count - begin_at);
            const std::uint8_t then = random->below(2) == 0 ? stick : steer(*random);
            const std::uint32_t press = again(*random);
            return jump(trail[from], stick, hold(*random), turn, then, press);
        }
        if (wall) {
            for (const std::uint32_t back : {0u, 7u, 14u})
                if (back <= at) jump(trail[at - back], stick, longest_flight, longest_flight, stick);
            return;
        }
        // Over a gap a second jump reaches farthest where the first has come back to its height.
        if (settings_.air_jump) jump(trail[at], stick, longest_flight, longest_flight, stick, flight_);
        for (std::uint32_t from = at; from < count; ++from) {
            // The last ticks of coyote time reach farthest; those between, first and last, are left to
            // chance.
            if (from > at && from + 2 < count) continue;
            jump(trail[from], stick, longest_flight, longest_flight, stick);
        }
    }

    void at_random(const Cursor& begin, ReachRandom& random) {
        const std::uint8_t stick = steer(random);
        Cursor cursor = begin;
        switch (random.below(world_.changes() ? 8 : 7)) {
            case 0:
            case 1: return run_and_branch(begin, full_stick(stick), 12 + random.below(36), &random);
            case 2: {  // a turn before the edge
                const std::uint8_t first = steer(random);
                go(cursor, 2 + random.below(20), first, false, false);
                if (cursor.alive) run_and_branch(cursor, full_stick(stick), 12 + random.below(36), &random);
                return;
            }
            case 3: {
                const std::uint32_t press = again(random);
                return random_jump(cursor, stick, 48, press, random);
            }
            case 4: {  // a jump on landing from a jump
                const std::uint8_t then = steer(random);
                for (std::uint32_t i = 0; i < longest_flight; ++i)
                    if (!tick(cursor, stick, i < 2) || (i > 1 && is_held(cursor.state))) break;
                return random_jump(cursor, then, 48, 0, random);
            }
            case 5: return void(go(cursor, 10 + random.below(60), stick, false, false));
            case 6: {
                for (int leg = 0; leg < 6; ++leg) {
                    const bool jumps = random.below(3) == 0;
                    const std::uint8_t way = steer(random);
                    if (!go(cursor, 4 + random.below(28), way, jumps, false)) return;
                }
                return void(go(cursor, longest_flight, steer(random), false, true));
            }
            default: return void(go(cursor, 10 + random.below(110), stick_at_rest, false, false));
        }
    }

    // Where the settings read more buttons, each visit comes in pairs: as it is, and with some of them, each
    // pressed, or let go, for a time from a moment of the motion on. Most of what an ability reaches it
    // reaches from there: a dash from the edge, a second jump from the top of the first.
    void visit_with_buttons(std::uint32_t number) {
        pulses_.fill({});
        came_.fill(no_id);
        came_[began] = 0;
        pulsed_ = false;
        if (others_.bits == 0) return visit(number);
        if (number % 2 == 1) {
            ReachRandom random(mix(mix(world_.options.seed, from_), 0x10000 + number));
            std::size_t used = 0;
            for (const ButtonInfo& info : button_table()) {
                if (!others_.has(info.button) || used == pulses_.size()) continue;
                if (random.below(3) == 0) continue;
                const std::uint32_t moment = random.below(moments);
                const std::uint32_t delay = random.below(2) * random.below(1U << random.below(6));
                const std::uint32_t length = 1U << random.below(9);
                pulses_[used++] = {info.button, moment, delay, length};
            }
            pulsed_ = used > 0;
        }
        visit(number / 2);
    }

    // What is tried on the visit of that number: first all that is cheap and systematic, then chance.
    void visit(std::uint32_t number) {
        const Cursor begin = this->begin();
        ReachRandom random(mix(mix(world_.options.seed, from_), number));
        const std::uint8_t main = full_stick(spread[number % 8]);
        const PlayerState& state = begin.state;
        Cursor cursor = begin;
        if (!is_held(state)) {
            if (in_air_ && number < 16) {
                const bool off = number == 0 && state.ground_face != no_id;  // a wall: away from it
                const std::uint8_t way =
                    off ? stick_towards({state.ground_normal.x(), state.ground_normal.z()})
                        : full_stick(spread[number / 2]);
                if (number % 2 == 0) return jump(begin, way, longest_flight, longest_flight, way);
                return void(go(cursor, longest_flight, way, false, true));
            }
            if (number >= 12) {
                const std::uint32_t press = again(random);
                return random_jump(begin, std::nullopt, 60, press, random);
            }
            const std::uint8_t stick = number < 8 ? main : number == 8 ? stick_at_rest : steer(random);
            return void(go(cursor, longest_flight, stick, false, true));
        }
        if (world_.changes() && number == 8) return wait(cursor);
        if (world_.changes() && number % 4 == 3)
            go(cursor, 6 + random.below(40), stick_at_rest, false, false);
        if (!cursor.alive) return;
        if (number == 0) aim(begin, random);
        if (number < 8) {
            go(cursor, state.grounded ? 16 : 40, main, false, false);
            if (pulsed_ && cursor.alive && !is_held(cursor.state))
                go(cursor, longest_flight, main, false, true);
            return;
        }
        if (!state.grounded) {
            if (number < 16) return jump(cursor, main, longest_flight, longest_flight, main);
        } else if (number < 24) {
            return run_and_branch(cursor, full_stick(spread[(number - 8) % 16]), 14, nullptr);
        } else if (number < 32) {
            return jump(cursor, main, longest_flight, longest_flight, main);
        } else if (number == 32) {
            return void(go(cursor, 60, stick_at_rest, false, false));
        }
        at_random(cursor, random);
    }

  private:
    static std::uint8_t steer(ReachRandom& random) {
        const std::uint32_t kind = random.below(10);
        const std::uint32_t direction = random.below(press_directions);
        if (kind == 0) return stick_at_rest;
        if (kind == 1) return static_cast<std::uint8_t>(2 * press_directions + direction);
        return full_stick(direction);
    }
    std::uint32_t hold(ReachRandom& random) const {
        if (!settings_.variable_jump || random.below(3) == 0) return longest_flight;
        return 1 + random.below(30);
    }

    std::uint32_t again(ReachRandom& random) const {
        return in_air_ && random.below(3) > 0 ? 2 + random.below(flight_ + flight_ / 2) : 0;
    }

    static bool press(Cursor& cursor, std::uint8_t stick, std::uint8_t buttons) {
        if (cursor.count > 0) {
            Press& last = cursor.presses[cursor.count - 1u];
            if (last.stick == stick && last.buttons == buttons && last.ticks < 60000)
                return ++last.ticks, true;
        }
        if (cursor.count == max_presses) return false;
        cursor.presses[cursor.count++] = {1, stick, buttons};
        return true;
    }

    void note(Cursor& cursor, const MovementScene& now, bool rose) {
        const PlayerState& state = cursor.state;
        if (!world_.goals.empty()) note_goals(cursor, now);
        const bool held = is_held(state);
        cursor.air = held ? 0 : cursor.air + 1;
        FaceId news = no_id;
        if (held) cursor.held_at = position_in_scene(now, state);
        // A player that hangs from a ledge does not stand on it yet.
        if (held && !state.hanging && state.ground_face != cursor.face) {
            cursor.face = state.ground_face;
            if (cursor.face < known_.faces.size() && is_faster(cursor, known_.faces[cursor.face]))
                news = cursor.face;
        }
        const bool apex = !held && rose && state.velocity.y() <= 0.0;
        const bool at_wall = settings_.wall_jump && !held && state.ground_face != no_id;
        if (!held && !apex && !at_wall && cursor.air % air_note != 0) return;
        const std::uint64_t cell = world_.cell_key(now, state, cursor.tick);
        bool keeps = news != no_id;
        if (cell != cursor.cell) {
            cursor.cell = cell;
            const NodeId known = known_.archive.find(cell);
            if (known == no_id) {
                keeps = true;
            } else {
                keeps |= held && is_faster(cursor, {known, known_.archive.nodes[known].tick});
                if (!returns_ && known != from_) harvest_.reached.push_back(known);
            }
        }
        if (keeps) keep(cursor, now, news, no_id);
    }

    void see_moments(const PlayerState& state, bool was_held, bool rose, std::uint32_t age) {
        const bool held = is_held(state);
        const auto see = [&](Moment moment, bool comes) {
            if (comes && came_[moment] == no_id) came_[moment] = age;
        };
        see(left_ground, was_held && !held);
        see(topped, !held && rose && state.velocity.y() <= 0.0);
        see(met_wall, !held && state.ground_face != no_id);
        see(landed, !was_held && held);
    }

    bool is_faster(const Cursor& cursor, const Reached& known) const {
        return !known.found() || (cursor.tick + patience_ticks <= known.tick &&
                                  static_cast<double>(cursor.tick) < patience_share * known.tick);
    }

    void note_goals(const Cursor& cursor, const MovementScene& now) {
        const Vec3 at = position_in_scene(now, cursor.state);
        for (std::uint32_t i = 0; i < world_.goals.size(); ++i) {
            const double radius = world_.level->goals[i].radius;
            if ((at - world_.goals[i]).squaredNorm() <= radius * radius && is_faster(cursor, known_.goals[i]))
                keep(cursor, now, no_id, i);
        }
    }

    void keep(const Cursor& cursor, const MovementScene& now, FaceId face, std::uint32_t goal) {
        Found found;
        found.node.state = cursor.state;
        found.node.cell = world_.cell_key(now, cursor.state, cursor.tick);
        found.node.parent = from_;
        found.node.tick = cursor.tick;
        found.node.returns = world_.is_home(now, cursor.state);
        found.first_press = static_cast<std::uint32_t>(harvest_.presses.size());
        found.press_count = cursor.count;
        found.face = face;
        found.goal = goal;
        harvest_.presses.insert(harvest_.presses.end(), cursor.presses.begin(),
                                cursor.presses.begin() + cursor.count);
        harvest_.found.push_back(found);
    }

    // A new way out is walked again with its positions: where ground held last, and where it ended below.
    void note_exit(const Cursor& out) {
        const std::uint64_t spot = exit_spot(out.held_at);
        if (known_.exit_at.contains(spot)) {
            harvest_.exits.emplace_back().spot = spot;
            return;
        }
        const NodeId anchor = last_held();
        std::vector<Press> motion;
        for (NodeId at = from_; at != anchor; at = known_.archive.nodes[at].parent) {
            const ReachNode& one = known_.archive.nodes[at];
            const auto first = known_.archive.presses.begin() + one.first_press;
            motion.insert(motion.begin(), first, first + one.press_count);
        }
        motion.insert(motion.end(), out.presses.begin(), out.presses.begin() + out.count);
        PlayerState state = known_.archive.nodes[anchor].state;
        std::uint32_t tick = known_.archive.nodes[anchor].tick;
        ReachExit exit;
        exit.from = exit.hole = scenes_.to_level(state);
        exit.face = is_held(state) ? state.ground_face : no_id;
        exit.tick = tick;
        exit.node = from_;
        bool over_nothing = false;
        for (const Press& press : motion) {
            for (std::uint16_t k = 0; k < press.ticks; ++k) {
                const MovementScene& now = scenes_.at(tick);
                state = play_tick(now, settings_, state, input_of(press), dt_, world_.start).stepped;
                ++tick;
                if (is_held(state)) {
                    exit.from = scenes_.to_level(state);
                    exit.face = state.ground_face;
                    over_nothing = false;
                } else if (!over_nothing && is_over_nothing(now, state)) {
                    over_nothing = true;
                    exit.hole = scenes_.to_level(state);
                    exit.tick = tick;
                }
            }
        }
        exit.spot = spot;
        exit.first_press = static_cast<std::uint32_t>(harvest_.presses.size());
        exit.press_count = out.count;
        harvest_.presses.insert(harvest_.presses.end(), out.presses.begin(), out.presses.begin() + out.count);
        harvest_.exits.push_back(exit);
    }

    // Where this way began in the air: the node from which it left what held it.
    NodeId last_held() const {
        NodeId at = from_;
        while (!is_held(known_.archive.nodes[at].state) && known_.archive.nodes[at].parent != no_id)
            at = known_.archive.nodes[at].parent;
        return at;
    }

    bool is_over_nothing(const MovementScene& now, const PlayerState& state) const {
        const Vec3 at = position_in_scene(now, state);
        if (now.heightfield != nullptr && terrain_at(*now.heightfield, at.x(), at.z())) return false;
        return !cast_ray(now.collision, at, Vec3(0.0, -1.0, 0.0));
    }

    const ReachWorld& world_;
    const MovementSettings& settings_;
    double dt_;
    bool in_air_;       // jumps start in the air, too
    ButtonSet others_;  // that the settings read beside jump
    // Buttons that a visit presses, or lets go, for a time: ticks after the first moment of a kind.
    enum Moment : std::uint32_t { began, left_ground, topped, met_wall, landed, moments };
    struct Pulse {
        ButtonSet button{};
        std::uint32_t moment = began, delay = 0, length = 0;
    };
    std::array<Pulse, 5> pulses_{};
    std::array<std::uint32_t, moments> came_{};  // [moment] ticks since the visit began; no_id: not yet
    bool pulsed_ = false;
    std::uint32_t flight_;  // ticks of a jump over level ground
    TickScenes& scenes_;
    const ReachKnown& known_;
    NodeId from_;
    bool returns_;
    Harvest& harvest_;
    const TickWatcher* watcher_;
};

}  // namespace

TickScenes::TickScenes(LevelScene& level, double dt) : level_(level), dt_(dt), still_(level) {
    if (level.is_static())
        always_.emplace(still_.at(0, dt));
    else
        kept_.resize(kept);
}

const MovementScene& TickScenes::at(std::uint32_t tick) {
    if (always_) return *always_;
    Kept& one = kept_[tick % kept];
    if (one.tick == tick && one.scene) return *one.scene;
    if (!one.level) one.level = std::make_unique<LevelScene>(level_.for_another_thread());
    one.scene.emplace(one.level->at(tick * dt_, dt_));
    one.tick = tick;
    return *one.scene;
}

std::uint64_t ReachRandom::bits() {
    state_ += 0x9e3779b97f4a7c15ULL;
    std::uint64_t z = state_;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
    return z ^ (z >> 31);
}

std::size_t MovingArea::stage(double time_s) const {
    const double time = period > 0.0 ? std::fmod(time_s, period) : time_s;
    return static_cast<std::size_t>(std::upper_bound(stages.begin(), stages.end(), time) - stages.begin());
}

double MovingArea::until_next(double time_s) const {
    const double time = period > 0.0 ? std::fmod(time_s, period) : time_s;
    const auto next = std::upper_bound(stages.begin(), stages.end(), time);
    if (next != stages.end()) return *next - time;
    return period > 0.0 ? period - time : 0.0;
}

std::size_t ReachWorld::moving_at(const Vec3& position) const {
    const auto holds = [&](const MovingArea& area) {
        return (position.array() >= area.box.min.array()).all() &&
               (position.array() <= area.box.max.array()).all();
    };
    return static_cast<std::size_t>(std::find_if(moving.begin(), moving.end(), holds) - moving.begin());
}

// Two states are one cell where the player could soon do the same: near each other, held alike, their
// velocities less apart than a quarter of a second of steering makes up for.
std::uint64_t ReachWorld::cell_key(const MovementScene& scene, const PlayerState& state,
                                   std::uint32_t tick) const {
    const MovementSettings& settings = level->movement;
    const bool held = is_held(state);
    const Vec3 at = position_in_scene(scene, state);
    const double size = held ? cell_m : 2.0 * cell_m;
    std::uint64_t key = state.grounded ? 1 : state.climbing ? 2 : state.stuck ? 3 : state.hanging ? 5 : 4;
    if (state.crouched) key = mix(key, 6);
    for (int axis = 0; axis < 3; ++axis)
        key = mix(key, grid(at[axis], axis == 1 ? std::min(size, 1.0) : size));
    if (state.grounded || !held) {
        const bool slippery = held && settings.keep_energy && state.ground_surface < scene.surfaces.size() &&
                              scene.surfaces[state.ground_surface].keeps_energy;
        const double steering = slippery               ? settings.slippery_acceleration
                                : held                 ? settings.ground_acceleration
                                : settings.air_control ? settings.air_acceleration
                                                       : 0.0;
        const double apart = std::max({0.25 * steering, 0.5 * settings.walk_speed, 0.5});
        for (const int axis : {0, 2})
            key = mix(key, static_cast<std::uint64_t>(std::llround(state.velocity[axis] / apart)));
        if (!held) key = mix(key, static_cast<std::uint64_t>(std::llround(state.velocity.y() / 4.0)));
        // What is left of the abilities.
        if (state.air_jumps > 0) key = mix(key, 256u + state.air_jumps);
        if (state.dashes > 0) key = mix(key, 512u + state.dashes);
        if (state.move_s > 0.0) key = mix(key, 7);
        if (state.wall_x != 0.0 || state.wall_z != 0.0)
            key = mix(mix(key, grid(state.wall_x, 0.5)), grid(state.wall_z, 0.5));
    }
    if (const std::size_t i = moving_at(at); i < moving.size())
        key = mix(key, (i + 1) * 1024 + moving[i].stage(tick * options.dt));
    return key == 0 ? 1 : key;
}

bool ReachWorld::is_home(const MovementScene& scene, const PlayerState& state) const {
    if (!is_held(state)) return false;
    const Vec3 apart = position_in_scene(scene, state) - home;
    return std::abs(apart.y()) < level->movement.radii.y() &&
           Vec2(apart.x(), apart.z()).squaredNorm() < std::max(1.0, cell_m * cell_m);
}

ButtonSet buttons_at_moments(const MovementSettings& settings) {
    ButtonSet buttons = buttons_read(settings);
    buttons.set(Button::jump, jumps_in_air(settings));
    return buttons;
}

void roll_out(const ReachWorld& world, TickScenes& scenes, const ReachKnown& known, NodeId from,
              std::uint32_t first, std::uint32_t last, Harvest& harvest, const TickWatcher* watcher) {
    Roller roller(world, scenes, known, from, harvest, watcher);
    for (std::uint32_t number = first; number < last; ++number)
        roller.visit_with_buttons(number);
}

}  // namespace slipface
