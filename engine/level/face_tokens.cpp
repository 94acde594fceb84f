#include "face_tokens.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "face_match.h"
#include "packed_faces.h"
#include "part_motion.h"
#include "slipface/base/parallel.h"
#include "slipface/level/material_name.h"

namespace slipface {
namespace {

constexpr int topology_bits = 10, position_bits = 12, area_bits = 12;
constexpr int area_at = topology_bits + 3 * position_bits;
constexpr double largest_code = (1 << position_bits) - 1, largest_area = (1 << area_bits) - 1;
constexpr double area_steps = 80.0;      // per doubling; one more or less counts as equal
constexpr double smallest_area = -25.0;  // as a power of two: squares of a sixth of a millimetre
constexpr std::uint32_t least_token_corners = 3, max_token_corners = 9;
constexpr float farthest_corner_of_box = 1e9f;

std::uint64_t mixed(std::uint64_t value) {  // the finalizer of splitmix64
    value = (value ^ value >> 30) * 0xbf58476d1ce4e5b9ULL;
    value = (value ^ value >> 27) * 0x94d049bb133111ebULL;
    return value ^ value >> 31;
}

std::uint16_t area_step(double area) {
    if (!(area > 0.0)) return 0;
    return static_cast<std::uint16_t>(
        std::clamp(1.0 + std::round(area_steps * (std::log2(area) - smallest_area)), 1.0, largest_area));
}

double area_of_step(std::uint16_t step) {
    return step == 0 ? 0.0 : std::exp2((step - 1.0) / area_steps + smallest_area);
}

// The hash of the corners' distances to their last use: a sum over the edges, so that it depends neither on
// the first corner nor on the winding.
std::uint16_t topology_of(const std::vector<std::uint32_t>& since) {
    std::uint64_t sum = since.size();
    for (std::size_t c = 0; c < since.size(); ++c) {
        const std::uint64_t a = since[c], b = since[(c + 1) % since.size()];
        sum += mixed((std::min(a, b) << 32 | std::max(a, b)) + 1);
    }
    return static_cast<std::uint16_t>(mixed(sum) & ((1U << topology_bits) - 1));
}

void set_step(TokenObject& object) {
    const Vec3f extent = (object.box.max - object.box.min).cast<float>();
    const Vec3 farthest_corner = object.box.min.cwiseAbs().cwiseMax(object.box.max.cwiseAbs());
    const auto least = static_cast<float>(8.0 * position_tolerance(farthest_corner));
    object.step = (extent / static_cast<float>(largest_code)).cwiseMax(least);
}

void add_objects(const Mesh& mesh, MeshTokens& tokens) {
    tokens.object.resize(tokens.face.size());
    for (std::uint32_t i = 0; i < tokens.face.size(); ++i) {
        const std::uint32_t group = mesh.face_group[tokens.face[i]];
        if (i == 0 || group != mesh.face_group[tokens.face[i - 1]])
            tokens.objects.push_back({object_name(mesh.groups[group]), i, 0, {}, Vec3f::Zero()});
        TokenObject& object = tokens.objects.back();
        ++object.count;
        object.box.add(tokens.faces[i].position.cast<double>());
        tokens.object[i] = static_cast<std::uint32_t>(tokens.objects.size() - 1);
    }
    for (TokenObject& object : tokens.objects)
        set_step(object);
}

}  // namespace

double FaceToken::square_metres() const {
    return area_of_step(area);
}

MeshTokens mesh_tokens(const Mesh& mesh, SurfaceTable surfaces) {
    MeshTokens tokens;
    tokens.face = faces_by_group(mesh);
    tokens.faces.resize(tokens.face.size());
    std::vector<std::uint8_t> materials;
    for (const Material& material : mesh.materials)
        materials.push_back(
            static_cast<std::uint8_t>(object_name(base_material(material.name, surfaces)) & 7));
    parallel_for(tokens.face.size(), 4096, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const FaceId face = tokens.face[i];
            FaceToken& token = tokens.faces[i];
            token.corners = static_cast<std::uint8_t>(
                std::clamp(mesh.face_corner_count(face), least_token_corners, max_token_corners));
            token.material = materials[mesh.face_material[face]];
            token.area = area_step(face_area(mesh, face));
            token.position = face_centroid(mesh, face).cast<float>();
        }
    });
    add_objects(mesh, tokens);
    std::vector<std::uint32_t> last(mesh.positions.size(), no_id);  // [vertex] the last token there
    std::vector<std::uint32_t> since;
    for (std::uint32_t i = 0; i < tokens.face.size(); ++i) {
        const std::uint32_t begin = mesh.face_first_corner[tokens.face[i]],
                            end = mesh.face_first_corner[tokens.face[i] + 1],
                            first = tokens.objects[tokens.object[i]].first;
        since.clear();
        for (std::uint32_t c = begin; c < end; ++c) {
            const std::uint32_t before = last[mesh.corner_vertex[c]];
            since.push_back(before == no_id || before < first ? 0 : i - before);
        }
        for (std::uint32_t c = begin; c < end; ++c)
            last[mesh.corner_vertex[c]] = i;
        tokens.faces[i].topology = topology_of(since);
    }
    return tokens;
}

std::vector<std::uint32_t> tokens_of(const MeshTokens& tokens, const std::vector<FaceId>& faces) {
    std::vector<std::uint32_t> token(tokens.face.size());
    for (std::uint32_t i = 0; i < tokens.face.size(); ++i)
        token[tokens.face[i]] = i;
    std::vector<std::uint32_t> result;
    result.reserve(faces.size());
    for (const FaceId face : faces)
        result.push_back(token[face]);
    return result;
}

// 3 bytes name, 4 count, 6 x 4 box.
std::string pack_token_objects(const MeshTokens& tokens) {
    std::string bytes;
    for (const TokenObject& object : tokens.objects) {
        put_bytes(bytes, object.name, 3);
        put_bytes(bytes, object.count, 4);
        for (const Vec3& corner : {object.box.min, object.box.max})
            for (int axis = 0; axis < 3; ++axis)
                put_bytes(bytes, std::bit_cast<std::uint32_t>(static_cast<float>(corner[axis])), 4);
    }
    return bytes;
}

bool unpack_token_objects(std::string_view bytes, MeshTokens& tokens) {
    if (bytes.size() % bytes_per_object != 0) return false;
    std::uint64_t first =
        tokens.objects.empty() ? 0 : tokens.objects.back().first + tokens.objects.back().count;
    const char* at = bytes.data();
    while (at != bytes.data() + bytes.size()) {
        TokenObject object;
        object.name = static_cast<std::uint32_t>(take_bytes(at, 3));
        object.first = static_cast<std::uint32_t>(first);
        object.count = static_cast<std::uint32_t>(take_bytes(at, 4));
        for (Vec3* corner : {&object.box.min, &object.box.max}) {
            for (int axis = 0; axis < 3; ++axis) {
                const auto value = std::bit_cast<float>(static_cast<std::uint32_t>(take_bytes(at, 4)));
                if (!(std::abs(value) <= farthest_corner_of_box)) return false;
                (*corner)[axis] = static_cast<double>(value);
            }
        }
        first += object.count;
        if (first >= no_id || (object.box.min.array() > object.box.max.array()).any()) return false;
        set_step(object);
        tokens.objects.push_back(object);
    }
    return true;
}

// From the lowest bit: topology, three positions, area, corners, material.
std::vector<std::string> pack_tokens(const MeshTokens& tokens) {
    constexpr std::uint64_t tokens_per_row = 128;  // on average
    constexpr std::size_t longest_row = 8 * tokens_per_row * bytes_per_token;
    std::vector<std::string> rows;
    std::string bytes;
    for (std::size_t i = 0; i < tokens.faces.size(); ++i) {
        const FaceToken& token = tokens.faces[i];
        const TokenObject& object = tokens.objects[tokens.object[i]];
        std::uint64_t packed = token.topology;
        for (int axis = 0; axis < 3; ++axis) {
            const double offset = static_cast<double>(token.position[axis]) -
                                  static_cast<double>(static_cast<float>(object.box.min[axis]));
            const double code =
                std::clamp(std::round(offset / static_cast<double>(object.step[axis])), 0.0, largest_code);
            packed |= static_cast<std::uint64_t>(code) << (topology_bits + axis * position_bits);
        }
        packed |= std::uint64_t{token.area} << area_at |
                  std::uint64_t{token.corners - least_token_corners} << 58 |
                  std::uint64_t{token.material} << 61;
        put_bytes(bytes, packed, bytes_per_token);
        if (mixed(packed) % tokens_per_row != 0 && bytes.size() < longest_row && i + 1 < tokens.faces.size())
            continue;
        rows.push_back(std::move(bytes));
        bytes.clear();
    }
    return rows;
}

bool unpack_tokens(std::string_view bytes, MeshTokens& tokens) {
    if (bytes.size() % bytes_per_token != 0) return false;
    std::uint32_t object = tokens.object.empty() ? 0 : tokens.object.back();
    for (const char* at = bytes.data(); at != bytes.data() + bytes.size();) {
        const auto i = static_cast<std::uint32_t>(tokens.faces.size());
        while (object < tokens.objects.size() &&
               i >= tokens.objects[object].first + tokens.objects[object].count)
            ++object;
        if (object == tokens.objects.size()) return false;
        const std::uint64_t packed = take_bytes(at, bytes_per_token);
        const TokenObject& of = tokens.objects[object];
        FaceToken token;
        token.topology = static_cast<std::uint16_t>(packed & ((1U << topology_bits) - 1));
        for (int axis = 0; axis < 3; ++axis) {
            const auto code = static_cast<float>(packed >> (topology_bits + axis * position_bits) &
                                                 ((1U << position_bits) - 1));
            token.position[axis] = static_cast<float>(of.box.min[axis]) + code * of.step[axis];
        }
        token.area = static_cast<std::uint16_t>(packed >> area_at & ((1U << area_bits) - 1));
        token.corners = static_cast<std::uint8_t>((packed >> 58 & 7) + least_token_corners);
        token.material = static_cast<std::uint8_t>(packed >> 61);
        tokens.faces.push_back(token);
        tokens.object.push_back(object);
    }
    return true;
}

}  // namespace slipface
