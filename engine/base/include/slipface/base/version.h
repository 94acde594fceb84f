// The version of the program. Reports and files of searches name it, so that a reader knows their writer.
#pragma once

namespace slipface {

// MAJOR.MINOR.PATCH of the build: "0.2.0".
const char* program_version();

}  // namespace slipface
