// What a search keeps beside its archive.
#pragma once

#include <mutex>
#include <span>
#include <unordered_map>

#include "roll_out.h"
#include "slipface/base/team.h"
#include "slipface/reach/search.h"

namespace slipface {

struct ReachSearch::Impl {
    explicit Impl(LevelScene built) : scene(std::move(built)) {}

    struct Pick {
        NodeId node;
        std::uint32_t first, last;  // visits
        std::size_t cost;
    };
    Status prepare(const Level& level, const Vec3& start, const ReachOptions& options);
    // One round. With a team, of its part of the roll-outs. False: rank 0's time is over (`time_is_over` of
    // others is ignored).
    bool round(Team* team, bool time_is_over);
    std::vector<Pick> pick_nodes();
    std::vector<Harvest> roll_out_all(std::span<const Pick> picks) const;
    std::vector<Harvest> roll_out_in_team(std::span<const Pick> picks, Team& team, bool& time_is_over) const;
    void merge(const Harvest& harvest, NodeId from, ReachRound& news, bool& productive);
    void enqueue(NodeId node, std::size_t cost);
    std::size_t face_of(const PlayerState& state) const;
    std::size_t first_cost(const PlayerState& state) const;
    bool goals_reached(double late) const;
    // Hash of everything that a search depends on: geometry, types, platforms, settings, start, options,
    // program.
    std::uint64_t identity() const;
    std::string body() const;
    Status read_body(std::string_view bytes, const std::string& location);
    Tape empty_tape() const;
    std::optional<Tape> checked_tape(std::span<const Press> motion, const PlayerState* expected) const;
    std::optional<Miss> nearest_miss(const std::function<double(const Vec3&)>& distance) const;
    std::vector<NodeId> nearest_nodes(const std::function<double(const Vec3&)>& distance,
                                      std::size_t count) const;
    ReachKnown known() const { return {archive, faces, goals, exit_at}; }

    // A scene for the thread that asks; those of a level that moves are used again.
    class Lease;
    class LinkFinder;

    mutable LevelScene scene;
    ReachWorld world;
    Vec3 start = Vec3::Zero();
    ReachArchive archive;
    std::vector<Reached> faces, goals;
    std::vector<ReachExit> exits;
    std::unordered_map<std::uint64_t, std::uint32_t> exit_at;
    std::vector<ReachRound> rounds;
    std::uint64_t steps = 0;
    std::vector<std::uint32_t> face_cells;   // [face, then all else] cells on or at it
    std::vector<std::vector<NodeId>> queue;  // [cost] nodes to roll out from, the first ones first
    std::vector<std::size_t> queue_begin;    // [cost] of them that were taken
    mutable std::mutex mutex;
    struct OwnScenes {  // what a thread needs of a level that moves
        explicit OwnScenes(LevelScene own, double dt) : level(std::move(own)), scenes(level, dt) {}
        LevelScene level;
        TickScenes scenes;
    };
    mutable std::vector<std::unique_ptr<OwnScenes>> spare;
};

// Lives as long as the thread works on it.
class ReachSearch::Impl::Lease {
  public:
    explicit Lease(const Impl& impl);
    ~Lease();
    Lease(const Lease&) = delete;
    Lease& operator=(const Lease&) = delete;
    TickScenes& scenes() { return own_->scenes; }
    const TickScene& scene() const { return own_->scenes.still(); }

  private:
    const Impl& impl_;
    std::unique_ptr<OwnScenes> own_;
};

}  // namespace slipface
