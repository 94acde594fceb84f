#include "tree/pack_leaf.h"

#include <algorithm>
#include <bit>

#include "tree/leaf.h"

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

namespace slipface::detail {
namespace {

// How often one byte is doubled to hold the distance from the lowest number to the highest.
std::uint32_t offset_width(std::span<const LeafTriangle> triangles) {
    const std::uint32_t most = triangles.back().id - triangles.front().id;
    return most < 0x100U ? 0 : most < 0x10000U ? 1 : 2;
}

// [3 * lane + corner]
using PerCorner = std::array<std::uint32_t, std::size_t{3} * leaf_capacity>;

// What is different among some numbers, in the order of their corners.
struct Numbered {
    alignas(16) std::array<std::uint8_t, 32> number;  // [corner]
    PerCorner first;                                  // [number] the first corner that has it
    std::uint32_t count = 0;

    Numbered(const PerCorner& keys, std::size_t corners) {
        std::uint32_t left = (1U << corners) - 1;
#if defined(__SSE2__)
        __m128i all[6];
        for (std::size_t i = 0; i < 6; ++i)
            all[i] = _mm_loadu_si128(reinterpret_cast<const __m128i*>(&keys[4 * i]));
        __m128i low = _mm_setzero_si128(), high = low;
        for (; left != 0; ++count) {
            first[count] = static_cast<std::uint32_t>(std::countr_zero(left));
            const __m128i key = _mm_set1_epi32(static_cast<int>(keys[first[count]]));
            const auto pair = [&](std::size_t i) {
                return _mm_packs_epi32(_mm_cmpeq_epi32(all[i], key), _mm_cmpeq_epi32(all[i + 1], key));
            };
            const __m128i equal_low = _mm_packs_epi16(pair(0), pair(2));
            const __m128i equal_high = _mm_packs_epi16(pair(4), _mm_setzero_si128());
            const __m128i its = _mm_set1_epi8(static_cast<char>(count));
            low = _mm_or_si128(low, _mm_and_si128(equal_low, its));
            high = _mm_or_si128(high, _mm_and_si128(equal_high, its));
            left &= ~static_cast<std::uint32_t>(_mm_movemask_epi8(equal_low) | _mm_movemask_epi8(equal_high)
                                                                                   << 16);
        }
        _mm_store_si128(reinterpret_cast<__m128i*>(number.data()), low);
        _mm_store_si128(reinterpret_cast<__m128i*>(number.data() + 16), high);
#else
        for (; left != 0; ++count) {
            first[count] = static_cast<std::uint32_t>(std::countr_zero(left));
            for (std::size_t corner = first[count]; corner < corners; ++corner) {
                if (keys[corner] != keys[first[count]]) continue;
                number[corner] = static_cast<std::uint8_t>(count);
                left &= ~(1U << corner);
            }
        }
#endif
    }
};

}  // namespace

PackedLeaf::PackedLeaf(std::span<const LeafTriangle> triangles, bool by_axis) : triangles_(triangles) {
    const std::size_t corners = 3 * triangles.size();
    std::array<PerCorner, 3> bits{};
    for (std::size_t lane = 0; lane < triangles.size(); ++lane) {
        for (std::size_t axis = 0; axis < 3; ++axis)
            std::memcpy(&bits[axis][3 * lane], triangles[lane].at[axis], 12);
    }
    const Numbered x(bits[0], corners), y(bits[1], corners), z(bits[2], corners);
    PerCorner keys{};
    for (std::size_t corner = 0; corner < corners; ++corner)
        keys[corner] =
            x.number[corner] | std::uint32_t{y.number[corner]} << 5 | std::uint32_t{z.number[corner]} << 10;
    const Numbered vertices(keys, corners);
    // Two more rows take as much as eight values.
    by_axis_ = by_axis && x.count + y.count + z.count + 8 < 3 * vertices.count;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const Numbered& its = !by_axis_ ? vertices : axis == 0 ? x : axis == 1 ? y : z;
        counts_[axis] = static_cast<std::uint8_t>(its.count);
        for (std::size_t i = 0; i < its.count; ++i)
            values_[axis][i] = bits[axis][its.first[i]];
        for (std::size_t lane = 0; lane < triangles.size(); ++lane)
            corners_[axis][lane] = static_cast<std::uint16_t>(
                its.number[3 * lane] | its.number[3 * lane + 1] << 5 | its.number[3 * lane + 2] << 10);
    }
}

std::size_t PackedLeaf::bytes() const {
    const std::size_t values = std::size_t{counts_[0]} + counts_[1] + counts_[2];
    const std::size_t all = bytes_before() + sizeof(Leaf) + leaf_row_bytes + 4 * values +
                            (triangles_.size() << offset_width(triangles_));
    return (all + leaf_alignment - 1) / leaf_alignment * leaf_alignment;
}

void PackedLeaf::write(std::byte* to) const {
    const std::size_t count = triangles_.size();
    const std::byte* end = to + bytes();
    const auto add = [&to](const void* from, std::size_t size) {
        std::memcpy(to, from, size);
        to += size;
    };
    const auto add_row = [&](std::size_t axis) {
        std::array<std::uint16_t, leaf_capacity> row = corners_[axis];
        std::fill(row.begin() + static_cast<std::ptrdiff_t>(count), row.end(), row[count - 1]);
        add(row.data(), sizeof row);
    };
    for (std::size_t axis = 2; by_axis_ && axis > 0; --axis)
        add_row(axis);
    const std::uint32_t width = offset_width(triangles_);
    const Leaf head{
        triangles_.front().id,
        {counts_[0], counts_[1], counts_[2]},
        static_cast<std::uint8_t>(count | (by_axis_ ? leaf_by_axis : 0U) | leaf_width_unit * width)};
    add(&head, sizeof head);
    add_row(0);
    for (std::size_t axis = 0; axis < 3; ++axis)
        add(values_[axis].data(), std::size_t{4} * counts_[axis]);
    for (const LeafTriangle& triangle : triangles_) {
        const std::uint32_t offset = triangle.id - head.first_id;
        add(&offset, std::size_t{1} << width);  // the lowest bytes come first
    }
    for (; to != end; ++to)
        *to = std::byte{0};
}

}  // namespace slipface::detail
