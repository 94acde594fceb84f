#pragma once

namespace slipface {

// Of this library, as CMake's project has it: "0.1.0". Searches, reports and audits name it, because another
// version may move a player differently.
const char* program_version();

}  // namespace slipface
