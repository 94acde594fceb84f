// Numbers of things in messages.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace slipface {

// "1 face", "3 faces"; `many` where it is not `one` with an s: counted(n, "image matches", "images match").
std::string counted(std::size_t count, std::string_view one, std::string_view many = {});

}  // namespace slipface
