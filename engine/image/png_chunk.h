// Numbers in PNG files.
#pragma once

#include <cstdint>
#include <string_view>

namespace slipface {

// The four bytes at `at`, the most significant first. The caller checks that they exist.
inline std::uint32_t big_endian(std::string_view bytes, std::size_t at) {
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < 4; ++i)
        value = value << 8U | static_cast<unsigned char>(bytes[at + i]);
    return value;
}

}  // namespace slipface
