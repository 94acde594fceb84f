// The leaf of each triangle.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <utility>
#include <vector>

namespace slipface::detail {

// As many bits per triangle as the highest index of a leaf has: 13 for two thousand triangles, 23 for a
// million.
class TriangleLeaves {
  public:
    TriangleLeaves() = default;
    TriangleLeaves(std::size_t triangles, std::size_t leaves)
        : size_(triangles),
          width_(static_cast<unsigned>(std::bit_width(leaves))),
          bytes_((triangles * width_ + 7) / 8 + sizeof(std::uint64_t)) {}

    std::size_t size() const { return size_; }
    std::size_t bytes() const { return bytes_.capacity(); }
    std::uint32_t operator[](std::size_t triangle) const {
        const std::size_t bit = triangle * width_;
        return static_cast<std::uint32_t>(load(bit) >> (bit & 7U) & mask());
    }
    // The leaf is below `leaves`. Not to be called by two threads at once: neighbours share bytes.
    void set(std::size_t triangle, std::uint32_t leaf) {
        const std::size_t bit = triangle * width_;
        const unsigned shift = bit & 7U;
        const std::uint64_t all = (load(bit) & ~(mask() << shift)) | std::uint64_t{leaf} << shift;
        std::memcpy(&bytes_[bit / 8], &all, sizeof all);
    }
    // Makes room for more leaves.
    void grow(std::size_t leaves) {
        if (leaves <= mask()) return;
        TriangleLeaves wide(size_, leaves);
        for (std::size_t i = 0; i < size_; ++i)
            wide.set(i, (*this)[i]);
        *this = std::move(wide);
    }
    friend bool operator==(const TriangleLeaves&, const TriangleLeaves&) = default;

  private:
    std::uint64_t mask() const { return (std::uint64_t{1} << width_) - 1; }
    std::uint64_t load(std::size_t bit) const {
        std::uint64_t all;
        std::memcpy(&all, &bytes_[bit / 8], sizeof all);
        return all;
    }

    std::size_t size_ = 0;
    unsigned width_ = 0;
    std::vector<unsigned char> bytes_;  // some more than needed, so that eight can always be read
};

}  // namespace slipface::detail
