// Which new face was which old one, by names, order and joints, before anything is asked about places.
#pragma once

#include <optional>
#include <span>

#include "face_tokens.h"

namespace slipface {

struct Correspondence {
    // [token of the new geometry] the old token that became it; no_id: not known, or none
    std::vector<std::uint32_t> before;
    // [token of the new geometry] what became it in a second reading that is as possible as the first; no_id:
    // none. Equal to `before` where both agree. A face whose two old ones have different types is a question.
    std::vector<std::uint32_t> rival;
    std::vector<bool> open;   // [token of the new geometry] an edit may have added it: it is a question
    std::vector<bool> moved;  // [token of the new geometry] it is not where the old one was
};

// `went`: [old token] where its face is now, as the vertices say; nothing: they do not say.
// Compares the objects of a name, or else those whose faces are joined in a way that no others are. In each
// there are two readings, the order and the place of its faces. The order counts where the places explain
// less; where the places explain as much without a face that was replaced, both are possible. What the order
// does not explain stays open for a search by motions.
Correspondence correspond(const MeshTokens& old, const MeshTokens& now,
                          std::span<const std::optional<Vec3>> went);

}  // namespace slipface
