// slipface_build_memory: what a world keeps in memory, and how much more its construction needs at its peak,
// in bytes per triangle, by counting what is allocated.
#include <fmt/core.h>
#include <fmt/format.h>
#include <malloc.h>

#include <atomic>
#include <cstdlib>
#include <new>

#include "bench_scenes.h"

namespace {

std::atomic<std::size_t> in_use = 0, peak = 0;

void* counted(void* memory) {
    if (memory == nullptr) throw std::bad_alloc();
    const std::size_t now = in_use += malloc_usable_size(memory);
    std::size_t before = peak;
    while (now > before && !peak.compare_exchange_weak(before, now)) {
    }
    return memory;
}

void release(void* memory) {
    if (memory != nullptr) in_use -= malloc_usable_size(memory);
    std::free(memory);
}

}  // namespace

void* operator new(std::size_t size) {
    return counted(std::malloc(size));
}
void* operator new(std::size_t size, std::align_val_t alignment) {
    const auto unit = static_cast<std::size_t>(alignment);
    return counted(std::aligned_alloc(unit, (size + unit - 1) / unit * unit));
}
void operator delete(void* memory) noexcept {
    release(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
    release(memory);
}
void operator delete(void* memory, std::align_val_t) noexcept {
    release(memory);
}
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept {
    release(memory);
}

int main() {
    using namespace slipface::bench;
    fmt::print("| level | triangles | kept | more while building |\n|---|---:|---:|---:|\n");
    for (const auto kind : {Kind::rooms, Kind::ground}) {
        for (const std::int64_t size : {7000, 30000, 120000, 1000000}) {
            const auto soup = make_soup(kind, size);
            const auto view = soup.view();
            const std::size_t before = in_use;
            peak = before;
            const auto world = slipface::CollisionWorld::build(view);
            if (!world) return EXIT_FAILURE;
            const auto count = static_cast<double>(soup.triangles.size());
            const std::size_t after = in_use;
            fmt::print("| {} | {} | {:.1f} | {:.1f} |\n", kind == Kind::rooms ? "rooms" : "ground",
                       soup.triangles.size(), static_cast<double>(after - before) / count,
                       static_cast<double>(peak - after) / count);
        }
    }
    return EXIT_SUCCESS;
}
