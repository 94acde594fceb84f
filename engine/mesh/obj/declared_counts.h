#pragma once

#include <string>
#include <string_view>

#include "slipface/base/result.h"

namespace slipface {

// Refuses PLY and OFF files that declare more elements than they have bytes: assimp allocates memory for all
// of them before it reads the first.
Status check_declared_counts(const std::string& extension, std::string_view bytes,
                             const std::string& location);

}  // namespace slipface
