// The parts of a mesh.

#include "mesh_parts.h"

#include <algorithm>
#include <bit>
#include <map>
#include <numeric>
#include <tuple>

#include "face_match.h"
#include "packed_faces.h"
#include "slipface/base/base64.h"
#include "slipface/base/hash.h"
#include "slipface/base/key_sort.h"
#include "slipface/level/material_name.h"
#include "unpainted_faces.h"

namespace slipface {
namespace {

constexpr std::uint32_t small_part = 5;  // faces; pieces with fewer count as one part of their group
constexpr std::uint32_t max_anchor_corners = 16;

// Directions in which a part's rim is searched. They are not along the axes, so that rarely two vertices are
// equally far out.
const std::array<Vec3, 12>& rim_directions() {
    static const std::array<Vec3, 12> directions = [] {
        std::array<Vec3, 12> list;
        std::size_t i = 0;
        for (const double x : {1.0, -1.0})
            for (const double z : {0.871, -0.871})
                for (const double y : {0.313, -0.313})
                    list[i++] = Vec3(x, y, z);
        for (const double side : {1.0, -1.0}) {
            list[i++] = Vec3(0.0171, side, 0.0133);
            list[i++] = Vec3(-0.0137, side, -0.0191);
        }
        return list;
    }();
    return directions;
}

struct Union {
    std::vector<std::uint32_t> parent;
    explicit Union(std::size_t count) : parent(count) { std::iota(parent.begin(), parent.end(), 0u); }
    std::uint32_t root(std::uint32_t i) {
        while (parent[i] != i)
            i = parent[i] = parent[parent[i]];
        return i;
    }
    void join(std::uint32_t a, std::uint32_t b) {
        a = root(a);
        b = root(b);
        parent[std::max(a, b)] = std::min(a, b);
    }
};

// [vertex] the first vertex at the same position.
std::vector<std::uint32_t> welded(const Mesh& mesh) {
    const std::size_t count = mesh.positions.size();
    std::vector<KeyedIndex> order(count);
    for (std::size_t i = 0; i < count; ++i) {
        Hasher hasher;
        for (int axis = 0; axis < 3; ++axis)
            hasher.f64(static_cast<double>(mesh.positions[i][axis]));
        order[i] = {hasher.value(), static_cast<std::uint32_t>(i)};
    }
    sort_by_key(order);
    std::vector<std::uint32_t> first(count);
    for (std::size_t i = 0; i < count; ++i)
        first[order[i].index] =
            i > 0 && order[i].key == order[i - 1].key ? first[order[i - 1].index] : order[i].index;
    return first;
}

bool before(const Vec3f& a, const Vec3f& b) {
    return std::lexicographical_compare(a.data(), a.data() + 3, b.data(), b.data() + 3);
}

// The face's vertices from its lowest corner on, so that the text does not depend on where the loop begins.
std::vector<std::uint32_t> anchor_vertices(const Mesh& mesh, FaceId face) {
    const auto corner = [&](std::uint32_t c) {
        return mesh.corner_vertex.begin() + mesh.face_first_corner[c];
    };
    std::vector<std::uint32_t> vertices(corner(face), corner(face + 1));
    std::rotate(vertices.begin(),
                std::min_element(vertices.begin(), vertices.end(),
                                 [&](std::uint32_t a, std::uint32_t b) {
                                     return before(mesh.positions[a], mesh.positions[b]);
                                 }),
                vertices.end());
    return vertices;
}

AnchorFace anchor_face(const Mesh& mesh, FaceId face) {
    AnchorFace corners;
    for (const std::uint32_t vertex : anchor_vertices(mesh, face))
        corners.push_back(mesh.positions[vertex]);
    return corners;
}

bool loop_before(const AnchorFace& a, const AnchorFace& b) {
    return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end(), before);
}

// Of each rim direction: the face with the outermost corner.
void find_anchors(const Mesh& mesh, const MeshParts& all, std::vector<PaintPart>& parts) {
    const auto& directions = rim_directions();
    struct Rim {
        double reach = -std::numeric_limits<double>::infinity();
        FaceId face = no_id;
    };
    std::vector<std::array<Rim, 12>> rims(parts.size());
    for (FaceId face = 0; face < mesh.face_count(); ++face) {
        const std::uint32_t part = all.of[face];
        const std::uint32_t count = mesh.face_corner_count(face);
        if (part == no_id || count < 3 || count > max_anchor_corners) continue;
        for (std::size_t d = 0; d < directions.size(); ++d) {
            Rim& rim = rims[part][d];
            double reach = -std::numeric_limits<double>::infinity();
            for (std::uint32_t c = 0; c < count; ++c)
                reach = std::max(
                    reach,
                    directions[d].dot(mesh.corner_position(mesh.face_first_corner[face] + c).cast<double>()));
            if (reach < rim.reach) continue;
            if (reach > rim.reach || rim.face == no_id ||
                loop_before(anchor_face(mesh, face), anchor_face(mesh, rim.face)))
                rim = {reach, face};
        }
    }
    std::vector<std::uint32_t> lowest(mesh.groups.size(), no_id);  // [group] number of a vertex
    for (FaceId face = 0; face < mesh.face_count(); ++face) {
        const std::uint32_t group = mesh.face_group[face];
        for (std::uint32_t c = mesh.face_first_corner[face]; c < mesh.face_first_corner[face + 1]; ++c)
            lowest[group] = std::min(lowest[group], mesh.number_in_group(group, mesh.corner_vertex[c]));
    }
    for (std::size_t part = 0; part < parts.size(); ++part) {
        std::map<AnchorFace, FaceId, decltype(&loop_before)> anchors(&loop_before);
        for (const Rim& rim : rims[part])
            if (rim.face != no_id) anchors.try_emplace(anchor_face(mesh, rim.face), rim.face);
        for (const auto& [anchor, face] : anchors) {
            parts[part].anchors.push_back(anchor);
            const std::uint32_t group = mesh.face_group[face];
            for (const std::uint32_t vertex : anchor_vertices(mesh, face))
                parts[part].numbers.push_back(mesh.number_in_group(group, vertex) - lowest[group]);
        }
    }
}

std::uint32_t hash_of_text(std::string_view text) {
    Hasher hasher;
    hasher.text(text);
    return static_cast<std::uint32_t>(hasher.value());
}

}  // namespace

std::uint32_t object_name(std::string_view name) {
    return static_cast<std::uint32_t>(hash_blocks(name.data(), name.size()) % 0xFFFFFF) + 1;
}

ObjectNames::ObjectNames(const Mesh& mesh, const PaintParts& parts) {
    if (parts.parts.empty()) return;  // nothing to compare, and a level can have a thousand selections
    for (const PaintPart& part : parts.parts)
        in_old[part.object] += part.faces;
    std::vector<std::size_t> faces(mesh.groups.size(), 0);
    for (const std::uint32_t group : mesh.face_group)
        ++faces[group];
    for (std::uint32_t group = 0; group < mesh.groups.size(); ++group) {
        of_group.push_back(object_name(mesh.groups[group]));
        if (faces[group] > 0) in_mesh[of_group[group]] += faces[group];
    }
}

MeshParts mesh_parts(const Mesh& mesh) {
    MeshParts result;
    const std::vector<std::uint32_t> first = welded(mesh);
    Union pieces(mesh.face_count());
    std::vector<std::uint32_t> face_at(mesh.positions.size(), no_id);  // [welded vertex] last face there
    for (const FaceId face : faces_by_group(mesh)) {
        for (std::uint32_t c = mesh.face_first_corner[face]; c < mesh.face_first_corner[face + 1]; ++c) {
            std::uint32_t& last = face_at[first[mesh.corner_vertex[c]]];
            if (last != no_id && mesh.face_group[last] == mesh.face_group[face]) pieces.join(last, face);
            last = face;
        }
    }
    std::vector<std::uint32_t> size(mesh.face_count(), 0);
    for (FaceId face = 0; face < mesh.face_count(); ++face)
        ++size[pieces.root(face)];
    result.of.resize(mesh.face_count());
    std::vector<std::uint32_t> number(mesh.face_count(), no_id);
    std::vector<std::uint32_t> rest(mesh.groups.size(), no_id);
    for (FaceId face = 0; face < mesh.face_count(); ++face) {
        const std::uint32_t root = pieces.root(face);
        const bool small = size[root] < small_part;
        std::uint32_t& part = small ? rest[mesh.face_group[face]] : number[root];
        if (part == no_id) {
            part = static_cast<std::uint32_t>(result.parts.size());
            result.parts.emplace_back().object = object_name(mesh.groups[mesh.face_group[face]]);
        }
        result.of[face] = part;
        ++result.parts[part].faces;
        for (std::uint32_t c = mesh.face_first_corner[face]; c < mesh.face_first_corner[face + 1]; ++c)
            result.parts[part].box.add(mesh.corner_position(c).cast<double>());
    }
    return result;
}

PaintParts paint_parts(const Mesh& mesh, SurfaceTable surfaces, const std::vector<FaceId>& faces,
                       const std::vector<FaceKey>& keys) {
    PaintParts result;
    if (faces.empty()) return result;
    result.bounds = mesh.bounds;
    MeshParts all = mesh_parts(mesh);
    std::vector<std::uint32_t> painted(all.parts.size(), 0);
    for (const FaceId face : faces)
        ++painted[all.of[face]];
    std::vector<std::uint32_t> order;
    for (std::uint32_t part = 0; part < all.parts.size(); ++part)
        order.push_back(part);
    const auto content = [&](std::uint32_t part) {
        const Aabb& box = all.parts[part].box;
        return std::make_tuple(painted[part], all.parts[part].faces, box.min.x(), box.min.y(), box.min.z(),
                               box.max.x(), box.max.y(), box.max.z());
    };
    std::sort(order.begin(), order.end(),
              [&](std::uint32_t a, std::uint32_t b) { return content(a) > content(b); });
    if (order.size() > max_paint_parts) order.resize(max_paint_parts);
    std::vector<std::uint32_t> number(all.parts.size(), no_id);
    for (std::size_t i = 0; i < order.size(); ++i) {
        number[order[i]] = static_cast<std::uint32_t>(i);
        result.parts.push_back(all.parts[order[i]]);
    }
    for (std::uint32_t& part : all.of)
        part = painted[part] > 0 ? number[part] : no_id;
    find_anchors(mesh, all, result.parts);
    for (std::size_t i = 0; i < faces.size(); ++i) {
        result.of.push_back(static_cast<std::uint16_t>(all.of[faces[i]] + 1));  // no_id + 1 is 0
        result.outlines.add(mesh, faces[i], keys[i]);
    }
    UnpaintedFaces& unpainted = result.unpainted;
    std::vector<FaceId> unpainted_faces;
    for (const auto& [face, on] : unpainted_faces_on(mesh, faces)) {
        unpainted_faces.push_back(face);
        const std::uint32_t part = all.of[face] != no_id ? all.of[face] : all.of[on];
        unpainted.of.push_back(static_cast<std::uint16_t>(part + 1));
    }
    unpainted.keys = face_keys(mesh, unpainted_faces);
    for (std::size_t i = 0; i < unpainted_faces.size(); ++i)
        unpainted.outlines.add(mesh, unpainted_faces[i], unpainted.keys[i]);
    result.tokens = mesh_tokens(mesh, surfaces);
    result.token = tokens_of(result.tokens, faces);
    unpainted.token = tokens_of(result.tokens, unpainted_faces);
    return result;
}

// 4 bytes number of faces, 6 x 4 box, then of each anchor 4 bytes that are 0 (older programs had a number
// there), 1 byte number of corners, 3 x 4 each.
std::string pack_part(const PaintPart& part) {
    std::string bytes;
    const auto put = [&](const Vec3f& position) {
        for (int axis = 0; axis < 3; ++axis)
            put_bytes(bytes, std::bit_cast<std::uint32_t>(position[axis]), 4);
    };
    put_bytes(bytes, part.faces, 4);
    put(part.box.min.cast<float>());
    put(part.box.max.cast<float>());
    for (const AnchorFace& anchor : part.anchors) {
        put_bytes(bytes, 0, 4);
        put_bytes(bytes, anchor.size(), 1);
        for (const Vec3f& corner : anchor)
            put(corner);
    }
    return to_base64(bytes, Base64::plain);
}

bool unpack_part(std::string_view text, PaintPart& part) {
    const std::optional<std::string> bytes = from_base64(text, Base64::plain);
    if (!bytes || bytes->size() < 28) return false;
    const char* at = bytes->data();
    const char* const end = at + bytes->size();
    bool valid = true;
    const auto take = [&] {
        Vec3f position;
        for (int axis = 0; axis < 3; ++axis)
            position[axis] = std::bit_cast<float>(static_cast<std::uint32_t>(take_bytes(at, 4)));
        valid = valid && position.cwiseAbs().maxCoeff<Eigen::PropagateNaN>() <= 1e9f;
        return position;
    };
    part.faces = static_cast<std::uint32_t>(take_bytes(at, 4));
    part.box.min = take().cast<double>();
    part.box.max = take().cast<double>();
    while (at != end) {
        if (end - at < 5) return false;
        AnchorFace& anchor = part.anchors.emplace_back();
        take_bytes(at, 4);
        const std::size_t count = take_bytes(at, 1);
        if (count < 3 || count > max_anchor_corners || static_cast<std::size_t>(end - at) < 12 * count ||
            part.anchors.size() > rim_directions().size())
            return false;
        for (std::size_t i = 0; i < count; ++i)
            anchor.push_back(take());
    }
    return valid && (part.box.min.array() <= part.box.max.array()).all();
}

// 4 bytes hash of `list`, 4 bytes the lowest number, 1 byte width; of each corner, how far its number is
// above the lowest, in that many bytes.
std::string pack_numbers(const PaintPart& part, std::string_view list) {
    if (part.numbers.empty()) return {};
    const auto [low, high] = std::minmax_element(part.numbers.begin(), part.numbers.end());
    const std::size_t width = (static_cast<std::size_t>(std::bit_width(*high - *low)) + 7) / 8;
    std::string bytes;
    put_bytes(bytes, hash_of_text(list), 4);
    put_bytes(bytes, *low, 4);
    put_bytes(bytes, width, 1);
    for (const std::uint32_t number : part.numbers)
        put_bytes(bytes, number - *low, width);
    return to_base64(bytes, Base64::plain);
}

bool unpack_numbers(std::string_view text, std::string_view list, PaintPart& part) {
    const std::optional<std::string> bytes = from_base64(text, Base64::plain);
    if (!bytes || (!bytes->empty() && bytes->size() < 9)) return false;
    if (bytes->empty()) return true;
    const char* at = bytes->data();
    const bool same = take_bytes(at, 4) == hash_of_text(list);
    const std::uint64_t lowest = take_bytes(at, 4);
    const std::size_t width = take_bytes(at, 1);
    if (!same) return true;
    std::size_t corners = 0;
    for (const AnchorFace& anchor : part.anchors)
        corners += anchor.size();
    if (width > 4 || bytes->size() != 9 + width * corners) return false;
    for (std::size_t c = 0; c < corners; ++c)
        part.numbers.push_back(
            static_cast<std::uint32_t>(std::min<std::uint64_t>(lowest + take_bytes(at, width), no_id)));
    return true;
}

}  // namespace slipface
