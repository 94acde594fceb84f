#include "slipface/doctor/doctor.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "checks.h"

namespace slipface {
namespace {

constexpr ProblemKindInfo kinds[] = {
    {ProblemKind::t_junction, "t_junction", "T-junctions",
     "A corner lies in the middle of another face's edge, so the two faces share no edge. Fill stops there, "
     "and single pixels of the background may show; the player does not catch on it",
     "Give the longer edge a vertex there in the modelling tool", "Player sticks on seams between triangles"},
    {ProblemKind::crack, "crack", "Gaps",
     "Two faces that look like one surface leave a gap narrower than the player. Each entry says what it "
     "does to a player who walks over it",
     "Merge the vertices by distance in the modelling tool, or fill the gap with a face",
     "Player sticks on seams between triangles"},
    {ProblemKind::sliver, "sliver", "Slivers",
     "A triangle is so thin that rounding rotates its normal by 0.2 degrees or more",
     "Dissolve the face or move its corners in the modelling tool",
     "Player sticks on seams between triangles"},
    {ProblemKind::duplicate, "duplicate", "Duplicate faces",
     "Two faces have the same corners and the same front side, or different surface types: it is arbitrary "
     "which type counts. The two sides of a thin object are not reported",
     "Delete one in the modelling tool; here both can be given one type", "Painted faces have no effect"},
    {ProblemKind::overlap, "overlap", "Overlapping faces",
     "Two faces with the same front side overlap in one plane: they flicker, and it is arbitrary which type "
     "counts",
     "Cut or move one in the modelling tool; here both can be given one type",
     "Painted faces have no effect"},
    {ProblemKind::flipped, "flipped", "Flipped faces",
     "The face is wound against its neighbours: one-sided types act on the wrong side of it",
     "Recalculate the normals in the modelling tool",
     "Walls are invisible from outside, or the level looks inside out"},
    {ProblemKind::acute_corner, "acute_corner", "Acute corners",
     "A player who is pushed into the corner cannot leave it in any direction (simulated with the level's "
     "settings)",
     "Fill the corner with an invisible face, or use the analytic push-out", "Player gets stuck in a corner"},
    {ProblemKind::slope_limit, "slope_limit", "Ramps too steep",
     "A ramp from one floor to a higher one is steeper than the maximum slope by at most 5 degrees, or "
     "within "
     "0.1 degrees of it: tried with the level's settings, the player does not get up, or rounding decides",
     "Make it flatter, raise Maximum slope, or give it a type with its own slope limit",
     "Player cannot walk up a slope"},
    {ProblemKind::step_limit, "step_limit", "Steps too high",
     "A stair, kerb or ledge of at most a quarter of the body's height stops the player (simulated with the "
     "level's settings)",
     "Turn on Step up or raise Step height, or make the step lower", "One step of the stairs is too high"},
    {ProblemKind::orphan, "orphan", "Orphans",
     "A painted face is no longer in the file. Its paint is stored until you attach or delete it",
     "Attach it to the face that replaces it, or delete it",
     "Paint is gone after the model was exported again"},
    {ProblemKind::missing_texture, "missing_texture", "Missing textures",
     "The texture of a material does not exist; a checkerboard is drawn instead",
     "Put the image file next to the level, or change the material's map_Kd",
     "Walls are invisible from outside, or the level looks inside out"},
};
static_assert(std::size(kinds) == problem_kind_count);

// Checks that leave no place untried return nothing.
template <auto run>
std::size_t all_tried(const doctor::Patient& patient, doctor::Problems& out) {
    run(patient, out);
    return 0;
}

struct Check {
    std::size_t (*run)(const doctor::Patient&, doctor::Problems&);
    double fraction;                              // of the whole time, roughly
    ProblemKind tries = ProblemKind::t_junction;  // what it leaves untried where there is too much
};
constexpr Check checks[] = {
    {doctor::find_open_edges, 0.2, ProblemKind::crack},
    {all_tried<doctor::find_slivers>, 0.05},
    {all_tried<doctor::find_duplicates>, 0.1},
    {doctor::find_overlaps, 0.3, ProblemKind::overlap},
    {all_tried<doctor::find_flipped>, 0.05},
    {doctor::find_acute_corners, 0.1, ProblemKind::acute_corner},
    {doctor::find_limit_slopes, 0.02, ProblemKind::slope_limit},
    {doctor::find_limit_steps, 0.03, ProblemKind::step_limit},
    {all_tried<doctor::find_orphans>, 0.0},
    {all_tried<doctor::find_missing_textures>, 0.0},
};
constexpr double preparation = 0.15;

}  // namespace

std::span<const ProblemKindInfo> problem_kinds() {
    return kinds;
}

const ProblemKindInfo& info_of(ProblemKind kind) {
    return kinds[static_cast<std::size_t>(kind)];
}

std::size_t DoctorReport::total() const {
    return std::accumulate(counts.begin(), counts.end(), std::size_t{0});
}

DoctorReport examine(const Level& level, const DoctorProgress& progress) {
    DoctorReport report;
    if (!level.mesh) return report;
    const auto go_on = [&](double fraction) { return !progress || progress(std::min(1.0, fraction)); };
    report.cancelled = !go_on(0.0);
    if (report.cancelled) return report;
    const doctor::Topology topology(*level.mesh);
    const ResolvedSurfaces resolved = resolve_surfaces(level);
    doctor::WorldOnDemand world(level);
    std::size_t effort = 0;
    const doctor::Patient patient{level, *level.mesh, topology, resolved, world, effort};

    double done = preparation;
    std::vector<Problem> found;
    for (const Check& check : checks) {
        report.cancelled = !go_on(done);
        if (report.cancelled) break;
        report.untried[static_cast<std::size_t>(check.tries)] += check.run(patient, found);
        done += check.fraction;
    }
    std::stable_sort(found.begin(), found.end(),
                     [](const Problem& a, const Problem& b) { return a.kind < b.kind; });
    for (Problem& problem : found) {
        std::size_t& count = report.counts[static_cast<std::size_t>(problem.kind)];
        if (++count <= DoctorReport::max_listed) report.problems.push_back(std::move(problem));
    }
    if (!report.cancelled) go_on(1.0);
    return report;
}

namespace doctor {

const CollisionWorld& WorldOnDemand::get() {
    if (!world_) {
        Result<CollisionWorld> world = build_collision_world(level_);
        world_ = world ? std::move(*world) : CollisionWorld();
    }
    return *world_;
}

std::size_t Patient::effort_among_many(std::size_t queries, const Aabb& box) const {
    constexpr std::size_t usual = 128;  // triangles
    return queries * world().crowd_in(box) / usual;
}

std::string metres(double value) {
    if (std::abs(value) < 0.01) return fmt::format("{:.2f} mm", value * 1000.0);
    if (std::abs(value) < 1.0) return fmt::format("{:.1f} cm", value * 100.0);
    return fmt::format("{:.2f} m", value);
}

std::string degrees(double radians) {
    return fmt::format("{:.2f}\u00b0", radians * 57.29577951308232);
}

}  // namespace doctor
}  // namespace slipface
