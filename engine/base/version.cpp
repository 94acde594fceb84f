#include "slipface/base/version.h"

namespace slipface {

const char* program_version() {
    return SLIPFACE_VERSION;
}

}  // namespace slipface
