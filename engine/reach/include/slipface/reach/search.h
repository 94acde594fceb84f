// Where the player gets from a start, found by step() itself: an archive of cells, each with the state that
// reached it fastest, and rounds that roll inputs out from the cells that promise most. Every yes is a tape;
// a no says how far the search went (docs/reach.md).
//
// The same level, settings, seed and number of rounds give the same bytes for any number of threads.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "slipface/base/progress.h"
#include "slipface/level/level_scene.h"
#include "slipface/reach/archive.h"
#include "slipface/sim/simulate.h"

namespace slipface {

struct ReachLinks;  // slipface/reach/links.h
class Team;         // slipface/base/team.h

struct ReachOptions {
    std::uint64_t seed = 1;
    double dt = 1.0 / 60.0;
    std::string dt_text = "1/60";
    double cell_m = 0.0;  // edge of a cell, metres; 0: by the size of the player and of the level
};

// The fastest way found to something: the node that stands there.
struct Reached {
    NodeId node = no_id;
    std::uint32_t tick = 0;
    bool found() const { return node != no_id; }
};

// Where players leave the level: the spot of the last ground, and where there is no ground any more below.
struct ReachExit {
    Vec3 from = Vec3::Zero();  // last position held by ground, in the level's coordinates
    Vec3 hole = Vec3::Zero();  // first position after it above nothing
    FaceId face = no_id;       // last face stood on
    std::uint32_t tick = 0;    // of `hole`
    std::uint32_t times = 0;   // left here
    NodeId node = no_id;       // its way, and `presses` after it, lead out
    std::uint32_t first_press = 0;
    std::uint16_t press_count = 0;
    std::uint64_t spot = 0;
};

// One round, for the curve that says whether a search still finds anything.
struct ReachRound {
    std::uint64_t steps = 0;
    std::uint32_t cells = 0, faces = 0;  // new ones
};

class ReachSearch;
struct ReachLimits {
    std::optional<std::uint64_t> rounds;  // in all, those of a resumed search included
    double seconds = 0.0;                 // from now on; 0: no limit
    bool until_goals = false;             // ends when every goal to be reached is, and none must never be
    double late = 1.0;                    // times Goal::within_s: then it is reached for `until_goals`
    // Processes that search together: each runs the same search and rolls out its part of every round. The
    // bytes are those of one process; rank 0 decides when the seconds are over.
    Team* team = nullptr;
    // Called after each round: to store the search. In a team by rank 0 alone.
    std::function<void(const ReachSearch&)> after_round = {};
};

class ReachSearch {
  public:
    // From `start`, in the level's coordinates, under level.movement. `level` must outlive the search and
    // stay where it is and as it is.
    static Result<ReachSearch> begin(const Level& level, const Vec3& start, const ReachOptions& options);
    // One that store() has written, if `level` and its settings are those that it ran in. Every byte of the
    // file is checked; an error names what was found and what was expected.
    static Result<ReachSearch> resume(const Level& level, const std::filesystem::path& path);
    Status store(const std::filesystem::path& path) const;
    // The same from the bytes of such a file. Errors name `location`.
    static Result<ReachSearch> resume_text(const Level& level, std::string_view text,
                                           const std::string& location);
    // Of all that the search depends on: geometry, types, platforms, settings and program, but not start and
    // options.
    std::uint64_t identity() const;

    ReachSearch(ReachSearch&&) noexcept;
    ReachSearch& operator=(ReachSearch&&) noexcept;
    ~ReachSearch();

    // Rounds until a limit is met, the search is cancelled, or nothing is left to try.
    void run(const ReachLimits& limits, Progress* progress = nullptr);
    bool exhausted() const;
    bool goals_reached(double late = 1.0) const;  // as ReachLimits::until_goals asks

    const Level& level() const;
    const ReachOptions& options() const;
    const Vec3& start() const;  // in the level's coordinates
    double cell_m() const;
    const ReachArchive& archive() const;
    const std::vector<Reached>& faces() const;      // [face of the mesh]
    const std::vector<Reached>& goals() const;      // [goal of the level], by position and radius alone
    const std::vector<ReachExit>& exits() const;    // in the order in which they were found
    const std::vector<ReachRound>& rounds() const;  // all so far
    std::uint64_t steps() const;
    std::uint64_t hash() const;  // of all that was found

    // The inputs that lead to a node, and some after it; replayed and compared with what the search holds, so
    // nothing is a proof that does not repeat. Nothing if it does not.
    std::optional<Tape> tape_to(NodeId node) const;
    // A way to a goal, shortened from the one that was found: within a per cent of the shortest where that is
    // known. Nothing: the goal was not reached. Takes some seconds.
    std::optional<Tape> hurried_tape_to(std::size_t goal) const;
    Tape tape_of(const ReachExit& exit) const;
    Vec3 position_of(NodeId node) const;  // in the level's coordinates

    // Where players stood on what does not move, at most `count` places: of all places a cell apart each has
    // the same chance. The level's coordinates.
    std::vector<Vec3> standing_places(std::size_t count) const;

    // The held state nearest to a point of the level, by the centre or by the lowest point of the player.
    struct Near {
        NodeId node = no_id;
        double distance_m = 0.0;
    };
    Near nearest(const Vec3& point) const;

    // How near the player came to a face or a point: rolls out anew from the states nearest to it and
    // measures at every tick how far the ellipsoid stays away.
    struct Miss {
        double distance_m = 0.0;
        FaceId from = no_id;  // last face stood on before
        Tape tape;            // up to the tick that came nearest
    };
    std::optional<Miss> nearest_miss_of_face(FaceId face) const;
    std::optional<Miss> nearest_miss_of_point(const Vec3& point, double radius) const;

    // From each region to others: what the search passed, and what is found anew from where regions are near
    // to each other. Every link was replayed.
    ReachLinks links() const;

  private:
    struct Impl;
    explicit ReachSearch(std::unique_ptr<Impl> impl);
    std::unique_ptr<Impl> impl_;
};

// Faces that a player could stand on: solid, not hazardous, no steeper than their surface allows.
std::vector<FaceId> walkable_faces(const Level& level);

}  // namespace slipface
