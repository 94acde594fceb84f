#include "near_bodies.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "slipface/base/parallel.h"

namespace slipface {

namespace {

constexpr std::size_t grain = 64;

// Beyond it everything is in the last cell.
std::int32_t cell_along(double position, double edge) {
    constexpr double last = 1 << 30;
    const double cell = std::floor(position / edge);
    return cell > -last ? static_cast<std::int32_t>(std::min(cell, last)) : -static_cast<std::int32_t>(last);
}

// [bucket] where its items begin; the last entry is their number. Then the items.
void sort_into(std::span<const std::uint32_t> bucket_of, std::size_t buckets,
               std::vector<std::uint32_t>& starts, std::vector<std::uint32_t>& items) {
    starts.assign(buckets + 1, 0);
    for (const std::uint32_t bucket : bucket_of)
        ++starts[bucket];
    std::uint32_t sum = 0;
    for (std::uint32_t& start : starts)
        start = sum += start;
    items.resize(bucket_of.size());
    for (std::size_t i = bucket_of.size(); i-- > 0;)
        items[--starts[bucket_of[i]]] = static_cast<std::uint32_t>(i);
}

// Every third bit.
std::uint32_t spread(std::uint32_t five_bits) {
    std::uint32_t bits = 0;
    for (std::uint32_t i = 0; i < 5; ++i)
        bits |= (five_bits >> i & 1U) << 3 * i;
    return bits;
}

}  // namespace

Vec3 NearBodies::edge(int level) const {
    return least_ * std::ldexp(1.0, level);
}

NearBodies::Cell NearBodies::cell_of(const Vec3& at, int level) const {
    const Vec3 cell = edge(level);
    return {cell_along(at.x(), cell.x()), cell_along(at.y(), cell.y()), cell_along(at.z(), cell.z()), level};
}

std::size_t NearBodies::bucket(const Cell& cell) const {
    const auto part = [](std::int32_t number, std::uint64_t factor) {
        return static_cast<std::uint32_t>(number) * factor;
    };
    const std::uint64_t hash = part(cell.x, 0x9e3779b97f4a7c15ULL) ^ part(cell.y, 0xbf58476d1ce4e5b9ULL) ^
                               part(cell.z, 0x94d049bb133111ebULL) ^ part(cell.level, 0xd6e8feb86659fd93ULL);
    return (hash >> 40) & (starts_.size() - 2);
}

void NearBodies::find(std::span<const Aabb> rooms, std::span<const Vec3> places) {
    const std::size_t count = rooms.size();
    Vec3 smallest = Vec3::Constant(std::numeric_limits<double>::infinity()), largest = Vec3::Zero();
    for (const Aabb& room : rooms) {
        smallest = smallest.cwiseMin(room.size());
        largest = largest.cwiseMax(room.size());
    }
    // Of large cells few have to be looked at, and small ones hold few bodies.
    least_ = (3.0 * smallest).cwiseMax(1e-6 * largest);
    cells_.resize(count);
    levels_.clear();
    for (std::size_t i = 0; i < count; ++i) {
        const double times = rooms[i].size().cwiseQuotient(least_).maxCoeff();
        const int level = times > 1.0 ? std::ilogb(times) + 1 : 0;
        cells_[i] = cell_of(0.5 * (rooms[i].min + rooms[i].max), level);
        auto found =
            std::find_if(levels_.begin(), levels_.end(), [&](const Level& l) { return l.level == level; });
        if (found == levels_.end()) found = levels_.insert(found, {level, Vec3::Zero()});
        found->reach = found->reach.cwiseMax(0.5 * rooms[i].size());
    }

    std::size_t buckets = 1;
    while (buckets < count)
        buckets *= 2;
    starts_.resize(buckets + 1);
    std::vector<std::uint32_t> bucket_of(count);
    for (std::size_t i = 0; i < count; ++i)
        bucket_of[i] = static_cast<std::uint32_t>(bucket(cells_[i]));
    sort_into(bucket_of, buckets, starts_, bodies_);

    lists_.assign(count, {});
    parallel_for(count, grain, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i)
            list(static_cast<std::uint32_t>(i), rooms);
    });
    // A larger body has not looked among the smaller ones.
    for (std::uint32_t i = 0; levels_.size() > 1 && i < count; ++i)
        for (std::size_t k = 0; k < lists_[i].size(); ++k)
            if (const std::uint32_t other = lists_[i][k]; cells_[other].level > cells_[i].level)
                add(other, i);
    parallel_for(count, grain, [&](std::size_t first, std::size_t last) {
        const auto key = [&](std::uint32_t body) {
            const Vec3& at = places[body];
            return std::tuple(at.y(), at.x(), at.z(), body);
        };
        for (std::size_t i = first; i < last; ++i)
            std::sort(lists_[i].begin(), lists_[i].end(),
                      [&](std::uint32_t a, std::uint32_t b) { return key(a) < key(b); });
    });
}

void NearBodies::list(std::uint32_t body, std::span<const Aabb> rooms) {
    const Aabb& room = rooms[body];
    const auto touches = [&](const Aabb& other) {
        return (room.min.array() <= other.max.array()).all() && (other.min.array() <= room.max.array()).all();
    };
    for (const Level& of : levels_) {
        if (of.level < cells_[body].level) continue;
        const Cell first = cell_of(room.min - of.reach, of.level),
                   last = cell_of(room.max + of.reach, of.level);
        Cell at = first;
        for (at.z = first.z; at.z <= last.z; ++at.z)
            for (at.y = first.y; at.y <= last.y; ++at.y)
                for (at.x = first.x; at.x <= last.x; ++at.x) {
                    const std::size_t index = bucket(at);
                    const auto begin = bodies_.begin() + starts_[index],
                               end = bodies_.begin() + starts_[index + 1];
                    // From behind the body on and around, so that those of a pile do not all list the same
                    // ones.
                    const auto behind = std::upper_bound(begin, end, body);
                    for (const auto& [from, to] : {std::pair(behind, end), std::pair(begin, behind)})
                        for (auto other = from; other != to && lists_[body].size() < most; ++other)
                            if (*other != body && cells_[*other] == at && touches(rooms[*other]))
                                add(body, *other);
                }
    }
}

std::vector<std::uint32_t> spatial_order(std::span<const Vec3> places) {
    constexpr double steps = 31.0;
    Aabb box;
    for (const Vec3& place : places)
        box.add(place);
    const double scale = steps / std::max(box.size().maxCoeff(), 1e-3);
    std::vector<std::uint32_t> bucket_of, starts, order;
    bucket_of.reserve(places.size());
    for (const Vec3& place : places) {
        const Vec3 at = (place - box.min) * scale;
        std::uint32_t bucket = 0;
        for (int axis = 0; axis < 3; ++axis)
            bucket |= spread(static_cast<std::uint32_t>(std::min(steps, at[axis]))) << axis;
        bucket_of.push_back(bucket);
    }
    sort_into(bucket_of, 1U << 15, starts, order);
    return order;
}

}  // namespace slipface
