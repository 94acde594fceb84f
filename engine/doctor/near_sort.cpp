#include "near_sort.h"

#include <algorithm>
#include <array>
#include <numeric>

#include "boxes.h"

namespace slipface::doctor {
namespace {

// Stable, by ten bits of the keys.
void sort_by_digit(std::span<const NearItem> from, std::span<NearItem> to, unsigned shift) {
    std::array<std::uint32_t, 1025> begin{};
    const auto digit = [&](const NearItem& item) { return (item.key >> shift) & 1023U; };
    for (const NearItem& item : from)
        ++begin[digit(item) + 1];
    std::partial_sum(begin.begin(), begin.end(), begin.begin());
    for (const NearItem& item : from)
        to[begin[digit(item)]++] = item;
}

}  // namespace

std::uint32_t interleaved(const Vec3f& cell) {
    std::uint32_t key = 0;
    for (int axis = 0; axis < 3; ++axis) {
        std::uint32_t bits = std::min(static_cast<std::uint32_t>(cell[axis]), 1023U);
        bits = (bits | bits << 16U) & 0x030000ffU;
        bits = (bits | bits << 8U) & 0x0300f00fU;
        bits = (bits | bits << 4U) & 0x030c30c3U;
        bits = (bits | bits << 2U) & 0x09249249U;
        key |= bits << static_cast<unsigned>(axis);
    }
    return key;
}

void sort_near(std::span<NearItem> items, std::span<NearItem> spare, std::span<const Vec3f> centre) {
    Box box;
    for (const NearItem& item : items)
        box.add(centre[item.id], centre[item.id]);
    const float extent = (box.max - box.min).maxCoeff();
    if (!(extent > 0.0f)) return;
    for (NearItem& item : items)
        item.key = interleaved((centre[item.id] - box.min) * (1024.0f / extent));
    if (items.size() < 1024) {
        std::sort(items.begin(), items.end(), [](const NearItem& a, const NearItem& b) {
            return a.key != b.key ? a.key < b.key : a.id < b.id;
        });
    } else {
        spare = spare.first(items.size());
        sort_by_digit(items, spare, 0);
        sort_by_digit(spare, items, 10);
        sort_by_digit(items, spare, 20);
        std::copy(spare.begin(), spare.end(), items.begin());
    }
    constexpr std::size_t many = 64;  // in one cell, a thousandth of the extent
    for (std::size_t first = 0, last = 0; first < items.size(); first = last) {
        while (last < items.size() && items[last].key == items[first].key)
            ++last;
        if (last - first > many) sort_near(items.subspan(first, last - first), spare, centre);
    }
}

}  // namespace slipface::doctor
