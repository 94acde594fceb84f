// Keys that name a face by its geometry.

#include <algorithm>
#include <cmath>

#include "face_match.h"
#include "slipface/base/hash.h"
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

// The sum over the directed edges: it has no first corner, and keeps the winding.
std::uint64_t loop_hash(const Mesh& mesh, FaceId face) {
    const std::uint32_t first = mesh.face_first_corner[face];
    const std::uint32_t count = mesh.face_corner_count(face);
    if (count == 0) return 0;
    std::uint64_t sum = count;
    std::uint64_t previous = corner_hash(mesh.corner_position(first + count - 1));
    for (std::uint32_t i = 0; i < count; ++i) {
        const std::uint64_t current = corner_hash(mesh.corner_position(first + i));
        Hasher edge;
        edge.u64(previous);
        edge.u64(current);
        sum += edge.value();
        previous = current;
    }
    return sum;
}

double as_float(double value) {
    return static_cast<double>(static_cast<float>(value));
}
double four_decimals(double value) {
    return std::round(value * 1e4) / 1e4 + 0.0;
}

}  // namespace

double position_tolerance(const Vec3& position) {
    return 2e-5 + 4e-7 * position.cwiseAbs().maxCoeff();
}

FaceKey face_key(const Mesh& mesh, FaceId face) {
    FaceKey key;
    key.loop_hash = loop_hash(mesh, face);
    key.centroid = face_centroid(mesh, face).unaryExpr(&as_float);
    key.normal = face_normal(mesh, face).unaryExpr(&four_decimals);
    key.area = as_float(face_area(mesh, face));
    key.material = mesh.materials[mesh.face_material[face]].name;
    return key;
}

std::vector<FaceKey> face_keys(const Mesh& mesh, const std::vector<FaceId>& faces) {
    std::vector<FaceKey> keys(faces.size());
    parallel_for(faces.size(), 1024, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i)
            keys[i] = face_key(mesh, faces[i]);
    });
    if (faces.empty()) return keys;

    struct Hashed {
        std::uint64_t hash;
        FaceId face;
    };
    std::vector<Hashed> all(mesh.face_count());
    parallel_for(all.size(), 1024, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const auto face = static_cast<FaceId>(i);
            all[i] = {loop_hash(mesh, face), face};
        }
    });
    const auto material = [&](FaceId face) -> const std::string& {
        return mesh.materials[mesh.face_material[face]].name;
    };
    std::sort(all.begin(), all.end(), [&](const Hashed& a, const Hashed& b) {
        if (a.hash != b.hash) return a.hash < b.hash;
        const int order = material(a.face).compare(material(b.face));
        return order != 0 ? order < 0 : a.face < b.face;
    });
    std::vector<std::uint32_t> copies(all.size(), 0);
    for (std::size_t i = 1; i < all.size(); ++i) {
        const bool twin =
            all[i].hash == all[i - 1].hash && material(all[i].face) == material(all[i - 1].face);
        if (twin) copies[all[i].face] = copies[all[i - 1].face] + 1;
    }
    for (std::size_t i = 0; i < faces.size(); ++i)
        keys[i].copy = copies[faces[i]];
    return keys;
}

}  // namespace slipface
