// 64-bit FNV-1a, for fingerprints and for comparing runs bit by bit. Not for security.
#pragma once

#include <array>
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
            state_ = (state_ ^ byte[i]) * prime;
    }
    void text(std::string_view text) { bytes(text.data(), text.size()); }
    // Hashes the eight bytes of `value`, lowest byte first. A zero byte is only a multiplication, so the high
    // zero bytes of a small number cost one product. This matters: states are hashed every tick and contain
    // many small numbers.
    void u64(std::uint64_t value) {
        std::size_t left = 8;
        for (; value != 0; value >>= 8, --left)
            state_ = (state_ ^ (value & 0xff)) * prime;
        state_ *= powers[left];
    }
    // Hashes the bits of `value`. -0 counts as 0, so that equal numbers hash equally.
    void f64(double value) {
        const double canonical = value == 0.0 ? 0.0 : value;
        std::uint64_t bits = 0;
        std::memcpy(&bits, &canonical, sizeof bits);
        u64(bits);
    }
    std::uint64_t value() const { return state_; }

  private:
    static constexpr std::uint64_t prime = 0x100000001b3ULL;
    static constexpr std::array<std::uint64_t, 9> powers = [] {
        std::array<std::uint64_t, 9> power{1};
        for (std::size_t i = 1; i < power.size(); ++i)
            power[i] = power[i - 1] * prime;
        return power;
    }();
    std::uint64_t state_ = 0xcbf29ce484222325ULL;
};

// Hash of a large buffer, computed on all cores. The result does not depend on their number. It is not
// FNV-1a: it reads eight bytes at a time.
std::uint64_t hash_blocks(const void* data, std::size_t size);

}  // namespace slipface
