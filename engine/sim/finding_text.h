// The findings of an audit as sentences for designers.
#pragma once

#include <string>

#include "slipface/sim/audit.h"

namespace slipface {

// "face 12 (`crate`)": with the name of its group, else of its material. "the air" for no_id.
std::string face_words(const Level& level, FaceId face);

// "Walker 3 got stuck after 8.5 s between faces 91 and 94 (`crate`, `floor`)".
std::string finding_text(const Level& level, const AuditOptions& options, const AuditFinding& finding);

}  // namespace slipface
