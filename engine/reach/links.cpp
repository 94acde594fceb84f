// Passages between regions of walkable faces, found along the archive's ways and by rolling out anew.
#include "slipface/reach/links.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "impl.h"
#include "slipface/base/parallel.h"
#include "slipface/sim/reach.h"

namespace slipface {
namespace {

constexpr std::uint32_t link_visits = 72;     // of a node: the systematic ones, and as many by chance
constexpr std::size_t nodes_per_column = 6;   // of one region
constexpr std::size_t max_rolled_out = 3000;  // nodes
constexpr double least_column_m = 2.0, largest_column_m = 8.0;

struct Arrival {
    std::uint32_t from = no_id, to = no_id;
    LinkKind kind = LinkKind::walk;
    std::uint32_t ticks = 0;  // since `from` held the player last
    auto key() const { return std::tuple(from, to, kind); }
};

// What the player did since a region held it last.
struct Passage {
    std::uint32_t from = no_id;
    std::uint32_t ticks = 0;
    bool flew = false, jumped = false, jumped_in_air = false, jumped_off_wall = false, dashed = false,
         crawled = false, hung = false, climbed = false, rode = false;
    double rise = 0.0;  // m/s, after the last tick

    std::optional<Arrival> tick(const PlayerState& state, std::uint32_t region) {
        ++ticks;
        dashed |= state.move_s > 0.0 && !state.hanging;
        crawled |= state.crouched && state.grounded;
        std::optional<Arrival> arrival;
        if (region != no_id) {
            if (from != no_id && region != from) arrival = {from, region, kind(), ticks};
            *this = {.from = region};
        } else if (is_held(state)) {
            rode |= state.ground_platform != no_id;
            climbed |= state.climbing || state.stuck;
            hung |= state.hanging;
        } else {
            flew = true;
            jumped_in_air |= state.air_jumps > 0;
            jumped_off_wall |= state.wall_x != 0.0 || state.wall_z != 0.0;
            jumped |= state.jumping || (rise < 0.0 && state.velocity.y() > 0.0);  // or was thrown up
        }
        rise = state.velocity.y();
        return arrival;
    }
    LinkKind kind() const {
        return rode              ? LinkKind::ride
               : climbed         ? LinkKind::climb
               : hung            ? LinkKind::ledge
               : dashed          ? LinkKind::dash
               : jumped_off_wall ? LinkKind::wall_jump
               : jumped_in_air   ? LinkKind::air_jump
               : jumped          ? LinkKind::jump
               : flew            ? LinkKind::drop
               : crawled         ? LinkKind::crawl
                                 : LinkKind::walk;
    }
};

// A way that ends with an arrival: to a node and so many ticks of these inputs.
struct Proposal {
    Arrival arrival;
    std::uint32_t tick = 0;  // of the arrival
    NodeId node = no_id;
    std::vector<Press> presses;
};
using Proposals = std::map<std::tuple<std::uint32_t, std::uint32_t, LinkKind>, Proposal>;

// Keeps the faster; of equals the one that comes sooner after the start, then the first.
void propose(Proposals& to, Proposal&& one) {
    const auto [at, is_new] = to.try_emplace(one.arrival.key(), one);
    const auto rank = [](const Proposal& of) { return std::pair(of.arrival.ticks, of.tick); };
    if (!is_new && rank(one) < rank(at->second)) at->second = std::move(one);
}

std::uint32_t ticks_of(std::span<const Press> presses) {
    std::uint32_t ticks = 0;
    for (const Press& press : presses)
        ticks += press.ticks;
    return ticks;
}

std::vector<Press> first_ticks(std::span<const Press> presses, std::uint32_t ticks) {
    std::vector<Press> first;
    for (const Press& press : presses) {
        if (ticks == 0) break;
        first.push_back(press);
        first.back().ticks = static_cast<std::uint16_t>(std::min<std::uint32_t>(press.ticks, ticks));
        ticks -= first.back().ticks;
    }
    return first;
}

}  // namespace

class ReachSearch::Impl::LinkFinder {
  public:
    explicit LinkFinder(const Impl& impl)
        : impl_(impl), archive_(impl.archive), regions_(walk_regions(*impl.world.level)) {}

    ReachLinks find() {
        const std::vector<NodeId> crossed = crossings(), near = nodes_near_others();
        std::vector<Proposals> proposals(crossed.size() + near.size());
        parallel_for(proposals.size(), 4, [&](std::size_t begin, std::size_t end) {
            Lease lease(impl_);
            for (std::size_t i = begin; i < end; ++i)
                i < crossed.size() ? follow(crossed[i], lease.scenes(), proposals[i])
                                   : roll(near[i - crossed.size()], lease.scenes(), proposals[i]);
        });
        Proposals best;
        for (Proposals& some : proposals)
            for (auto& [key, one] : some)
                propose(best, std::move(one));
        std::vector<const Proposal*> list;
        for (const auto& [key, one] : best)
            list.push_back(&one);
        std::vector<std::optional<ReachLink>> proved(list.size());
        parallel_for(list.size(), 1, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i)
                proved[i] = prove(*list[i]);
        });
        ReachLinks links;
        for (std::optional<ReachLink>& link : proved)
            if (link) links.links.push_back(std::move(*link));
        for (ReachLink& link : links.links)
            link.two_way = std::any_of(links.links.begin(), links.links.end(), [&](const ReachLink& other) {
                return other.from == link.to && other.to == link.from;
            });
        links.regions = std::move(regions_);
        return links;
    }

  private:
    std::uint32_t region_of(NodeId node) const { return regions_.of(archive_.nodes[node].state); }

    // The node or the nearest before it that stands in a region; else the start.
    NodeId anchor_of(NodeId node) const {
        while (region_of(node) == no_id && archive_.nodes[node].parent != no_id)
            node = archive_.nodes[node].parent;
        return node;
    }

    std::span<const Press> presses_of(NodeId node) const {
        return std::span(archive_.presses)
            .subspan(archive_.nodes[node].first_press, archive_.nodes[node].press_count);
    }

    // Plays inputs from a node on; `each` gets the state after every tick.
    template <class Each>
    void play(NodeId from, std::span<const Press> presses, TickScenes& scenes, const Each& each) const {
        PlayerState state = archive_.nodes[from].state;
        std::uint32_t tick = archive_.nodes[from].tick;
        for (const Press& press : presses) {
            for (std::uint16_t i = 0; i < press.ticks; ++i) {
                state = play_tick(scenes.at(tick), impl_.world.level->movement, state, input_of(press),
                                  impl_.world.options.dt, impl_.world.start)
                            .state;
                ++tick;
                each(state);
            }
        }
    }

    // What the player is in the middle of at a node.
    Passage passage_at(NodeId node, TickScenes& scenes) const {
        const NodeId anchor = anchor_of(node);
        std::vector<Press> motion;
        for (NodeId at = node; at != anchor; at = archive_.nodes[at].parent)
            motion.insert(motion.begin(), presses_of(at).begin(), presses_of(at).end());
        Passage passage{.from = region_of(anchor)};
        play(anchor, motion, scenes,
             [&](const PlayerState& state) { passage.tick(state, regions_.of(state)); });
        return passage;
    }

    // Nodes in another region than the one that their way came from.
    std::vector<NodeId> crossings() const {
        std::vector<NodeId> list;
        for (NodeId node = 1; node < archive_.nodes.size(); ++node) {
            const std::uint32_t region = region_of(node);
            if (region == no_id) continue;
            const std::uint32_t before = region_of(anchor_of(archive_.nodes[node].parent));
            if (before != no_id && before != region) list.push_back(node);
        }
        return list;
    }

    void follow(NodeId node, TickScenes& scenes, Proposals& to) const {
        const NodeId parent = archive_.nodes[node].parent;
        Passage passage = passage_at(parent, scenes);
        std::uint32_t ticks = 0;
        play(parent, presses_of(node), scenes, [&](const PlayerState& state) {
            ++ticks;
            if (const auto arrival = passage.tick(state, regions_.of(state)))
                propose(to, {*arrival, archive_.nodes[parent].tick + ticks, parent,
                             first_ticks(presses_of(node), ticks)});
        });
    }

    // Nodes from which a jump may lead into another region: a few of each region in each column of the level
    // beside which there is another, and of all that is neither ground nor air.
    std::vector<NodeId> nodes_near_others() const {
        const double jump =
            measure_reach(impl_.world.level->movement, impl_.world.options.dt).running.distance_m;
        const double size = std::clamp(0.5 * jump, least_column_m, largest_column_m);
        using Column = std::pair<std::int64_t, std::int64_t>;
        const auto column_of = [&](NodeId node) {
            const Vec3 at = impl_.scene.to_level(archive_.nodes[node].state);
            return Column(std::llround(at.x() / size), std::llround(at.z() / size));
        };
        std::map<Column, std::map<std::uint32_t, std::size_t>> taken;  // [column][region]
        const auto stands = [&](NodeId node) {
            const ReachNode& one = archive_.nodes[node];
            return one.is_cell && !one.superseded && is_held(one.state);
        };
        for (NodeId node = 0; node < archive_.nodes.size(); ++node)
            if (stands(node)) taken[column_of(node)].emplace(region_of(node), 0);
        const auto has_others = [&](const Column& column, std::uint32_t region) {
            for (std::int64_t x = -1; x <= 1; ++x)
                for (std::int64_t z = -1; z <= 1; ++z) {
                    const auto beside = taken.find({column.first + x, column.second + z});
                    if (beside == taken.end()) continue;
                    if (beside->second.size() > 1 || beside->second.begin()->first != region) return true;
                }
            return false;
        };
        std::vector<NodeId> list;
        for (NodeId node = 0; node < archive_.nodes.size(); ++node) {
            if (!stands(node)) continue;
            const std::uint32_t region = region_of(node);
            const Column column = column_of(node);
            std::size_t& count = taken[column][region];
            if (count >= nodes_per_column || !has_others(column, region)) continue;
            ++count;
            list.push_back(node);
        }
        if (list.size() <= max_rolled_out) return list;
        std::vector<NodeId> some;
        for (std::size_t i = 0; i < max_rolled_out; ++i)
            some.push_back(list[i * list.size() / max_rolled_out]);
        return some;
    }

    void roll(NodeId node, TickScenes& scenes, Proposals& to) const {
        const Passage first = passage_at(node, scenes);
        Passage passage = first;
        std::uint32_t played = 0;
        // Roll-outs branch: where a tick does not follow the one before, what led to it is played again.
        // prove() has the last word on every proposal.
        const TickWatcher watch = [&](const MovementScene&, const PlayerState& state,
                                      std::span<const Press> presses, std::uint32_t tick) {
            const std::uint32_t ticks = ticks_of(presses);
            if (ticks != played + 1) {
                passage = first;
                play(node, first_ticks(presses, ticks - 1), scenes,
                     [&](const PlayerState& one) { passage.tick(one, regions_.of(one)); });
            }
            played = ticks;
            if (const auto arrival = passage.tick(state, regions_.of(state)))
                propose(to, {*arrival, tick, node, {presses.begin(), presses.end()}});
        };
        Harvest ignored;
        const bool pairs = buttons_at_moments(impl_.world.level->movement).bits != 0;
        roll_out(impl_.world, scenes, impl_.known(), node, 0, pairs ? 2 * link_visits : link_visits, ignored,
                 &watch);
    }

    // The whole way once more, from the start: what it says is what counts.
    std::optional<ReachLink> prove(const Proposal& one) const {
        std::vector<Press> motion = archive_.way_to(one.node);
        motion.insert(motion.end(), one.presses.begin(), one.presses.end());
        ReachLink link;
        link.tape = impl_.empty_tape();
        for (const Press& press : motion)
            for (std::uint32_t i = 0; i < press.ticks; ++i)
                append_tick(link.tape, input_of(press));
        SimulationOptions options;
        options.keep_states = true;
        const Lease lease(impl_);
        const SimulationReport report =
            simulate(lease.scene(), impl_.world.level->movement, impl_.start, link.tape, options);
        std::optional<Arrival> arrival;
        Passage passage;
        for (const PlayerState& state : report.states)
            arrival = passage.tick(state, regions_.of(state));
        if (!arrival || arrival->key() != one.arrival.key()) return std::nullopt;
        link.tape.end_hash = report.end_hash;
        link.begin_tick = report.states.size() - arrival->ticks;
        const PlayerState& left = report.states[link.begin_tick - 1];
        const PlayerState& landed = report.states.back();
        const auto down = [&](const PlayerState& state) {
            return Vec3(0.0, -body_radii(impl_.world.level->movement, state).y(), 0.0);
        };
        std::tie(link.from, link.to, link.kind) = arrival->key();
        link.from_face = left.ground_face;
        link.to_face = landed.ground_face;
        link.begin = impl_.scene.to_level(left) + down(left);
        link.end = impl_.scene.to_level(landed) + down(landed);
        link.velocity = motion_velocity(left);
        link.time_s = arrival->ticks * impl_.world.options.dt;
        return link;
    }

    const Impl& impl_;
    const ReachArchive& archive_;
    WalkRegions regions_;
};

ReachLinks ReachSearch::links() const {
    return Impl::LinkFinder(*impl_).find();
}

}  // namespace slipface
