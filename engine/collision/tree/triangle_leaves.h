// The leaf of each triangle.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

namespace slipface::detail {

// Three bytes per triangle as long as all leaves have indices below 2^24, then four.
class TriangleLeaves {
  public:
    TriangleLeaves() = default;
    TriangleLeaves(std::size_t triangles, std::size_t leaves)
        : size_(triangles), width_(leaves <= three_bytes ? 3 : 4), bytes_(triangles * width_ + 1) {}

    std::size_t size() const { return size_; }
    std::size_t bytes() const { return bytes_.capacity(); }
    std::uint32_t operator[](std::size_t triangle) const {
        std::uint32_t leaf;
        std::memcpy(&leaf, &bytes_[triangle * width_], sizeof leaf);
        return width_ == 3 ? leaf & 0xffffffU : leaf;
    }
    // The leaf is below `leaves`. May run for other triangles at the same time.
    void set(std::size_t triangle, std::uint32_t leaf) {
        std::memcpy(&bytes_[triangle * width_], &leaf, width_);
    }
    // Makes room for more leaves.
    void grow(std::size_t leaves) {
        if (width_ == 4 || leaves <= three_bytes) return;
        TriangleLeaves wide(size_, leaves);
        for (std::size_t i = 0; i < size_; ++i)
            wide.set(i, (*this)[i]);
        *this = std::move(wide);
    }
    friend bool operator==(const TriangleLeaves&, const TriangleLeaves&) = default;

  private:
    static constexpr std::size_t three_bytes = std::size_t{1} << 24U;

    std::size_t size_ = 0;
    std::size_t width_ = 4;
    std::vector<unsigned char> bytes_;  // one more than needed, so that four can always be read
};

}  // namespace slipface::detail
