// The mesh doctor: finds what in a level's geometry makes movement go wrong, and says where.
//
// It never changes anything. Distances that decide are fractions of the player's size or of an edge's length,
// so that a level gives the same findings at every scale of player and geometry together.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "slipface/level/level.h"

namespace slipface {

enum class ProblemKind : std::uint8_t {
    t_junction,
    crack,
    sliver,
    duplicate,
    overlap,
    flipped,
    acute_corner,
    slope_limit,
    step_limit,
    orphan,
    missing_texture,
};
inline constexpr std::size_t problem_kind_count = 11;

// One row a kind: the panel's filter and tooltips, `slipface doctor` and its JSON are made from it.
struct ProblemKindInfo {
    ProblemKind kind;
    const char* name;     // "t_junction", in JSON
    const char* label;    // "T-junctions"
    const char* meaning;  // what it is and what it does to a player
    const char* remedy;   // what to do about it, in the modelling tool or here
};
std::span<const ProblemKindInfo> problem_kinds();  // in the order of the enum
const ProblemKindInfo& info_of(ProblemKind kind);

struct Problem {
    ProblemKind kind = ProblemKind::t_junction;
    FaceId face = no_id;   // where it is; no_id for orphans and textures without a face
    FaceId other = no_id;  // the second face of a pair
    Vec3 position = Vec3::Zero();
    std::size_t index = 0;  // of an orphan in Level::orphans, of a texture in Mesh::materials
    std::string text;       // with the numbers that decided
};

struct DoctorReport {
    static constexpr std::size_t max_listed = 2000;  // of each kind; all are counted

    std::vector<Problem> problems;  // by kind, then by face
    std::array<std::size_t, problem_kind_count> counts{};
    bool cancelled = false;  // then the lists are not complete

    std::size_t count(ProblemKind kind) const { return counts[static_cast<std::size_t>(kind)]; }
    std::size_t total() const;
};

// Called from the examining thread with the fraction that is done, in [0, 1]; returning false ends the work
// soon.
using DoctorProgress = std::function<bool(double)>;

// Examines the level's mesh for a player with the level's settings. Reads the texture folder, nothing else.
// Time about linear in the mesh; the same report for any number of threads.
DoctorReport examine(const Level& level, const DoctorProgress& progress = {});

}  // namespace slipface
