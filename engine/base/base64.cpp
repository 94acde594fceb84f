#include "slipface/base/base64.h"

#include <algorithm>
#include <array>

namespace slipface {
namespace {

constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/",
                           address_digits =
                               "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-_";

constexpr std::string_view digits_of(Base64 form) {
    return form == Base64::address ? address_digits : digits;
}

}  // namespace

std::string to_base64(std::string_view bytes, Base64 form) {
    const std::string_view digit = digits_of(form);
    std::string text((bytes.size() * 4 + 2) / 3, '\0');
    std::size_t out = 0;
    for (std::size_t at = 0; at < bytes.size(); at += 3) {
        const std::size_t count = std::min<std::size_t>(3, bytes.size() - at);
        std::uint32_t group = 0;
        for (std::size_t i = 0; i < 3; ++i)
            group = group << 8U | (i < count ? static_cast<unsigned char>(bytes[at + i]) : 0U);
        for (std::size_t i = 0; i <= count; ++i)
            text[out++] = digit[group >> (18U - 6U * i) & 63U];
    }
    if (form == Base64::padded) text.resize((bytes.size() + 2) / 3 * 4, '=');
    return text;
}

std::optional<std::string> from_base64(std::string_view text, Base64 form) {
    std::array<int, 256> values{};
    values.fill(-1);
    const std::string_view digit = digits_of(form);
    for (std::size_t i = 0; i < digit.size(); ++i)
        values[static_cast<unsigned char>(digit[i])] = static_cast<int>(i);
    std::string bytes(text.size() * 3 / 4, '\0');
    std::size_t out = 0;
    std::uint32_t group = 0;
    int bits = 0;
    for (const char c : text) {
        const int value = values[static_cast<unsigned char>(c)];
        if (value < 0) return std::nullopt;
        group = (group << 6U | static_cast<std::uint32_t>(value)) & 0xFFFFU;
        bits += 6;
        if (bits < 8) continue;
        bits -= 8;
        bytes[out++] = static_cast<char>(group >> bits);
    }
    return bytes;
}

}  // namespace slipface
