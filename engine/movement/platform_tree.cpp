#include "slipface/movement/platform_tree.h"

#include <algorithm>
#include <numeric>

namespace slipface {

namespace {

Vec3 middle(const Aabb& box) {
    return box.empty() ? Vec3(Vec3::Zero()) : Vec3(0.5 * (box.min + box.max));
}

}  // namespace

void PlatformTree::build(std::span<const Aabb> places) {
    nodes_.clear();
    nodes_.reserve(2 * places.size());
    std::vector<std::uint32_t> platforms(places.size());
    std::iota(platforms.begin(), platforms.end(), 0U);
    leaf_.resize(places.size());
    if (!platforms.empty()) add(platforms, places, 0);
}

void PlatformTree::add(std::span<std::uint32_t> platforms, std::span<const Aabb> places, std::size_t parent) {
    const std::size_t index = nodes_.size();
    nodes_.emplace_back().parent = static_cast<std::uint32_t>(parent);
    if (platforms.size() == 1) {
        nodes_[index].platform = platforms[0];
        leaf_[platforms[0]] = static_cast<std::uint32_t>(index);
    } else {
        Aabb middles;
        for (const std::uint32_t platform : platforms)
            middles.add(middle(places[platform]));
        Eigen::Index axis = 0;
        (middles.max - middles.min).maxCoeff(&axis);
        const auto half = static_cast<std::ptrdiff_t>(platforms.size() / 2);
        std::nth_element(platforms.begin(), platforms.begin() + half, platforms.end(),
                         [&](std::uint32_t a, std::uint32_t b) {
                             const double left = middle(places[a])[axis], right = middle(places[b])[axis];
                             return left != right ? left < right : a < b;
                         });
        add(platforms.first(static_cast<std::size_t>(half)), places, index);
        add(platforms.subspan(static_cast<std::size_t>(half)), places, index);
    }
    nodes_[index].next = static_cast<std::uint32_t>(nodes_.size());
}

void PlatformTree::unite(std::size_t node) {
    const Aabb &left = nodes_[node + 1].box, &right = nodes_[nodes_[node + 1].next].box;
    nodes_[node].box = {left.min.cwiseMin(right.min), left.max.cwiseMax(right.max)};
}

void PlatformTree::refit(std::span<const Aabb> rooms) {
    for (std::size_t i = nodes_.size(); i-- > 0;) {
        if (nodes_[i].platform == no_id) {
            unite(i);
        } else {
            nodes_[i].box = rooms[nodes_[i].platform];
        }
    }
}

void PlatformTree::move(std::uint32_t platform, const Aabb& room) {
    std::size_t node = leaf_[platform];
    nodes_[node].box = room;
    while (node != 0)
        unite(node = nodes_[node].parent);
}

}  // namespace slipface
