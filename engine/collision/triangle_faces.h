// The face of each triangle, as an index into the list of all faces.
#pragma once

#include <bit>
#include <cstdint>
#include <vector>

namespace slipface::detail {

// Triangles mostly come in the order of their faces. Then one bit says whether a face begins, and the face of
// a triangle follows from the number of bits up to it: a quarter of a byte per triangle instead of four.
class TriangleFaces {
  public:
    TriangleFaces() = default;
    // `ascending`: each face will be that of the triangle before, or the next one; the first is 0.
    TriangleFaces(bool ascending, std::size_t triangles) : ascending_(ascending) {
        if (ascending)
            blocks_.reserve((triangles + block_size - 1) / block_size);
        else
            list_.reserve(triangles);
    }
    // Adds the face of the next triangle.
    void add(std::uint32_t face) {
        if (!ascending_) {
            list_.push_back(face);
        } else {
            if (size_ % block_size == 0) blocks_.push_back({begun_, 0});
            if (face == begun_) {
                blocks_.back().begins |= 1U << size_ % block_size;
                ++begun_;
            }
        }
        ++size_;
    }

    std::uint32_t operator[](std::size_t triangle) const {
        if (!ascending_) return list_[triangle];
        const Block& block = blocks_[triangle / block_size];
        const std::uint32_t up_to = block.begins << (block_size - 1 - triangle % block_size);
        return block.before + static_cast<std::uint32_t>(std::popcount(up_to)) - 1;
    }
    std::size_t size() const { return size_; }
    bool ascending() const { return ascending_; }
    std::size_t bytes() const {
        return blocks_.capacity() * sizeof(Block) + list_.capacity() * sizeof(std::uint32_t);
    }

  private:
    static constexpr std::size_t block_size = 32;
    struct Block {
        std::uint32_t before;  // faces that begin in earlier blocks
        std::uint32_t begins;  // bit k: a face begins with triangle k of the block
    };

    bool ascending_ = true;
    std::vector<Block> blocks_;
    std::vector<std::uint32_t> list_;  // [triangle], if not ascending
    std::size_t size_ = 0;
    std::uint32_t begun_ = 0;  // faces
};

}  // namespace slipface::detail
