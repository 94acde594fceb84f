// T-junctions and gaps: corners on or near an edge of only one face, where two faces look like one surface.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "checks.h"
#include "crossing.h"
#include "facing_edges.h"
#include "slipface/base/parallel.h"

namespace slipface::doctor {
namespace {

// The nearest point of the edge.
Vec3 on_edge(const OpenEdge& edge, const Vec3& point) {
    return edge.a + std::clamp((point - edge.a).dot(edge.along), 0.0, edge.length) * edge.along;
}

// Along the edge, away from its corner.
Vec3 inward(const OpenEdge& edge, std::uint32_t corner) {
    return corner == edge.use.from ? edge.along : Vec3(-edge.along);
}

// What a gap does to a player who crosses it, as the movement has it.
const char* words_of(Passage passage) {
    switch (passage) {
        case Passage::falls: return "; the player falls through it";
        case Passage::catches: return "; the player catches on it";
        case Passage::passes: return "; the player passes over it, but rays and small things fall through";
        case Passage::unknown: break;
    }
    return "; rays and small things fall through";
}

// The part of a gap between `p` and `q` is open, and a player's body gets near it from the side of `normal`.
bool is_open_and_reachable(const Patient& patient, const Vec3& p, const Vec3& q, const Vec3& normal) {
    patient.effort += 2;
    const double width = (p - q).norm();
    const Vec3 middle = 0.5 * (p + q);
    const Vec3 within = Vec3::Constant(0.4 * width);
    if (overlaps_any(patient.world(), within, middle)) return false;
    patient.spend(2, {middle - within, middle + within});
    if (closest_point(patient.world(), middle, within.x())) return false;
    const Vec3& radii = patient.level.movement.radii;
    // The body's centre when it touches the plane there, and a little more.
    const Vec3 scaled = normal.cwiseProduct(radii);
    const Vec3 centre = middle + normal * (scaled.norm() + 0.05 * radii.minCoeff());
    return !overlaps_any(patient.world(), 0.95 * radii, centre);
}

// What is near an end of an open edge, where its surface goes on.
struct Beyond {
    std::uint32_t on = no_id;    // an edge that the end lies on, of the first face
    std::uint32_t edge = no_id;  // on the other side of the narrowest gap
    double width = 0.0;          // of that gap, metres
};
using Ends = std::array<Beyond, 2>;

// `corner`: an end of `other`, looked at with open[index]. `coarsest`: what corners are rounded by at most.
void look_at(const Patient& patient, std::span<const OpenEdge> open, std::uint32_t index,
             const OpenEdge& other, std::uint32_t corner, double coarsest, Beyond& found) {
    const OpenEdge& edge = open[index];
    if (corner == edge.use.from || corner == edge.use.to) return;
    const Vec3& p = patient.topology.position[corner];
    const Vec3 q = on_edge(edge, p);
    const double width = (p - q).norm();
    if (width > found.width && width > coarsest) return;
    const double along = (q - edge.a).norm();
    const double rounding = rounding_of(edge.a, edge.b);
    if (width <= rounding) {
        const bool at_end = along <= rounding || edge.length - along <= rounding;
        const auto order = [&](std::uint32_t i) { return std::pair(open[i].use.face, i); };
        if (!at_end && (found.on == no_id || order(index) < order(found.on))) found.on = index;
        return;
    }
    // A gap has its other side in front of the edge, above or below it.
    const Vec3 over = (p - q) / width;
    if (std::abs(over.dot(edge.along)) > 0.5 || over.dot(edge.outside) < -0.1 ||
        over.dot(other.outside) > 0.1)
        return;
    if (std::pair(width, index) < std::pair(found.width, found.edge)) {
        found.edge = index;
        found.width = width;
    }
}

// [edge] The ends of `open`. `widest`: of a gap, metres. Counts the edges that were not compared with all
// others within that width.
std::vector<Ends> look_beyond(const Patient& patient, std::span<const OpenEdge> open, double widest,
                              std::atomic<std::size_t>& cut) {
    Ends nothing;
    for (Beyond& end : nothing)
        end.width = widest;
    std::vector<Ends> ends(open.size(), nothing);
    const FacingEdges facing(open, widest);
    // Where very many edges lie near each other, the search ends with the nearest.
    const std::size_t steps = std::max<std::size_t>(256, 60'000'000 / facing.group_count());
    const double rounding =
        rounding_of(patient.mesh.bounds.min.cast<double>(), patient.mesh.bounds.max.cast<double>());
    parallel_for(facing.group_count(), 8, [&](std::size_t begin, std::size_t end) {
        for (std::size_t group = begin; group < end; ++group) {
            const auto others = facing.edges_of(group);
            const auto width = [&] {
                double widest_left = rounding;
                for (const std::uint32_t other : others)
                    widest_left = std::max({widest_left, ends[other][0].width, ends[other][1].width});
                return widest_left;
            };
            std::size_t left = steps;
            facing.each_facing(group, width(), left, [&](std::uint32_t index) {
                for (const std::uint32_t other : others) {
                    if (!goes_on(open[index], open[other])) continue;
                    left -= std::min<std::size_t>(left, 1);
                    look_at(patient, open, index, open[other], open[other].use.from, rounding,
                            ends[other][0]);
                    look_at(patient, open, index, open[other], open[other].use.to, rounding, ends[other][1]);
                }
                return width();
            });
            if (left == 0) cut += others.size();
        }
    });
    return ends;
}

struct Gap {
    const OpenEdge* edge;
    const OpenEdge* other;
    std::uint32_t corner;
    double width;
    Vec3 p, q;
};

// What the gap does to a player. Nothing if something fills it, or no player gets there.
std::optional<Passage> passage_of(const Patient& patient, const Gap& gap) {
    const Vec3& radii = patient.level.movement.radii;
    const Vec3 normal = (gap.edge->normal + gap.other->normal).normalized();
    std::optional<Passage> worst;
    // Beside its corner, where gaps may cross, and further inside.
    const double away = std::min(0.5 * gap.other->length, 2.5 * std::max(radii.x(), radii.z()));
    for (const double along : {std::min(0.25 * gap.other->length, gap.width), away}) {
        const Vec3 inside = inward(*gap.other, gap.corner) * along;
        const Vec3 p = gap.p + inside, q = on_edge(*gap.edge, gap.q + inside);
        if (!is_open_and_reachable(patient, p, q, normal)) continue;
        const Passage passage = cross_all_directions(patient, 0.5 * (p + q));
        worst = std::max(worst.value_or(Passage::unknown), passage);
    }
    // Where gaps cross there is more room than in either.
    const Vec3 crossing = 0.5 * (gap.p + gap.q) - inward(*gap.other, gap.corner) * (0.5 * gap.width);
    if (worst && drops_through(patient, crossing)) worst = Passage::falls;
    return worst;
}

}  // namespace

std::size_t find_open_edges(const Patient& patient, Problems& out) {
    const std::vector<OpenEdge> open = open_edges(patient.topology);
    if (open.empty()) return 0;
    // Wider than the body is a hole that everybody sees.
    const Vec3& radii = patient.level.movement.radii;
    std::atomic<std::size_t> cut = 0;
    const std::vector<Ends> ends = look_beyond(patient, open, 2.0 * std::min(radii.x(), radii.z()), cut);
    // Of each corner the first face that it lies on, and the narrowest gap.
    struct Junction {
        std::uint32_t corner, edge;
    };
    std::vector<Junction> junctions;
    std::vector<Gap> gaps;
    for (std::uint32_t other = 0; other < open.size(); ++other) {
        for (std::size_t i = 0; i < 2; ++i) {
            const std::uint32_t corner = i == 0 ? open[other].use.from : open[other].use.to;
            const Beyond& end = ends[other][i];
            const Vec3& p = patient.topology.position[corner];
            if (end.on != no_id) junctions.push_back({corner, end.on});
            if (end.edge == no_id) continue;
            const OpenEdge& edge = open[end.edge];
            gaps.push_back({&edge, &open[other], corner, end.width, p, on_edge(edge, p)});
        }
    }
    const auto keep_first = [](auto& list, const auto& key) {
        std::sort(list.begin(), list.end(), [&](const auto& a, const auto& b) { return key(a) < key(b); });
        list.erase(std::unique(list.begin(), list.end(),
                               [](const auto& a, const auto& b) { return a.corner == b.corner; }),
                   list.end());
    };
    keep_first(junctions,
               [&](const Junction& at) { return std::tuple(at.corner, open[at.edge].use.face, at.edge); });
    keep_first(gaps, [](const Gap& gap) { return std::tuple(gap.corner, gap.width, gap.edge, gap.other); });
    Problems found;
    for (const Junction& at : junctions) {
        const OpenEdge& edge = open[at.edge];
        const Vec3& p = patient.topology.position[at.corner];
        found.push_back({ProblemKind::t_junction, edge.use.face, no_id, p, at.corner,
                         "A corner lies on this face's edge, " + metres((on_edge(edge, p) - edge.a).norm()) +
                             " from its end"});
    }
    std::vector<std::optional<Passage>> passages(gaps.size());
    const std::size_t untried = try_in_turn(patient, gaps.size(), [&](const Patient& here, std::size_t i) {
        passages[i] = passage_of(here, gaps[i]);
        return !here.is_spent();
    });
    // A gap between two faces is one problem: where it does most, and is narrowest.
    std::map<std::pair<FaceId, FaceId>, std::size_t> worst;
    for (std::size_t i = 0; i < gaps.size(); ++i) {
        if (!passages[i]) continue;
        const FaceId a = gaps[i].edge->use.face, b = gaps[i].other->use.face;
        const auto [known, fresh] = worst.try_emplace({std::min(a, b), std::max(a, b)}, i);
        if (!fresh && std::pair(*passages[known->second], -gaps[known->second].width) <
                          std::pair(*passages[i], -gaps[i].width))
            known->second = i;
    }
    for (const auto& [faces, i] : worst) {
        const Gap& gap = gaps[i];
        found.push_back({ProblemKind::crack, faces.first, faces.second, 0.5 * (gap.p + gap.q), gap.corner,
                         fmt::format("A gap of {} to face {}{}", metres(gap.width), faces.second,
                                     words_of(*passages[i]))});
    }
    std::stable_sort(found.begin(), found.end(), [](const Problem& a, const Problem& b) {
        return std::pair(a.face, a.index) < std::pair(b.face, b.index);
    });
    for (Problem& problem : found) {
        problem.index = 0;
        out.push_back(std::move(problem));
    }
    return cut + untried;
}

}  // namespace slipface::doctor
