// T-junctions and cracks: corners that lie on, or almost on, an edge that only one face has.
#include <algorithm>
#include <cmath>
#include <tuple>

#include "checks.h"

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

double rounding_of(const Vec3& a, const Vec3& b) {
    // Six decimals is what most tools write; a float holds 24 bits.
    return std::max(2e-6, 4.0 * 0x1p-24 * std::max(a.cwiseAbs().maxCoeff(), b.cwiseAbs().maxCoeff()));
}

}  // namespace

void find_open_edges(const Patient& patient, Problems& out) {
    const Topology& topology = patient.topology;
    std::vector<EdgeUse> open;
    topology.each_edge([&](std::size_t first, std::size_t last) {
        if (last - first == 1) open.push_back(topology.edges[first]);
    });
    std::vector<std::uint32_t> corners;
    double length = 0.0;
    for (const EdgeUse& edge : open) {
        corners.push_back(edge.from);
        corners.push_back(edge.to);
        length += (topology.position[edge.to] - topology.position[edge.from]).norm();
    }
    if (open.empty()) return;
    std::sort(corners.begin(), corners.end());
    corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
    // What a hundredth of the player's smallest radius can fall into is a crack.
    const double gap = 0.01 * patient.level.movement.radii.minCoeff();
    const double cell = std::max(gap, length / static_cast<double>(open.size()));
    const CornerGrid grid(topology, corners, cell);

    Problems found;
    for (const EdgeUse& edge : open) {
        const Vec3 a = topology.position[edge.from], b = topology.position[edge.to];
        const Vec3 along = b - a;
        const double squared = along.squaredNorm();
        const double rounding = rounding_of(a, b);
        const Vec3 reach = Vec3::Constant(std::max(gap, rounding));
        grid.each_in(a.cwiseMin(b) - reach, a.cwiseMax(b) + reach, [&](std::uint32_t vertex) {
            if (vertex == edge.from || vertex == edge.to) return;
            const Vec3 p = topology.position[vertex];
            const double share = std::clamp((p - a).dot(along) / squared, 0.0, 1.0);
            const double distance = (p - (a + share * along)).norm();
            const bool at_end = share * share * squared <= rounding * rounding ||
                                (1.0 - share) * (1.0 - share) * squared <= rounding * rounding;
            if (distance <= rounding && !at_end)
                found.push_back({ProblemKind::t_junction, edge.face, no_id, p, vertex,
                                 "A corner lies on this face's edge, " + metres(std::sqrt(squared) * share) +
                                     " from its end"});
            else if (distance <= gap && squared > 4.0 * gap * gap)
                found.push_back({ProblemKind::crack, edge.face, no_id, p, vertex,
                                 "A corner lies " + metres(distance) + " beside this face's edge"});
        });
    }
    // One crack has two sides and several edges: each corner counts once.
    std::stable_sort(found.begin(), found.end(), [](const Problem& a, const Problem& b) {
        return std::tie(a.kind, a.index, a.face) < std::tie(b.kind, b.index, b.face);
    });
    found.erase(std::unique(found.begin(), found.end(),
                            [](const Problem& a, const Problem& b) {
                                return a.kind == b.kind && a.index == b.index;
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
