#include "facing_edges.h"

#include <algorithm>
#include <cmath>

#include "near_sort.h"
#include "slipface/base/key_sort.h"

namespace slipface::doctor {
namespace {

// What stands together: edges of about one length, in them those of a part of space that a search sees at
// once, in them those of about one direction, in them those near each other.
std::vector<std::uint32_t> sorted(std::span<const OpenEdge> edges, double width) {
    std::vector<Vec3f> centre(edges.size());
    Box all;
    for (std::size_t i = 0; i < edges.size(); ++i) {
        centre[i] = (0.5 * (edges[i].a + edges[i].b)).cast<float>();
        all.add(centre[i], centre[i]);
    }
    const auto key_of = [&](std::uint32_t i) {
        const OpenEdge& edge = edges[i];
        const int size = std::clamp(std::ilogb(edge.length) / 2, -31, 31);  // a factor of four
        const double cell = std::max({width, std::ldexp(1.0, 2 * size), double(all.extent()) / 1024.0});
        std::uint64_t key = static_cast<std::uint64_t>(size + 32) << 30U |
                            interleaved((centre[i] - all.min) / static_cast<float>(cell));
        const Vec3 forward = edge.forward();
        for (int axis = 0; axis < 3; ++axis)
            key = key << 5U | static_cast<std::uint64_t>(std::clamp(16.0 * (forward[axis] + 1.0), 0.0, 31.0));
        for (int axis = 0; axis < 3; ++axis)
            key = key << 2U |
                  static_cast<std::uint64_t>(std::clamp(2.0 * (edge.outside[axis] + 1.0), 0.0, 3.0));
        return key << 7U;  // sort_by_key() looks at the first bits first
    };
    std::vector<KeyedIndex> keys(edges.size());
    for (std::uint32_t i = 0; i < edges.size(); ++i)
        keys[i] = {key_of(i), i};
    sort_by_key(keys);
    std::vector<NearItem> items(edges.size()), spare(edges.size());
    for (std::size_t i = 0; i < items.size(); ++i)
        items[i].id = keys[i].index;
    for (std::size_t first = 0, last = 0; first < items.size(); first = last) {
        while (last < items.size() && keys[last].key == keys[first].key)
            ++last;
        sort_near(std::span(items).subspan(first, last - first), spare, centre);
    }
    std::vector<std::uint32_t> order(items.size());
    for (std::size_t i = 0; i < order.size(); ++i)
        order[i] = items[i].id;
    return order;
}

}  // namespace

std::vector<OpenEdge> open_edges(const Topology& topology) {
    std::vector<OpenEdge> open;
    topology.each_edge([&](std::size_t first, std::size_t last) {
        if (last - first != 1) return;
        const EdgeUse& use = topology.edges[first];
        OpenEdge edge{
            use, topology.position[use.from], topology.position[use.to], {}, {}, topology.normal[use.face],
            0.0};
        edge.length = (edge.b - edge.a).norm();
        if (!(edge.length > 0.0) || edge.normal.isZero()) return;
        edge.along = (edge.b - edge.a) / edge.length;
        edge.outside = edge.forward().cross(edge.normal).normalized();
        open.push_back(edge);
    });
    return open;
}

bool goes_on(const OpenEdge& edge, const OpenEdge& other) {
    return edge.forward().dot(other.forward()) < -0.999 && edge.outside.dot(other.outside) < -0.5 &&
           edge.normal.dot(other.normal) > 0.5;
}

FacingEdges::FacingEdges(std::span<const OpenEdge> edges, double width) : order_(sorted(edges, width)) {
    std::vector<Bounds> below(edges.size());
    for (std::size_t i = 0; i < below.size(); ++i) {
        const OpenEdge& edge = edges[order_[i]];
        below[i].place.add(edge.a.cast<float>(), edge.a.cast<float>());
        below[i].place.add(edge.b.cast<float>(), edge.b.cast<float>());
        below[i].forward.min = below[i].forward.max = edge.forward().cast<float>();
        below[i].outside.min = below[i].outside.max = edge.outside.cast<float>();
    }
    while (levels_.empty() ? !below.empty() : below.size() > 1) {
        std::vector<Group> level((below.size() + lanes - 1) / lanes);
        std::vector<Bounds> around(level.size());
        for (std::size_t i = 0; i < below.size(); ++i) {
            Group& group = level[i / lanes];
            Bounds& all = around[i / lanes];
            group.place.set(i % lanes, below[i].place);
            group.forward.set(i % lanes, below[i].forward);
            group.outside.set(i % lanes, below[i].outside);
            all.place.add(below[i].place.min, below[i].place.max);
            all.forward.add(below[i].forward.min, below[i].forward.max);
            all.outside.add(below[i].outside.min, below[i].outside.max);
        }
        if (levels_.empty()) bounds_ = around;
        levels_.push_back(std::move(level));
        below.swap(around);
    }
}

}  // namespace slipface::doctor
