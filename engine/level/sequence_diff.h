// What two sequences of faces have in common, as a text diff finds the lines that two texts have in common.
#pragma once

#include <span>
#include <vector>

#include "face_tokens.h"

namespace slipface {

// [face of now] the old face that it is, in ascending order, or no_id. Equal beginnings and ends first;
// between them stretches that both have exactly once, and what is equal around these. Source: Bram Cohen's
// patience diff. Time and memory grow linearly but for the sorting of hashes.
std::vector<std::uint32_t> sequence_diff(std::span<const FaceToken> old, std::span<const FaceToken> now);

// Faces from `a` of old and `b` of now on.
struct Stretch {
    std::uint32_t a, b;
};

// Those that ascend in both, as many as possible. Sorted by `b` before.
std::vector<Stretch> longest_ascending(const std::vector<Stretch>& stretches);

}  // namespace slipface
