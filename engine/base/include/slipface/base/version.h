#pragma once

namespace slipface {

const char* program_version();  // "0.1.0"

}  // namespace slipface
