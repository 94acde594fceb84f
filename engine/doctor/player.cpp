// Checks that depend on the player: sharp corners, slopes and steps at the limit. Also orphans and textures.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>

#include "checks.h"
#include "crossing.h"
#include "slipface/mesh/texture_file.h"

namespace slipface {
namespace doctor {
namespace {

constexpr double sharpest =
    0.7853981633974483;  // radians: below 45 degrees a corner pushes back harder than 1:1
constexpr double degree = 0.017453292519943295;
constexpr double rounding_band = 0.1 * degree;  // closer to the limit than modelling tools write slopes
constexpr double steep_band =
    5.0 * degree;  // a ramp that is steeper by more is meant to be a wall or a slide

// In sphere space, where the player is a unit sphere, the planes meet at 90 degrees or more, as nearly
// everywhere. Planes transform by the inverse transpose: normals are multiplied by the radii.
bool is_wide(const Vec3& radii, const Vec3& normal_a, const Vec3& normal_b) {
    return normal_a.cwiseProduct(radii).dot(normal_b.cwiseProduct(radii)) >= 0.0;
}

// The player, resting in the corner of faces a and b at `edge_point`, touching both. Nothing if the planes
// form no corner there that is sharper than the limit. `angle` is the free angle in sphere space.
struct Rest {
    Vec3 centre;
    double angle;
};
std::optional<Rest> rest_in_corner(const Mesh& mesh, const Vec3& radii, const Vec3& edge_point,
                                   const Vec3& normal_a, const Vec3& normal_b, FaceId face_b) {
    // The other face in front of this one: a valley, not a ridge.
    if (normal_a.dot(face_centroid(mesh, face_b) - edge_point) <= 0.0) return std::nullopt;
    const Vec3 a = normal_a.cwiseProduct(radii).normalized(), b = normal_b.cwiseProduct(radii).normalized();
    const double between = std::acos(std::clamp(a.dot(b), -1.0, 1.0));
    const double angle = 3.141592653589793 - between;
    if (!(angle < sharpest) || !(angle > 1e-4)) return std::nullopt;
    const Vec3 middle = (a + b).normalized();
    const Vec3 centre_sphere = edge_point.cwiseQuotient(radii) + middle / std::sin(0.5 * angle);
    return Rest{centre_sphere.cwiseProduct(radii), angle};
}

// The player touches both faces there and nothing else is in the way.
bool player_fits(const Patient& patient, const Vec3& centre, FaceId a, FaceId b) {
    const Vec3& radii = patient.level.movement.radii;
    patient.spend(2, {centre - radii, centre + radii});
    if (overlaps_any(patient.world(), 0.98 * radii, centre)) return false;
    std::array<Overlap, 64> touched;
    const std::size_t count =
        std::min(touched.size(), find_overlaps(patient.world(), 1.03 * radii, centre, touched));
    const auto touches = [&](FaceId face) {
        return std::any_of(touched.begin(), touched.begin() + static_cast<std::ptrdiff_t>(count),
                           [&](const Overlap& overlap) { return overlap.face == face; });
    };
    return touches(a) && touches(b);
}

double slope_of(const Vec3& normal) {
    return std::acos(std::clamp(normal.y(), -1.0, 1.0));
}

Vec3 uphill_of(const Vec3& normal) {
    return Vec3(-normal.x(), 0.0, -normal.z()).normalized();
}

// The lowest and the highest point of a face along a horizontal direction, and their heights.
struct Extent {
    double near = std::numeric_limits<double>::infinity(), far = -near;
    double low = near, high = far;
};
Extent extent_of(const Patient& patient, FaceId face, const Vec3& centre, const Vec3& along) {
    Extent extent;
    for (std::uint32_t c = patient.mesh.face_first_corner[face]; c < patient.mesh.face_first_corner[face + 1];
         ++c) {
        const Vec3& p = patient.topology.position[patient.topology.vertex[c]];
        const double at = (p - centre).dot(along);
        extent.near = std::min(extent.near, at);
        extent.far = std::max(extent.far, at);
        extent.low = std::min(extent.low, p.y());
        extent.high = std::max(extent.high, p.y());
    }
    return extent;
}

// How far before and behind an obstacle a walker begins and ends: a little more than its body.
double run_up(const Patient& patient) {
    return 1.2 * std::max(patient.level.movement.radii.x(), patient.level.movement.radii.z());
}

// Ground that a ray straight down meets.
struct Ground {
    double height = 0.0;
    Vec3 normal = Vec3::UnitY();
    FaceId face = no_id;
    bool floor = false;  // flat enough to stand on
};
std::optional<Ground> ground_below(const Patient& patient, const Vec3& from, double depth) {
    ++patient.effort;
    const auto hit = cast_ray(patient.world(), from, Vec3(0.0, -1.0, 0.0), depth);
    if (!hit) return std::nullopt;
    const double steepest = patient.surface(hit->face).max_slope.value_or(patient.level.movement.max_slope);
    return Ground{hit->point.y(), hit->normal, hit->face, hit->normal.y() >= std::cos(steepest)};
}

// Ground of one slope between a lower and a higher floor, neither clearly flatter nor clearly steeper than
// the limit. A facet of a rock, or a hillside that goes on steeper, leads from no floor to another.
struct Ramp {
    FaceId face = no_id;
    double slope = 0.0, limit = 0.0;
    Passage passage = Passage::unknown;
};

// From a point of a slope straight up or down it (`sign`) to the first ground that is none of it: there, if
// that is a floor. `only`: nothing where another face of the slope comes before, either.
std::optional<Vec3> floor_at_end(const Patient& patient, Vec3 at, Vec3 normal, double sign, FaceId only) {
    constexpr double same_heading = 0.87;  // cosine of 30 degrees
    const double radius = patient.level.movement.radii.minCoeff();
    const double stride = radius / 8.0, above = 0.75 * radius;
    constexpr int maximum = 2000, some = 8;
    for (int i = 0; i < maximum; ++i) {
        const Vec3 around = Vec3::Constant(some * stride);
        if (i % some == 0) patient.spend(some, {at - around, at + around});
        if (patient.is_spent()) return std::nullopt;
        const auto ground = ground_below(patient, at + Vec3(0.0, above, 0.0), 2.0 * above);
        if (!ground) return std::nullopt;
        at.y() = ground->height;
        const Vec3 uphill = uphill_of(normal);
        const bool same = std::abs(slope_of(ground->normal) - slope_of(normal)) < degree &&
                          uphill_of(ground->normal).dot(uphill) > same_heading;
        if (!same) return ground->floor && i > 0 ? std::optional(at) : std::nullopt;
        if (only != no_id && ground->face != only) return std::nullopt;
        normal = ground->normal;
        at += sign * stride * (uphill + Vec3(0.0, std::tan(slope_of(normal)), 0.0));
    }
    return std::nullopt;
}

// Whether a player gets up the ramp that a face belongs to. Unknown where it is part of no ramp, which has a
// floor at both ends, as high half a radius to the left and to the right; and where it is not the ramp's
// lowest face.
Passage climb_ramp(const Patient& patient, FaceId face) {
    const Vec3& normal = patient.topology.normal[face];
    const Vec3 middle = face_centroid(patient.mesh, face), uphill = uphill_of(normal);
    const double radius = patient.level.movement.radii.minCoeff();
    std::array<Vec3, 2> ends;
    for (const double sign : {-1.0, 1.0}) {
        const auto end = floor_at_end(patient, middle, normal, sign, sign < 0.0 ? face : no_id);
        if (!end) return Passage::unknown;
        for (const double side : {-0.5, 0.5}) {
            const Vec3 beside = middle + side * radius * uphill.cross(Vec3::UnitY());
            const auto other = floor_at_end(patient, beside, normal, sign, no_id);
            if (!other || std::abs(other->y() - end->y()) > 0.1 * radius) return Passage::unknown;
        }
        ends[sign < 0.0 ? 0 : 1] = *end + sign * run_up(patient) * uphill;
    }
    return climb_between(patient, ends[0], ends[1]);
}

std::vector<Ramp> ramps_of(const Patient& patient) {
    std::vector<Ramp> ramps;
    for (FaceId face = 0; face < patient.mesh.face_count(); ++face) {
        const Vec3& normal = patient.topology.normal[face];
        const SurfaceType& surface = patient.surface(face);
        if (normal.isZero() || !surface.solid || surface.sticky || surface.climbable) continue;
        const double limit = surface.max_slope.value_or(patient.level.movement.max_slope);
        const double slope = slope_of(normal);
        if (slope < limit - rounding_band || slope > limit + steep_band) continue;
        ramps.push_back({.face = face, .slope = slope, .limit = limit});
    }
    return ramps;
}

// The highest edge that the ellipsoid rolls over on its own: where the contact's normal is as steep as the
// limit.
double rolled_over(const MovementSettings& settings) {
    const double across = std::tan(settings.max_slope) * settings.radii.x() / settings.radii.y();
    return settings.radii.y() * (1.0 - 1.0 / std::sqrt(1.0 + across * across));
}

// An upright face that leads from one floor to a higher one: a stair's, a kerb's, at most a quarter of the
// body high. Its height is that between the floors, the same half a radius to the left and to the right; one
// face of several, a face that is sunk into the floor, the rim of something higher and a rock's facet have
// others.
struct Step {
    FaceId face = no_id;
    double height = 0.0;
    Vec3 below = Vec3::Zero(), above = Vec3::Zero();
    Passage passage = Passage::unknown;
};
// Counts the faces that were not looked at, because there are too many triangles.
std::vector<Step> steps_of(const Patient& patient, std::size_t& untried) {
    constexpr std::size_t some = 8, rays = 8, highest_effort = 500'000;
    std::size_t effort = 0, looked_at = 0;
    const double highest = 0.5 * patient.level.movement.radii.y();
    const double rolls = rolled_over(patient.level.movement);
    const double beside = 0.02 * patient.level.movement.radii.minCoeff();
    const double half_radius =
        0.5 * std::min(patient.level.movement.radii.x(), patient.level.movement.radii.z());
    std::vector<Step> steps;
    for (FaceId face = 0; face < patient.mesh.face_count(); ++face) {
        const Vec3& normal = patient.topology.normal[face];
        if (normal.isZero() || std::abs(normal.y()) > 0.1 || !patient.surface(face).solid) continue;
        const Vec3 out = Vec3(normal.x(), 0.0, normal.z()).normalized();
        const Vec3 centre = face_centroid(patient.mesh, face);
        const Extent extent = extent_of(patient, face, centre, out);
        if (extent.high - extent.low > 2.0 * highest) continue;
        if (effort > highest_effort) {
            ++untried;
            continue;
        }
        if (looked_at++ % some == 0) {
            const Vec3 around(half_radius, highest, half_radius);
            effort += patient.effort_among_many(some * rays, {centre - around, centre + around});
        }
        // A step up is one from the side to which its face looks; where nothing is wound well, from either.
        for (const double side : {1.0, -1.0}) {
            const double rim = side > 0.0 ? extent.far : -extent.near;
            const double brow = side > 0.0 ? -extent.near : extent.far;
            Step step{face, 0.0, centre + side * (rim + beside) * out, centre - side * (brow + beside) * out};
            const auto floors = [&](double along) -> std::optional<std::pair<double, double>> {
                const Vec3 shift = along * out.cross(Vec3::UnitY());
                const Vec3 before = step.below + shift, behind = step.above + shift;
                const auto foot =
                    ground_below(patient, {before.x(), extent.high, before.z()}, highest + beside);
                if (!foot || !foot->floor) return std::nullopt;
                const auto top =
                    ground_below(patient, {behind.x(), extent.high + highest, behind.z()}, 2.0 * highest);
                if (!top || !top->floor) return std::nullopt;
                return std::pair(foot->height, top->height);
            };
            const auto middle = floors(0.0);
            if (!middle) continue;
            step.height = middle->second - middle->first;
            // What the body rolls over by itself, with or without step up, is stopped by something else.
            if (step.height > highest || step.height < 0.95 * rolls) continue;
            const auto is_as_high = [&](double along) {
                const auto there = floors(along);
                return there && std::abs(there->second - there->first - step.height) <= 0.2 * half_radius;
            };
            if (!is_as_high(-half_radius) || !is_as_high(half_radius)) continue;
            step.below += side * run_up(patient) * out;
            step.above -= side * run_up(patient) * out;
            step.below.y() = middle->first;
            step.above.y() = middle->second;
            steps.push_back(step);
        }
    }
    return steps;
}

}  // namespace

std::size_t find_acute_corners(const Patient& patient, Problems& out) {
    const Topology& topology = patient.topology;
    const Vec3& radii = patient.level.movement.radii;
    struct Corner {
        FaceId a, b;
        Vec3 middle;
        std::array<std::optional<Rest>, 2> rests;
        std::optional<double> angle;  // at which the player wedges
    };
    std::vector<Corner> corners;
    topology.each_edge([&](std::size_t first, std::size_t last) {
        if (last - first != 2) return;
        const FaceId a = topology.edges[first].face, b = topology.edges[first + 1].face;
        if (a == b || is_wide(radii, topology.normal[a], topology.normal[b])) return;
        if (!patient.surface(a).solid || !patient.surface(b).solid) return;
        const Vec3 middle = 0.5 * (topology.position[topology.edges[first].from] +
                                   topology.position[topology.edges[first].to]);
        // From both sides, for the player may be behind the faces as well.
        Corner corner{a, b, middle, {}, {}};
        for (std::size_t side = 0; side < 2; ++side) {
            const double sign = side == 0 ? 1.0 : -1.0;
            corner.rests[side] = rest_in_corner(patient.mesh, radii, middle, sign * topology.normal[a],
                                                sign * topology.normal[b], b);
        }
        if (corner.rests[0] || corner.rests[1]) corners.push_back(corner);
    });
    const std::size_t untried = try_in_turn(patient, corners.size(), [&](const Patient& here, std::size_t i) {
        for (const std::optional<Rest>& rest : corners[i].rests) {
            if (corners[i].angle || !rest) continue;
            if (player_fits(here, rest->centre, corners[i].a, corners[i].b) && wedges(here, rest->centre))
                corners[i].angle = rest->angle;
        }
        return !here.is_spent();
    });
    const std::size_t before = out.size();
    for (const Corner& corner : corners)
        if (corner.angle)
            out.push_back({ProblemKind::acute_corner, corner.a, corner.b, corner.middle, 0,
                           fmt::format("Faces {} and {} meet at {} as the player sees it", corner.a, corner.b,
                                       degrees(*corner.angle))});
    std::stable_sort(out.begin() + static_cast<std::ptrdiff_t>(before), out.end(),
                     [](const Problem& x, const Problem& y) { return x.face < y.face; });
    return untried;
}

std::size_t find_limit_slopes(const Patient& patient, Problems& out) {
    std::vector<Ramp> ramps = ramps_of(patient);
    const std::size_t untried = try_in_turn(patient, ramps.size(), [&](const Patient& here, std::size_t i) {
        ramps[i].passage = climb_ramp(here, ramps[i].face);
        return !here.is_spent();
    });
    for (const Ramp& ramp : ramps) {
        const bool at_limit = std::abs(ramp.slope - ramp.limit) <= rounding_band;
        const bool too_steep = ramp.passage == Passage::catches && ramp.slope > ramp.limit;
        if (ramp.passage == Passage::unknown || (!at_limit && !too_steep)) continue;
        const char* const words = at_limit ? "rounding decides whether the player can walk up"
                                           : "the player cannot walk up to the floor above";
        out.push_back({ProblemKind::slope_limit, ramp.face, no_id, face_centroid(patient.mesh, ramp.face), 0,
                       fmt::format("Rises by {}; the limit is {}: {}", degrees(ramp.slope),
                                   degrees(ramp.limit), words)});
    }
    return untried;
}

std::size_t find_limit_steps(const Patient& patient, Problems& out) {
    std::size_t untried = 0;
    std::vector<Step> steps = steps_of(patient, untried);
    untried += try_in_turn(patient, steps.size(), [&](const Patient& here, std::size_t i) {
        steps[i].passage = climb_between(here, steps[i].below, steps[i].above);
        return !here.is_spent();
    });
    const MovementSettings& settings = patient.level.movement;
    // At a step that the settings allow, something else is in the way, such as a rail that stands on it.
    std::erase_if(steps, [&](const Step& step) {
        return step.passage != Passage::catches || (settings.step_up && step.height <= settings.step_height);
    });
    // The steps of a flight are one problem: of one group and height.
    const auto flight_of = [&](const Step& step) {
        return std::pair(patient.mesh.face_group[step.face], std::llround(step.height * 1000.0));
    };
    std::map<std::pair<std::uint32_t, long long>, std::vector<const Step*>> flights;
    for (const Step& step : steps)
        flights[flight_of(step)].push_back(&step);
    const std::string climbs = settings.step_up ? "Step height is " + metres(settings.step_height)
                                                : "Step up is off; without it the player climbs only " +
                                                      metres(rolled_over(settings));
    Problems found;
    for (const auto& [flight, members] : flights) {
        const Step& first = *members.front();
        const std::string what =
            members.size() == 1 ? fmt::format("A step of {} stops", metres(first.height))
                                : fmt::format("{} steps of {} stop", members.size(), metres(first.height));
        found.push_back({ProblemKind::step_limit, first.face, no_id, face_centroid(patient.mesh, first.face),
                         0, what + " the player; " + climbs});
    }
    std::sort(found.begin(), found.end(), [](const Problem& a, const Problem& b) { return a.face < b.face; });
    out.insert(out.end(), found.begin(), found.end());
    return untried;
}

void find_orphans(const Patient& patient, Problems& out) {
    const std::vector<Orphan>& orphans = patient.level.orphans;
    for (std::size_t i = 0; i < orphans.size(); ++i)
        out.push_back({ProblemKind::orphan, no_id, no_id, orphans[i].key.centroid, i,
                       "A painted " + orphans[i].type +
                           (orphans[i].key.material.empty() ? std::string(" without a material")
                                                            : " of material " + orphans[i].key.material)});
}

void find_missing_textures(const Patient& patient, Problems& out) {
    const Mesh& mesh = patient.mesh;
    const std::filesystem::path folder = patient.level.mesh_path.parent_path();
    std::map<std::uint32_t, FaceId> first_face;
    for (FaceId face = 0; face < mesh.face_count(); ++face)
        first_face.try_emplace(mesh.face_material[face], face);
    for (std::size_t i = 0; i < mesh.materials.size(); ++i) {
        const Material& material = mesh.materials[i];
        if (material.texture.empty() || material.picture) continue;
        if (const FoundTexture found = find_texture(material.texture, folder); found.path || found.refused)
            continue;
        const auto face = first_face.find(static_cast<std::uint32_t>(i));
        const FaceId where = face == first_face.end() ? no_id : face->second;
        out.push_back({ProblemKind::missing_texture, where, no_id,
                       where == no_id ? Vec3(Vec3::Zero()) : face_centroid(mesh, where), i,
                       "Material " + material.name + " names " + material.texture});
    }
}

}  // namespace doctor

}  // namespace slipface
