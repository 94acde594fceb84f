// The findings of an audit as sentences for designers.
#pragma once

#include <string>

#include "slipface/sim/audit.h"

namespace slipface {

// "Walker 3 got stuck after 8.5 s between `crate` (face 91) and `floor` (face 94)".
std::string finding_text(const Level& level, const AuditOptions& options, const AuditFinding& finding);

}  // namespace slipface
