// The boxes that the construction of the tree sorts: of single triangles, and of grid cells with several
// triangles.
#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

#include "simd/four.h"

namespace slipface::detail {

// x, y, z; the fourth component is unused.
struct Box {
    Four min = Four::all(std::numeric_limits<float>::infinity());
    Four max = Four::all(-std::numeric_limits<float>::infinity());

    void add(const Box& other) {
        min = four_min(min, other.min);
        max = four_max(max, other.max);
    }
    void add(Four point) { add({point, point}); }
    // Half the surface area; not finite if floats overflow, 0 for an empty box.
    float area() const {
        alignas(16) float d[4];
        (max - min).store(d);
        return d[0] >= 0.0F ? d[0] * d[1] + d[1] * d[2] + d[2] * d[0] : 0.0F;
    }
};

struct alignas(16) Item {
    float min[3];
    std::uint32_t triangle;
    float max[3];
    std::uint32_t body;

    std::uint32_t weight() const { return 1; }
};

struct alignas(16) Cell {
    float min[3];
    std::uint32_t first;  // its items are consecutive in a list
    float max[3];
    std::uint32_t count;

    std::uint32_t weight() const { return count; }
};

class ItemList {
  public:
    ItemList() = default;
    // Of undefined items.
    explicit ItemList(std::size_t size) : items_(std::make_unique_for_overwrite<Item[]>(size)), size_(size) {}

    Item* begin() { return items_.get(); }
    std::size_t size() const { return size_; }

  private:
    std::unique_ptr<Item[]> items_;
    std::size_t size_ = 0;
};

// Short lists, of which many tasks need one after the other. They are used again, because what a task leaves
// in memory would soon fill the gaps between them.
class ItemLists {
  public:
    // At least `size` long.
    ItemList take(std::size_t size) {
        if (size > short_list) return ItemList(size);
        const std::scoped_lock lock(mutex_);
        if (spare_.empty()) return ItemList(short_list);
        ItemList list = std::move(spare_.back());
        spare_.pop_back();
        return list;
    }
    // Any list, which may be one that was taken.
    void give_back(ItemList list) {
        if (list.size() != short_list) return;
        const std::scoped_lock lock(mutex_);
        spare_.push_back(std::move(list));
    }

  private:
    static constexpr std::size_t short_list = 4096;

    std::mutex mutex_;
    std::vector<ItemList> spare_;
};

// The fourth component holds the bits of an integer, which arithmetic must not see: as a float it could be a
// denormal, which is slow.
template <class Boxed>
Box box_of(const Boxed& boxed) {
    return {Four::load(boxed.min).first_three(), Four::load(boxed.max).first_three()};
}
// Halved before adding, because the sum of the largest floats would overflow.
template <class Boxed>
Four centre_of(const Boxed& boxed) {
    const Box box = box_of(boxed);
    const Four half = Four::all(0.5F);
    return half * box.min + half * box.max;
}

}  // namespace slipface::detail
