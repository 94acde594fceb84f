// A shorter way of one that was found: a cell keeps the state that came first but for a twentieth, so a way
// is a few per cent longer than it must be. Some of its ticks are changed at random, each change is played
// from the start by step itself, and what reaches the goal no later is kept.
#include <algorithm>

#include "impl.h"

namespace slipface {
namespace {

constexpr std::size_t max_steps = 12'000'000, idle_trials = 10'000;  // without a shorter way

using Ticks = std::vector<Press>;  // of one tick each

double cross(const Vec2& a, const Vec2& b) {
    return a.x() * b.y() - a.y() * b.x();
}

// As near to `way` as two neighbouring directions of the stick, one after the other, lead.
void lead(const Vec2& way, std::span<Press> ticks) {
    const std::uint32_t first = stick_towards(way) % press_directions;
    const std::uint32_t second =
        cross(direction_vector(first), way) > 0.0 ? first + 1 : first + press_directions - 1;
    const Vec2 a = direction_vector(first), b = direction_vector(second);
    const double of_a = cross(way, b) / cross(a, b), of_b = cross(a, way) / cross(a, b);
    const auto turn =
        static_cast<std::size_t>(static_cast<double>(ticks.size()) * of_a / std::max(of_a + of_b, 1e-9));
    for (std::size_t i = 0; i < ticks.size(); ++i)
        ticks[i].stick = full_stick(i < turn ? first : second);
}

class Hurry {
  public:
    Hurry(const ReachWorld& world, TickScenes& scenes, const PlayerState& begin, std::size_t goal)
        : world_(world), scenes_(scenes), begin_(begin), goal_(goal), random_(world.options.seed) {}

    // No longer than `best`, which reaches the goal.
    Ticks run(Ticks best) {
        if (!reaches(best, best.size(), played_)) return best;
        Played played;
        const double within = world_.level->goals[goal_].within_s.value_or(0.0) / world_.options.dt;
        for (std::size_t idle = 0; steps_ < max_steps && idle < idle_trials; ++idle) {
            if (static_cast<double>(best.size()) <= within) break;
            Ticks other = best;
            if (!change(other) || !reaches(other, best.size(), played)) continue;
            if (other.size() < best.size()) idle = 0;
            best.swap(other);
            std::swap(played_, played);
        }
        return best;
    }
    // Where run() ended, for the proof.
    const PlayerState& end() const { return played_.end; }

  private:
    struct Played {
        std::vector<Vec3> at;  // where each tick begins, and the end; scene coordinates
        PlayerState end;
    };

    // Ends `ticks` where it reaches the goal; false: not in `limit` ticks. The last input goes on.
    bool reaches(Ticks& ticks, std::size_t limit, Played& played) {
        if (ticks.empty()) return false;
        std::vector<Vec3>& at = played.at;
        PlayerState& state = played.end;
        state = begin_;
        const double radius = world_.level->goals[goal_].radius;
        at.assign(1, position_in_scene(scenes_.at(0), state));
        ticks.resize(std::max(limit, ticks.size()), ticks.back());
        for (std::uint32_t tick = 0; tick < limit; ++tick) {
            const MovementScene& now = scenes_.at(tick);
            const TickResult result = play_tick(now, world_.level->movement, state, input_of(ticks[tick]),
                                                world_.options.dt, world_.start);
            ++steps_;
            if (result.respawn != Respawn::none) return false;
            state = result.state;
            at.push_back(position_in_scene(now, state));
            if ((at.back() - world_.goals[goal_]).squaredNorm() > radius * radius) continue;
            ticks.resize(tick + 1);
            return true;
        }
        return false;
    }

    // False: this one changes nothing.
    bool change(Ticks& ticks) {
        const auto draw = [&](std::size_t count) { return random_.below(static_cast<std::uint32_t>(count)); };
        const std::size_t first = draw(ticks.size());
        const std::size_t count = std::min<std::size_t>(1 + draw(2U << draw(12)), ticks.size() - first);
        const std::span<Press> some = std::span(ticks).subspan(first, count);
        const auto place = [&](std::size_t i) { return ticks.begin() + static_cast<std::ptrdiff_t>(i); };
        switch (draw(4)) {
            case 0: {  // straight to where they end, in fewer
                const auto differs = [&](const Press& one) { return one.buttons != some.front().buttons; };
                if (std::ranges::any_of(some, differs)) return false;
                const Vec3& to =
                    first + count == ticks.size() ? world_.goals[goal_] : played_.at[first + count];
                const Vec3 way = to - played_.at[first];
                const std::size_t less = draw(1 + count / 8);
                lead({way.x(), way.z()}, some.first(count - less));
                ticks.erase(place(first + count - less), place(first + count));
                return true;
            }
            case 1:  // without them
                ticks.erase(place(first), place(first + count));
                return true;
            case 2: {  // turned
                const std::uint32_t by = press_directions - 3 + draw(7);
                for (Press& one : some)
                    one.stick = full_stick(one.stick % press_directions + by);
                return true;
            }
            default: {  // what comes before or after them comes later or sooner
                const Press kept = draw(2) == 0 ? some.front() : some.back();
                const std::size_t to = draw(ticks.size());
                ticks.erase(place(first));
                ticks.insert(place(std::min(to, ticks.size())), kept);
                return true;
            }
        }
    }

    const ReachWorld& world_;
    TickScenes& scenes_;
    const PlayerState& begin_;
    std::size_t goal_;
    ReachRandom random_;
    Played played_;  // the best one
    std::size_t steps_ = 0;
};

}  // namespace

std::optional<Tape> ReachSearch::hurried_tape_to(std::size_t goal) const {
    const Reached& reached = impl_->goals[goal];
    if (!reached.found()) return std::nullopt;
    Ticks ticks;
    for (const Press& press : impl_->archive.way_to(reached.node))
        ticks.insert(ticks.end(), press.ticks, {1, press.stick, press.buttons});
    Impl::Lease lease(*impl_);
    Hurry hurry(impl_->world, lease.scenes(), impl_->archive.nodes.front().state, goal);
    const Ticks shorter = hurry.run(std::move(ticks));
    return impl_->checked_tape(shorter, &hurry.end());
}

}  // namespace slipface
