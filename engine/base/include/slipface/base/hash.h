// 64-bit FNV-1a, for fingerprints and for comparing runs bit by bit. Not for security.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string_view>

namespace slipface {

class Hasher {
  public:
    void bytes(const void* data, std::size_t size) {
        const auto* byte = static_cast<const unsigned char*>(data);
        for (std::size_t i = 0; i < size; ++i)
            state_ = (state_ ^ byte[i]) * 0x100000001b3ULL;
    }
    void text(std::string_view text) { bytes(text.data(), text.size()); }
    void u64(std::uint64_t value) { bytes(&value, sizeof value); }
    // The bits of the value, with -0 counted as 0 so that equal numbers hash equally.
    void f64(double value) {
        const double canonical = value == 0.0 ? 0.0 : value;
        std::uint64_t bits = 0;
        std::memcpy(&bits, &canonical, sizeof bits);
        u64(bits);
    }
    std::uint64_t value() const { return state_; }

  private:
    std::uint64_t state_ = 0xcbf29ce484222325ULL;
};

// Of many bytes, on all cores; the same whatever their number. Not FNV-1a: eight bytes at a time.
std::uint64_t hash_blocks(const void* data, std::size_t size);

}  // namespace slipface
