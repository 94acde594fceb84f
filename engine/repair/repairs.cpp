#include "slipface/repair/repairs.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "mesh_edits.h"
#include "slipface/doctor/doctor.h"
#include "slipface/mesh/build.h"

namespace slipface {
namespace {

// Of the body's largest radius: how far around a stop the doctor looks.
constexpr double looked_at = 6.0;
// Steps up to this high are slips of the modelling tool; higher ones are meant.
constexpr double highest_slip_m = 0.05;

// The faces around a place as a level of their own.
struct Part {
    Level level;
    std::vector<FaceId> face;  // [face of the part] of the whole
};

std::optional<Part> part_around(const Level& level, const Vec3& centre, double half) {
    const Mesh& mesh = *level.mesh;
    const ResolvedSurfaces resolved = resolve_surfaces(level);
    Part part;
    PolygonSoup soup;
    soup.face_first_corner = {0};
    soup.materials = mesh.materials;
    soup.groups = mesh.groups;
    for (FaceId face = 0; face < mesh.face_count(); ++face) {
        Aabb box;
        const std::uint32_t first = mesh.face_first_corner[face], last = mesh.face_first_corner[face + 1];
        for (std::uint32_t corner = first; corner < last; ++corner)
            box.add(mesh.corner_position(corner).cast<double>());
        if (((box.min - centre).array() > half).any() || ((centre - box.max).array() > half).any()) continue;
        for (std::uint32_t corner = first; corner < last; ++corner)
            soup.corner_position.push_back(mesh.corner_position(corner));
        soup.face_first_corner.push_back(static_cast<std::uint32_t>(soup.corner_position.size()));
        soup.face_material.push_back(mesh.face_material[face]);
        soup.face_group.push_back(mesh.face_group[face]);
        part.face.push_back(face);
        part.level.overrides.emplace_back(resolved.surface[face]);
    }
    if (part.face.empty()) return std::nullopt;
    const Result<MeshPtr> built = build_mesh(std::move(soup));
    if (!built) return std::nullopt;
    part.level.mesh = *built;
    part.level.mesh_path = level.mesh_path;
    part.level.surfaces = level.surfaces;
    part.level.movement = level.movement;
    return part;
}

Cure repair(std::string text, Mesh mesh, const Vec3& position, double change) {
    Cure cure;
    cure.text = std::move(text);
    cure.button = "Show";
    cure.mesh = std::make_shared<const Mesh>(std::move(mesh));
    cure.position = position;
    cure.bluntness = 1;
    cure.change = change;
    return cure;
}

std::optional<Cure> repair_of(const Level& level, const Problem& problem, const StoryNames& names) {
    const Mesh& mesh = *level.mesh;
    const double radius = std::min(level.movement.radii.x(), level.movement.radii.z());
    switch (problem.kind) {
        case ProblemKind::crack: {
            Mesh changed = mesh;
            const double moved =
                close_gap(changed, problem.face, problem.other, problem.position, 2.0 * radius);
            if (!(moved > 0.0)) return std::nullopt;
            return repair(fmt::format("Close the {} gap between {} and {}", size_text(moved),
                                      thing_text(names, problem.face), thing_text(names, problem.other)),
                          std::move(changed), problem.position, moved / radius);
        }
        case ProblemKind::flipped: {
            Mesh changed = mesh;
            flip_face(changed, problem.face);
            return repair("Flip " + thing_text(names, problem.face), std::move(changed), problem.position,
                          0.1);
        }
        case ProblemKind::step_limit: {
            Mesh changed = mesh;
            const double height = flatten_riser(changed, problem.face, highest_slip_m);
            if (!(height > 0.0)) return std::nullopt;
            return repair(
                fmt::format("Flatten the {} step of {}", size_text(height), thing_text(names, problem.face)),
                std::move(changed), problem.position, height / radius);
        }
        default: return std::nullopt;
    }
}

// What hangs too low is raised, and what is too high to step on lowered, by as much as it takes.
void add_heights(std::vector<Cure>& cures, const Level& level, const Stop& stop) {
    constexpr double spare_m = 0.01;
    const Loss& loss = stop.loss;
    const MovementSettings& s = level.movement;
    if (stop.held_by.empty()) return;
    const std::string what = thing_text(StoryNames(level), loss.face);
    Mesh changed = *level.mesh;
    if (loss.cause == StopCause::overhead && loss.clearance_m > 0.0) {
        const double by = 2.0 * (s.radii.y() + s.skin) - loss.clearance_m + spare_m;
        raise_faces(changed, stop.held_by, by);
        cures.push_back(repair(fmt::format("Raise {} by {}", what, size_text(by)), std::move(changed),
                               loss.position, by / s.radii.y()));
    } else if ((loss.cause == StopCause::step || loss.cause == StopCause::wall) && s.step_up &&
               !loss.in_air && loss.top_m > s.step_height && loss.top_m < 2.0 * s.radii.y()) {
        const double by = loss.top_m - s.step_height + spare_m;
        lower_faces(changed, stop.held_by, stop.feet_m + s.step_height - spare_m);
        cures.push_back(repair(fmt::format("Lower {} by {}", what, size_text(by)), std::move(changed),
                               loss.position, by / s.radii.y()));
    } else {
        return;
    }
    cures.back().bluntness = 2;
}

}  // namespace

std::vector<Cure> repairs_at(const Level& level, const Stop& stop) {
    std::vector<Cure> cures;
    const Loss& loss = stop.loss;
    if (!level.mesh || loss.face == no_id || loss.cause == StopCause::platform) return cures;
    const double body = level.movement.radii.maxCoeff();
    std::optional<Part> part = part_around(level, loss.position, looked_at * body);
    if (!part) return cures;
    const DoctorReport report = examine(part->level);
    const StoryNames names(level);
    for (Problem problem : report.problems) {
        if (problem.face == no_id) continue;
        problem.face = part->face[problem.face];
        if (problem.other != no_id) problem.other = part->face[problem.other];
        const double far = (problem.position - loss.position).norm();
        const bool at_stop = problem.face == loss.face || problem.other == loss.face || far < 2.0 * body;
        // Who fell out of the level was stopped by nothing: what was left open lies where the fall began.
        if (!at_stop && !(loss.cause == StopCause::fall && far < looked_at * body)) continue;
        if (std::optional<Cure> cure = repair_of(level, problem, names)) cures.push_back(std::move(*cure));
    }
    std::stable_sort(cures.begin(), cures.end(),
                     [](const Cure& a, const Cure& b) { return a.change < b.change; });
    constexpr std::size_t maximum = 8;
    if (cures.size() > maximum) cures.resize(maximum);
    add_heights(cures, level, stop);
    return cures;
}

std::vector<Cure> find_cures_and_repairs(const Level& level, const TapeRun& run, const Stop& stop,
                                         const std::function<bool()>& cancelled) {
    return find_cures(level, run, stop, repairs_at(level, stop), cancelled);
}

}  // namespace slipface
