// The faces of an object by meaning: equal lists mean equal objects, in whatever order a file has its faces,
// and with whichever corner it begins each.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "goldens/numbers_json.h"
#include "slipface/mesh/mesh.h"

namespace slipface {

struct FaceFact {
    std::vector<std::array<float, 5>> corners;  // x, y, z in metres, u, v; begins with the smallest
    std::string material, type;                 // names; no type: rules and the prop decide
    friend bool operator==(const FaceFact&, const FaceFact&) = default;
    friend bool operator<(const FaceFact& a, const FaceFact& b) {
        return std::tie(a.corners, a.material, a.type) < std::tie(b.corners, b.material, b.type);
    }
};
using FaceList = std::vector<FaceFact>;  // ascending

inline constexpr std::size_t max_packed_corners = 1'000'000;  // of larger objects only the hash is stored

// { "faces": count, "hash": ..., "order": a hash of the file's order, "packed": ... }. Packed bytes depend on
// the release of libdeflate, the hash does not.
Numbers face_list_json(FaceList faces);
// Nothing: it was too large to store, or is damaged.
std::optional<FaceList> face_list_of(const Numbers& json);

// Bytes as text that can stand in a JSON file, and back.
std::string packed_text(std::string_view bytes);
std::optional<std::string> unpacked_text(const Numbers& json);

}  // namespace slipface
