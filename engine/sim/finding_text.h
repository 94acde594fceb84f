// What an audit found, in a designer's words.
#pragma once

#include <string>

#include "slipface/sim/audit.h"

namespace slipface {

// "face 12 (`crate`)": with its group, else its material, where it has one. "the air" for no_id.
std::string face_words(const Level& level, FaceId face);

// "Walker 3 got stuck after 8.5 s between faces 91 and 94 (`crate`, `floor`)".
std::string finding_text(const Level& level, const AuditOptions& options, const AuditFinding& finding);

}  // namespace slipface
