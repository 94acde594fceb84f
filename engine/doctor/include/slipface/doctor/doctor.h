// The mesh doctor: finds geometry in a level that causes problems for movement, and reports its location.
//
// It changes nothing. Thresholds are fractions of the player's size or of an edge's length, so that scaling
// the player and the geometry together does not change the findings.
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

// One row per kind, for the panel's filter and tooltips, `slipface doctor` and its JSON.
struct ProblemKindInfo {
    ProblemKind kind;
    const char* name;     // "t_junction", in JSON
    const char* label;    // "T-junctions"
    const char* meaning;  // what it is and how it affects a player
    const char* remedy;   // how to fix it, in the modelling tool or in Slipface
    const char* symptom;  // the title of its section in docs/symptoms.md
};
std::span<const ProblemKindInfo> problem_kinds();  // in the order of the enum
const ProblemKindInfo& info_of(ProblemKind kind);

struct Problem {
    ProblemKind kind = ProblemKind::t_junction;
    FaceId face = no_id;   // the face that has it; no_id for orphans and textures without a face
    FaceId other = no_id;  // the second face of a pair
    Vec3 position = Vec3::Zero();
    std::size_t index = 0;  // of an orphan in Level::orphans, of a texture in Mesh::materials
    std::string text;       // a sentence with the measured values
};

struct DoctorReport {
    static constexpr std::size_t max_listed = 2000;  // per kind; `counts` includes the others

    std::vector<Problem> problems;  // by kind, then by face
    std::array<std::size_t, problem_kind_count> counts{};
    // Places that could have such a problem, but there are too many to try: gaps, corners, ramps and steps
    // where no walker was sent, and triangles and open edges not compared with all near them.
    std::array<std::size_t, problem_kind_count> untried{};
    bool cancelled = false;  // true: the lists are not complete

    std::size_t count(ProblemKind kind) const { return counts[static_cast<std::size_t>(kind)]; }
    std::size_t untried_of(ProblemKind kind) const { return untried[static_cast<std::size_t>(kind)]; }
    std::size_t total() const;
};

// Called from the examining thread with the fraction done, in [0, 1]. Returning false cancels the work soon.
using DoctorProgress = std::function<bool(double)>;

// Examines the level's mesh for a player with the level's settings. Of the disk it reads only the texture
// folder. The time is about linear in the size of the mesh: where very many edges lie within a body's width
// of each other, not all pairs of them are compared. The report does not depend on the number of threads.
DoctorReport examine(const Level& level, const DoctorProgress& progress = {});

}  // namespace slipface
