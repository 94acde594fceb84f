// Which part of a triangle is touched.
#pragma once

#include <cstdint>

namespace slipface {

// The part of the triangle that was touched first. The order is the order of preference when several are
// touched at the same time.
enum class Feature : std::uint8_t { interior, edge, vertex };

const char* feature_name(Feature feature);

}  // namespace slipface
