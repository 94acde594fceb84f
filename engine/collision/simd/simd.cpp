#include "slipface/collision/simd.h"

#include <array>
#include <atomic>
#include <cstdlib>
#include <span>

#include "simd/kernels.h"

namespace slipface {
namespace {

using detail::Kernels;

// Of fixed size, because the first query of a program uses it, and queries allocate nothing.
struct Supported {
    std::array<const Kernels*, 3> kernels{&detail::baseline_kernels};
    std::size_t count = 1;
    void push_back(const Kernels* more) { kernels[count++] = more; }
    std::span<const Kernels* const> list() const { return std::span(kernels).first(count); }
};

Supported supported() {
    Supported list;
#if defined(__x86_64__)
    __builtin_cpu_init();
    const bool avx2 = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
    if (avx2) list.push_back(&detail::avx2_kernels);
    if (avx2 && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") &&
        __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512bw")) {
        list.push_back(&detail::avx512_kernels);
    }
#endif
    return list;
}

const Kernels* find(std::string_view name) {
    for (const Supported all = supported(); const Kernels* kernels : all.list()) {
        if (kernels->name == name) return kernels;
    }
    return nullptr;
}

const Kernels* first_choice() {
    const char* wanted = std::getenv("SLIPFACE_SIMD");
    const Kernels* found = wanted != nullptr ? find(wanted) : nullptr;
    if (found != nullptr) return found;
    const Supported all = supported();
    return all.list().back();
}

std::atomic<const Kernels*>& chosen() {
    static std::atomic<const Kernels*> kernels = first_choice();
    return kernels;
}

}  // namespace

const Kernels& detail::kernels() {
    return *chosen().load(std::memory_order_relaxed);
}

std::vector<std::string_view> simd_paths() {
    std::vector<std::string_view> names;
    for (const Supported all = supported(); const Kernels* kernels : all.list())
        names.emplace_back(kernels->name);
    return names;
}

std::string_view simd_path() {
    return detail::kernels().name;
}

bool set_simd_path(std::string_view name) {
    const Kernels* kernels = find(name);
    if (kernels != nullptr) chosen() = kernels;
    return kernels != nullptr;
}

}  // namespace slipface
