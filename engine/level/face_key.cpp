// Keys that name a face by its geometry.

#include <algorithm>
#include <cmath>

#include "face_match.h"
#include "slipface/base/hash.h"
#include "slipface/base/key_sort.h"
#include "slipface/base/parallel.h"

namespace slipface {
namespace {

std::uint64_t corner_hash(const Vec3f& position) {
    Hasher hasher;
    for (int axis = 0; axis < 3; ++axis) {
        hasher.u64(static_cast<std::uint64_t>(std::llround(static_cast<double>(position[axis]) * 1e5)));
    }
    return hasher.value();
}

// The sum over the directed edges: independent of the first corner, but not of the winding. `hash_of` gives a
// vertex's hash.
template <class HashOf>
std::uint64_t loop_hash(const Mesh& mesh, FaceId face, const HashOf& hash_of) {
    const std::uint32_t first = mesh.face_first_corner[face];
    const std::uint32_t count = mesh.face_corner_count(face);
    if (count == 0) return 0;
    std::uint64_t sum = count;
    std::uint64_t previous = hash_of(mesh.corner_vertex[first + count - 1]);
    for (std::uint32_t i = 0; i < count; ++i) {
        const std::uint64_t current = hash_of(mesh.corner_vertex[first + i]);
        Hasher edge;
        edge.u64(previous);
        edge.u64(current);
        sum += edge.value();
        previous = current;
    }
    return sum;
}

// The loop hashes of all faces.
std::vector<std::uint64_t> loop_hashes(const Mesh& mesh) {
    std::vector<std::uint64_t> vertex_hash(mesh.positions.size());
    parallel_for(vertex_hash.size(), 4096, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i)
            vertex_hash[i] = corner_hash(mesh.positions[i]);
    });
    std::vector<std::uint64_t> hashes(mesh.face_count());
    parallel_for(hashes.size(), 4096, [&](std::size_t begin, std::size_t end) {
        for (std::size_t face = begin; face < end; ++face)
            hashes[face] = loop_hash(mesh, static_cast<FaceId>(face),
                                     [&](std::uint32_t vertex) { return vertex_hash[vertex]; });
    });
    return hashes;
}

double as_float(double value) {
    return static_cast<double>(static_cast<float>(value));
}
double four_decimals(double value) {
    return std::round(value * 1e4) / 1e4 + 0.0;
}

FaceKey key_of(const Mesh& mesh, FaceId face, std::uint64_t hash) {
    FaceKey key;
    key.loop_hash = hash;
    key.centroid = face_centroid(mesh, face).unaryExpr(&as_float);
    key.normal = face_normal(mesh, face).unaryExpr(&four_decimals);
    key.area = as_float(face_area(mesh, face));
    key.material = mesh.materials[mesh.face_material[face]].name;
    return key;
}

// [face] the number of earlier faces with the same loop and material.
std::vector<std::uint32_t> twins_before(const Mesh& mesh, const std::vector<std::uint64_t>& hashes) {
    std::vector<KeyedIndex> order(hashes.size());
    for (std::size_t face = 0; face < hashes.size(); ++face)
        order[face] = {hashes[face], static_cast<FaceId>(face)};
    sort_by_key(order);
    std::vector<std::uint32_t> before(hashes.size(), 0);
    const auto material = [&](FaceId face) -> const std::string& {
        return mesh.materials[mesh.face_material[face]].name;
    };
    for (std::size_t begin = 0, end = 0; begin < order.size(); begin = end) {
        for (end = begin + 1; end < order.size() && order[end].key == order[begin].key;)
            ++end;
        if (end == begin + 1) continue;
        const auto at = [&](std::size_t i) { return order.begin() + static_cast<std::ptrdiff_t>(i); };
        std::stable_sort(at(begin), at(end), [&](const KeyedIndex& a, const KeyedIndex& b) {
            return material(a.index) < material(b.index);
        });
        for (std::size_t i = begin + 1; i < end; ++i) {
            if (material(order[i].index) == material(order[i - 1].index))
                before[order[i].index] = before[order[i - 1].index] + 1;
        }
    }
    return before;
}

}  // namespace

double position_tolerance(const Vec3& position) {
    return 2e-5 + 4e-7 * position.cwiseAbs().maxCoeff();
}

double in_plane(const FaceKey& key) {
    return 1e-3 * std::sqrt(key.area) + position_tolerance(key.centroid);
}

FaceKey face_key(const Mesh& mesh, FaceId face) {
    return key_of(mesh, face, loop_hash(mesh, face, [&](std::uint32_t vertex) {
                      return corner_hash(mesh.positions[vertex]);
                  }));
}

std::vector<FaceKey> face_keys(const Mesh& mesh, const std::vector<FaceId>& faces) {
    if (faces.empty()) return {};
    const std::vector<std::uint64_t> hashes = loop_hashes(mesh);
    std::vector<FaceKey> keys(faces.size());
    parallel_for(faces.size(), 1024, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i)
            keys[i] = key_of(mesh, faces[i], hashes[faces[i]]);
    });
    const std::vector<std::uint32_t> copies = twins_before(mesh, hashes);
    for (std::size_t i = 0; i < faces.size(); ++i)
        keys[i].copy = copies[faces[i]];
    return keys;
}

}  // namespace slipface
