// A round of a search whose roll-outs are divided among the processes of a team. Every process rolls out its
// visits, sends what they brought, and merges what all brought in the order of one process.
#include <fmt/format.h>

#include "impl.h"
#include "slipface/base/parallel.h"
#include "state_bytes.h"

namespace slipface {
namespace {

void put_harvest(StateWriter& to, const Harvest& harvest) {
    to.put(harvest.steps);
    to.put_list(harvest.presses);
    to.put_list(harvest.reached);
    to.put(std::uint64_t{harvest.found.size()});
    for (const Found& found : harvest.found) {
        put_state(to, found.node.state);
        to.put(found.node.cell);
        to.put(found.node.tick);
        to.put(static_cast<std::uint8_t>(found.node.returns));
        to.put(found.first_press);
        to.put(found.press_count);
        to.put(found.face);
        to.put(found.goal);
    }
    to.put(std::uint64_t{harvest.exits.size()});
    for (const ReachExit& exit : harvest.exits) {
        to.put(exit.from);
        to.put(exit.hole);
        to.put(exit.spot);
        for (const std::uint32_t part : {exit.face, exit.tick, exit.node, exit.first_press})
            to.put(part);
        to.put(exit.press_count);
    }
}

// Appends one visit's harvest to that of its pick, whose lists of inputs then hold those of all its visits.
void get_harvest(StateReader& from, const Level& level, NodeId node, Harvest& harvest) {
    const auto shift = static_cast<std::uint32_t>(harvest.presses.size());
    harvest.steps += from.get<std::uint64_t>();
    for (std::size_t left = from.count(sizeof(Press), "a number of inputs"); left > 0; --left)
        harvest.presses.push_back(
            {from.get<std::uint16_t>(), from.get<std::uint8_t>(), from.get<std::uint8_t>() != 0});
    for (std::size_t left = from.count(sizeof(NodeId), "a number of nodes"); left > 0; --left)
        harvest.reached.push_back(from.get<NodeId>());
    for (std::size_t left = from.count(100, "a number of states"); left > 0; --left) {
        Found& found = harvest.found.emplace_back();
        found.node.state = get_state(from, level);
        found.node.cell = from.get<std::uint64_t>();
        found.node.parent = node;
        found.node.tick = from.get<std::uint32_t>();
        found.node.returns = from.get<std::uint8_t>() & 1u;
        found.first_press = shift + from.get<std::uint32_t>();
        found.press_count = from.get<std::uint32_t>();
        found.face = from.get<FaceId>();
        found.goal = from.get<std::uint32_t>();
    }
    for (std::size_t left = from.count(70, "a number of exits"); left > 0; --left) {
        ReachExit& exit = harvest.exits.emplace_back();
        exit.from = from.vector("an exit");
        exit.hole = from.vector("an exit");
        exit.spot = from.get<std::uint64_t>();
        exit.face = from.get<FaceId>();
        exit.tick = from.get<std::uint32_t>();
        exit.node = from.get<NodeId>();
        exit.first_press = shift + from.get<std::uint32_t>();
        exit.press_count = from.get<std::uint16_t>();
    }
}

}  // namespace

std::vector<Harvest> ReachSearch::Impl::roll_out_in_team(std::span<const Pick> picks, Team& team,
                                                         bool& time_is_over) const {
    const std::size_t visits = picks.empty() ? 0 : picks.front().last - picks.front().first;  // of each
    struct Visit {
        std::size_t pick;
        std::uint32_t number;
    };
    std::vector<Visit> mine;
    for (std::size_t i = 0; i < picks.size() * visits; ++i)
        if (doer_of(i, team.size()) == team.rank())
            mine.push_back({i / visits, picks[i / visits].first + static_cast<std::uint32_t>(i % visits)});
    std::vector<Harvest> brought(mine.size());
    parallel_for(mine.size(), 8, [&](std::size_t begin, std::size_t end) {
        Lease lease(*this);
        for (std::size_t i = begin; i < end; ++i)
            roll_out(world, lease.scenes(), known(), picks[mine[i].pick].node, mine[i].number,
                     mine[i].number + 1, brought[i]);
    });
    StateWriter to;
    to.put(static_cast<std::uint8_t>(time_is_over));
    for (const Harvest& harvest : brought)
        put_harvest(to, harvest);
    const std::vector<std::string> all = team.gather(to.bytes);

    std::vector<StateReader> from(all.begin(), all.end());
    for (std::size_t rank = 0; rank < from.size(); ++rank) {
        const bool over = from[rank].get<std::uint8_t>() != 0;
        if (rank == 0) time_is_over = over;
    }
    std::vector<Harvest> harvests(picks.size());
    for (std::size_t i = 0; i < picks.size() * visits; ++i)
        get_harvest(from[doer_of(i, team.size())], *world.level, picks[i / visits].node,
                    harvests[i / visits]);
    for (std::size_t rank = 0; rank < from.size(); ++rank)
        if (from[rank].problem || !from[rank].at_end())
            team.stop(fmt::format("{} sent a round that cannot be read: {}", team.name_of(rank),
                                  from[rank].problem.value_or("more than it says")));
    return harvests;
}

}  // namespace slipface
