#pragma once

#include <string>

#include "slipface/exchange/rules.h"

namespace slipface {

Result<ImportedRules> read_shaders(std::string_view text, const std::string& location);
Result<ImportedRules> read_bsp_flags(std::string_view bytes, const std::string& location);

}  // namespace slipface
