// T-junctions and gaps: corners on or near an edge of only one face, where two faces look like one surface.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "checks.h"
#include "crossing.h"
#include "slipface/base/parallel.h"

namespace slipface::doctor {
namespace {

struct Cell {
    std::int64_t x, y, z;
    friend auto operator<=>(const Cell&, const Cell&) = default;
};

// The corners of open edges, sorted into cubes.
class CornerGrid {
  public:
    CornerGrid(const Topology& topology, std::vector<std::uint32_t> corners, double cell)
        : topology_(topology), cell_(cell) {
        entries_.reserve(corners.size());
        for (const std::uint32_t vertex : corners)
            entries_.push_back({cell_of(topology.position[vertex]), vertex});
        std::sort(entries_.begin(), entries_.end());
    }

    // Calls visit(vertex) for every corner in the box, each once.
    template <class Visit>
    void each_in(const Vec3& min, const Vec3& max, Visit visit) const {
        const Cell low = cell_of(min), high = cell_of(max);
        const double cells =
            (static_cast<double>(high.x - low.x) + 1) * (static_cast<double>(high.y - low.y) + 1);
        if (cells > static_cast<double>(entries_.size())) {
            for (const Entry& entry : entries_)
                if (inside(entry.vertex, min, max)) visit(entry.vertex);
            return;
        }
        for (std::int64_t x = low.x; x <= high.x; ++x) {
            for (std::int64_t y = low.y; y <= high.y; ++y) {
                auto entry = std::lower_bound(entries_.begin(), entries_.end(), Entry{{x, y, low.z}, 0});
                for (; entry != entries_.end() && entry->cell <= Cell{x, y, high.z}; ++entry)
                    if (inside(entry->vertex, min, max)) visit(entry->vertex);
            }
        }
    }

  private:
    struct Entry {
        Cell cell;
        std::uint32_t vertex;
        friend auto operator<=>(const Entry&, const Entry&) = default;
    };

    std::int64_t index(double value) const {
        // Coordinates beyond what a float distinguishes share a cell.
        return static_cast<std::int64_t>(std::floor(std::clamp(value / cell_, -1e15, 1e15)));
    }
    Cell cell_of(const Vec3& p) const { return {index(p.x()), index(p.y()), index(p.z())}; }
    bool inside(std::uint32_t vertex, const Vec3& min, const Vec3& max) const {
        const Vec3& p = topology_.position[vertex];
        return (p.array() >= min.array()).all() && (p.array() <= max.array()).all();
    }

    const Topology& topology_;
    double cell_;
    std::vector<Entry> entries_;
};

// An edge that one face has, seen from that face.
struct OpenEdge {
    EdgeUse use;
    Vec3 a, b;
    Vec3 along;    // unit, from a to b
    Vec3 outside;  // unit, in the face's plane, away from the face
    Vec3 normal;   // of the face
    double length;
};

// Nothing for an edge or a face without size.
std::optional<OpenEdge> open_edge(const Patient& patient, const EdgeUse& use) {
    const Topology& topology = patient.topology;
    OpenEdge edge{
        use, topology.position[use.from], topology.position[use.to], {}, {}, topology.normal[use.face], 0.0};
    edge.length = (edge.b - edge.a).norm();
    if (!(edge.length > 0.0) || edge.normal.isZero()) return std::nullopt;
    edge.along = (edge.b - edge.a) / edge.length;
    // The face lies to the left of its edges, seen against its normal.
    const Vec3 forward = use.forward ? edge.along : Vec3(-edge.along);
    edge.outside = forward.cross(edge.normal).normalized();
    return edge;
}

// The surface of `edge` goes on beyond it as that of `other`: they face each other along one line, turned by
// no more than 60 degrees.
bool goes_on(const OpenEdge& edge, const OpenEdge& other) {
    return std::abs(edge.along.dot(other.along)) > 0.999 && edge.outside.dot(other.outside) < -0.5 &&
           edge.normal.dot(other.normal) > 0.5;
}

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
    const double width = (p - q).norm();
    const Vec3 middle = 0.5 * (p + q);
    if (closest_point(patient.world(), middle, 0.4 * width)) return false;
    const Vec3& radii = patient.level.movement.radii;
    // The body's centre when it touches the plane there, and a little more.
    const Vec3 scaled = normal.cwiseProduct(radii);
    const Vec3 centre = middle + normal * (scaled.norm() + 0.05 * radii.minCoeff());
    return !overlaps_any(patient.world(), 0.95 * radii, centre);
}

}  // namespace

void find_open_edges(const Patient& patient, Problems& out) {
    const Topology& topology = patient.topology;
    std::vector<OpenEdge> open;
    topology.each_edge([&](std::size_t first, std::size_t last) {
        if (last - first != 1) return;
        if (const auto edge = open_edge(patient, topology.edges[first])) open.push_back(*edge);
    });
    if (open.empty()) return;
    std::vector<std::uint32_t> corners;
    std::vector<std::pair<std::uint32_t, std::uint32_t>> edges_at;  // a corner and an open edge there
    double length = 0.0;
    for (std::uint32_t i = 0; i < open.size(); ++i) {
        for (const std::uint32_t corner : {open[i].use.from, open[i].use.to}) {
            corners.push_back(corner);
            edges_at.emplace_back(corner, i);
        }
        length += open[i].length;
    }
    std::sort(corners.begin(), corners.end());
    corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
    std::sort(edges_at.begin(), edges_at.end());
    // Wider than the body is a hole that everybody sees.
    const Vec3& radii = patient.level.movement.radii;
    const double widest = 2.0 * std::min(radii.x(), radii.z());
    const double cell = std::max(widest, length / static_cast<double>(open.size()));
    const CornerGrid grid(topology, corners, cell);

    // The open edge at a corner that goes on from `edge`, if there is one.
    const auto continuation = [&](const OpenEdge& edge, std::uint32_t corner) -> const OpenEdge* {
        auto at = std::lower_bound(edges_at.begin(), edges_at.end(), std::pair(corner, 0u));
        for (; at != edges_at.end() && at->first == corner; ++at)
            if (goes_on(edge, open[at->second])) return &open[at->second];
        return nullptr;
    };
    struct Gap {
        const OpenEdge* edge;
        const OpenEdge* other;
        std::uint32_t corner;
        double width;
        Vec3 p, q;
    };
    std::vector<Gap> gaps;
    Problems found;
    for (const OpenEdge& edge : open) {
        const double rounding = rounding_of(edge.a, edge.b);
        const Vec3 reach = Vec3::Constant(widest);
        grid.each_in(
            edge.a.cwiseMin(edge.b) - reach, edge.a.cwiseMax(edge.b) + reach, [&](std::uint32_t vertex) {
                if (vertex == edge.use.from || vertex == edge.use.to) return;
                const Vec3 p = topology.position[vertex];
                const Vec3 q = on_edge(edge, p);
                const double along = (q - edge.a).norm();
                const double width = (p - q).norm();
                if (width > widest) return;
                const bool at_end = along <= rounding || edge.length - along <= rounding;
                if (width <= rounding) {
                    if (!at_end && continuation(edge, vertex))
                        found.push_back(
                            {ProblemKind::t_junction, edge.use.face, no_id, p, vertex,
                             "A corner lies on this face's edge, " + metres(along) + " from its end"});
                    return;
                }
                // A gap has its other side in front of the edge, above or below it.
                const Vec3 over = (p - q) / width;
                if (std::abs(over.dot(edge.along)) > 0.5 || over.dot(edge.outside) < -0.1) return;
                const OpenEdge* const other = continuation(edge, vertex);
                if (!other || over.dot(other->outside) > 0.1) return;
                gaps.push_back({&edge, other, vertex, width, p, q});
            });
    }
    // One gap has two sides and several edges: the narrowest of each corner counts.
    std::sort(gaps.begin(), gaps.end(), [](const Gap& a, const Gap& b) {
        return std::tie(a.corner, a.width, a.edge) < std::tie(b.corner, b.width, b.edge);
    });
    gaps.erase(std::unique(gaps.begin(), gaps.end(),
                           [](const Gap& a, const Gap& b) { return a.corner == b.corner; }),
               gaps.end());
    std::vector<std::optional<Passage>> passages(gaps.size());
    if (!gaps.empty()) patient.world();
    parallel_for(gaps.size(), 8, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const Gap& gap = gaps[i];
            const Vec3 normal = (gap.edge->normal + gap.other->normal).normalized();
            // Beside its corner, where gaps may cross, and further inside.
            const double away = std::min(0.5 * gap.other->length, 2.5 * std::max(radii.x(), radii.z()));
            for (const double along : {std::min(0.25 * gap.other->length, gap.width), away}) {
                const Vec3 inside = inward(*gap.other, gap.corner) * along;
                const Vec3 p = gap.p + inside, q = on_edge(*gap.edge, gap.q + inside);
                if (!is_open_and_reachable(patient, p, q, normal)) continue;
                const Passage passage = cross_all_directions(patient, 0.5 * (p + q));
                passages[i] = std::max(passages[i].value_or(Passage::unknown), passage);
            }
            // Where gaps cross there is more room than in either.
            const Vec3 crossing = 0.5 * (gap.p + gap.q) - inward(*gap.other, gap.corner) * (0.5 * gap.width);
            if (passages[i] && drops_through(patient, crossing)) passages[i] = Passage::falls;
        }
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
        return std::tie(a.kind, a.index, a.face) < std::tie(b.kind, b.index, b.face);
    });
    found.erase(std::unique(found.begin(), found.end(),
                            [](const Problem& a, const Problem& b) {
                                return a.kind == b.kind && a.index == b.index &&
                                       a.kind == ProblemKind::t_junction;
                            }),
                found.end());
    std::stable_sort(found.begin(), found.end(),
                     [](const Problem& a, const Problem& b) { return a.face < b.face; });
    for (Problem& problem : found) {
        problem.index = 0;
        out.push_back(std::move(problem));
    }
}

}  // namespace slipface::doctor
