// Edges that one face has, and a search for those on which the surface of another face may go on.
#pragma once

#include <algorithm>
#include <array>
#include <span>
#include <vector>

#include "boxes.h"
#include "topology.h"

namespace slipface::doctor {

// An edge that one face has, seen from that face.
struct OpenEdge {
    EdgeUse use;
    Vec3 a, b;
    Vec3 along;    // unit, from a to b
    Vec3 outside;  // unit, in the face's plane, away from the face
    Vec3 normal;   // of the face
    double length;

    // The face lies to the left of its edges, seen against its normal.
    Vec3 forward() const { return use.forward ? along : Vec3(-along); }
};

// In the order of the topology's. None without size, nor of a face without size.
std::vector<OpenEdge> open_edges(const Topology& topology);

// The surface of `edge` goes on beyond it as that of `other`: they face each other along one line, turned by
// no more than 60 degrees.
bool goes_on(const OpenEdge& edge, const OpenEdge& other);

// Edges of about one direction near each other in groups of eight, those in groups of eight, and so on.
class FacingEdges {
  public:
    // `width`: metres, at which edges face each other.
    FacingEdges(std::span<const OpenEdge> edges, double width);

    std::size_t group_count() const { return levels_.empty() ? 0 : levels_.front().size(); }
    std::span<const std::uint32_t> edges_of(std::size_t group) const {
        return std::span(order_).subspan(group * lanes, std::min(lanes, order_.size() - group * lanes));
    }

    // Calls visit(index) for the edges, at most `width` from one of a group, on which that one goes on; also
    // for others. About the nearest come first, and what visit() returns is the width from then on. Ends
    // after `most` steps.
    template <class Visit>
    void each_facing(std::size_t of, double width, std::size_t& left, Visit visit) const {
        const Bounds& own = bounds_[of];
        // Chords as long as goes_on() allows between opposite unit vectors, and some rounding.
        const Box forward = opposite(own.forward, 0.0448f), outside = opposite(own.outside, 1.001f);
        struct Near {
            float distance;
            std::uint32_t node, level;
        };
        std::array<Near, max_levels * lanes> open;
        std::size_t count = 0;
        open[count++] = {0.0f, 0, static_cast<std::uint32_t>(levels_.size())};
        while (count > 0 && left > 0) {
            --left;
            const Near at = open[--count];
            if (at.distance > width) continue;
            if (at.level == 0) {
                width = visit(order_[at.node]);
                continue;
            }
            const Group& group = levels_[at.level - 1][at.node];
            const LaneMask turned = group.forward.touching(forward), beside = group.outside.touching(outside);
            const std::size_t first = count;
            for (std::size_t lane = 0; lane < lanes; ++lane) {
                if ((turned[lane] & beside[lane]) == 0) continue;
                const float distance = gap_between(group.place.at(lane), own.place);
                if (distance <= width)
                    open[count++] = {distance, static_cast<std::uint32_t>(at.node * lanes + lane),
                                     at.level - 1};
            }
            std::sort(open.begin() + first, open.begin() + count,
                      [](const Near& a, const Near& b) { return a.distance > b.distance; });
        }
    }

  private:
    struct Bounds {
        Box place, forward, outside;
    };
    struct Group {
        Boxes place, forward, outside;
    };

    static constexpr std::size_t max_levels = 12;  // 8^11 edges are more than there are numbers

    static Box opposite(const Box& box, float reach) {
        return {(-box.max.array() - reach).matrix(), (-box.min.array() + reach).matrix()};
    }
    // Not more than the distance.
    static float gap_between(const Box& a, const Box& b) {
        return 0.999999f * (a.min - b.max).cwiseMax(b.min - a.max).cwiseMax(0.0f).norm();
    }

    std::vector<std::uint32_t> order_;        // the edges
    std::vector<Bounds> bounds_;              // of the groups of edges
    std::vector<std::vector<Group>> levels_;  // the last has one
};

}  // namespace slipface::doctor
