// What a level file knows of every face, painted or not: a token of eight bytes. With tokens of the old and
// of the new geometry the two can be compared as a text diff compares lines (correspondence.h).
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "slipface/level/level.h"

namespace slipface {

// One face, in the order of its object.
struct FaceToken {
    // How many faces of the object ago each of its corners was last used, as a hash of 10 bits that depends
    // neither on where the loop begins nor on the winding. It says how the face is joined to the ones before
    // it, wherever these are: an edit elsewhere in the object leaves it as it is.
    std::uint16_t topology = 0;
    std::uint8_t corners = 0;   // at most 9; more count as 9, so such a face is never known by its triangles
    std::uint8_t material = 0;  // a hash of three bits of the base name
    std::uint16_t area = 0;     // logarithm in steps of 0.9 %; 0: no area
    Vec3f position = Vec3f::Zero();  // the mean of the corners; of an old face right up to TokenObject::step

    double square_metres() const;  // right up to 1 %

    // Whether the order and the joints of the faces may be the same.
    bool joined_as(const FaceToken& other) const {
        return topology == other.topology && corners == other.corners;
    }
    // Whether the faces may have the same shape, whatever is joined to them.
    bool shaped_as(const FaceToken& other) const {
        const int steps = int{area} - int{other.area};
        return corners == other.corners && material == other.material && steps >= -1 && steps <= 1;
    }
    bool same_as(const FaceToken& other) const { return joined_as(other) && shaped_as(other); }
};

// A group of the geometry's file, as the objects of modelling tools become.
struct TokenObject {
    std::uint32_t name = 0;              // object_name()
    std::uint32_t first = 0, count = 0;  // its faces in MeshTokens::faces
    Aabb box;                            // of their positions
    Vec3f step = Vec3f::Zero();          // between positions that a level file can hold
};

struct MeshTokens {
    std::vector<TokenObject> objects;
    std::vector<FaceToken> faces;       // object after object, those of an object in the order of the file
    std::vector<FaceId> face;           // [token] its face; only of a mesh, not of a level file
    std::vector<std::uint32_t> object;  // [token] index into `objects`

    bool empty() const { return faces.empty(); }
};

// Time and memory grow linearly with the faces.
MeshTokens mesh_tokens(const Mesh& mesh, SurfaceTable surfaces);

// The token of each of `faces`, of tokens of a mesh.
std::vector<std::uint32_t> tokens_of(const MeshTokens& tokens, const std::vector<FaceId>& faces);

inline constexpr std::size_t bytes_per_token = 8;
inline constexpr std::size_t bytes_per_object = 31;

// The objects, and the tokens in rows whose content alone decides where they end, so that an edit changes
// few.
std::string pack_token_objects(const MeshTokens& tokens);
std::vector<std::string> pack_tokens(const MeshTokens& tokens);

// Back, row after row: the objects first. False if the bytes are none, or too few or too many for the
// objects.
bool unpack_token_objects(std::string_view bytes, MeshTokens& tokens);
bool unpack_tokens(std::string_view bytes, MeshTokens& tokens);

}  // namespace slipface
