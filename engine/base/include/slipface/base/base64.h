// Bytes as text: base64. Source: RFC 4648.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace slipface {

// `padded` ends with '=' so that its length is a multiple of 4 (section 4). `plain` is the same without them.
// `address` is without them, too, and has '-' and '_' for '+' and '/', which addresses reserve (section 5).
enum class Base64 : std::uint8_t { padded, plain, address };

std::string to_base64(std::string_view bytes, Base64 form);

// Nothing: `text` has a character of another form. `form` is plain or address.
std::optional<std::string> from_base64(std::string_view text, Base64 form);

}  // namespace slipface
