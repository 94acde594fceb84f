// Unpainted faces that a level file stores.
#pragma once

#include <span>
#include <vector>

#include "slipface/level/level.h"

namespace slipface {

struct UnpaintedFace {
    FaceId face;
    FaceId on;  // a painted one
};

// The unpainted faces that lie on `painted` ones (ascending), or just before or behind them: of the same
// object, and looking much the same way. Where an edit cut or merged them, only these say which of the
// new faces are the painted ones. Ascending; none if the mesh has no tree.
std::vector<UnpaintedFace> unpainted_faces_on(const Mesh& mesh, std::span<const FaceId> painted);

}  // namespace slipface
