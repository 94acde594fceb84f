#include "packed_faces.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>

#include "slipface/base/base64.h"
#include "slipface/base/hash.h"
#include "slipface/base/parallel.h"

namespace slipface {
namespace {

// Per face: 6 bytes loop hash, 3 x 4 centroid, 3 normal, 2 area; little-endian.
constexpr std::size_t bytes_per_face = 23;
constexpr std::size_t faces_per_row = 48;  // on average
constexpr std::uint32_t no_normal = 0xFFFFFF;
constexpr int normal_steps = 2047;  // from the middle of the folded octahedron to its rim
constexpr double largest_centroid = 1e9;

double sign_of(double value) {
    return value < 0.0 ? -1.0 : 1.0;
}

// Octahedral encoding: the sphere on an octahedron, its lower half folded outwards, as two 12-bit numbers.
std::uint32_t normal_code(const Vec3& normal) {
    const double sum = std::abs(normal.x()) + std::abs(normal.y()) + std::abs(normal.z());
    if (!(sum > 0.0)) return no_normal;
    double u = normal.x() / sum;
    double v = normal.y() / sum;
    if (normal.z() < 0.0) {
        const double folded = (1.0 - std::abs(v)) * sign_of(u);
        v = (1.0 - std::abs(u)) * sign_of(v);
        u = folded;
    }
    const auto step = [](double fraction) {
        return static_cast<std::uint32_t>(std::lround(fraction * normal_steps) + normal_steps);
    };
    return step(u) | step(v) << 12;
}

bool decode_normal(std::uint32_t code, Vec3& normal) {
    normal = Vec3::Zero();
    if (code == no_normal) return true;
    const std::uint32_t steps[] = {code & 0xFFF, code >> 12};
    if (steps[0] > 2 * normal_steps || steps[1] > 2 * normal_steps) return false;
    const double u = (static_cast<double>(steps[0]) - normal_steps) / normal_steps;
    const double v = (static_cast<double>(steps[1]) - normal_steps) / normal_steps;
    const double z = 1.0 - std::abs(u) - std::abs(v);
    normal = z >= 0.0 ? Vec3(u, v, z)
                      : Vec3((1.0 - std::abs(v)) * sign_of(u), (1.0 - std::abs(u)) * sign_of(v), z);
    normal.normalize();
    return true;
}

// 7 bits of exponent, 9 of mantissa; 0 is no area.
std::uint32_t area_code(double area) {
    const auto bits = std::bit_cast<std::uint32_t>(static_cast<float>(area)) + (1U << 13);
    const int exponent = static_cast<int>(bits >> 23) - 127;
    if (!(area > 0.0) || exponent < -63) return 0;
    if (exponent > 63) return 0xFFFF;
    return static_cast<std::uint32_t>(exponent + 64) << 9 | ((bits >> 14) & 0x1FF);
}

double decode_area(std::uint32_t code) {
    if (code == 0) return 0.0;
    return std::ldexp(1.0 + (code & 0x1FF) / 512.0, static_cast<int>(code >> 9) - 64);
}

void put_face(std::string& bytes, const FaceKey& key) {
    put_bytes(bytes, packed_hash(key.loop_hash), 6);
    for (int axis = 0; axis < 3; ++axis)
        put_bytes(bytes, std::bit_cast<std::uint32_t>(static_cast<float>(key.centroid[axis])), 4);
    put_bytes(bytes, normal_code(key.normal), 3);
    put_bytes(bytes, area_code(key.area), 2);
}

bool take_face(const char*& at, FaceKey& key) {
    key.loop_hash = take_bytes(at, 6);
    for (int axis = 0; axis < 3; ++axis)
        key.centroid[axis] =
            static_cast<double>(std::bit_cast<float>(static_cast<std::uint32_t>(take_bytes(at, 4))));
    if (!(key.centroid.cwiseAbs().maxCoeff<Eigen::PropagateNaN>() <= largest_centroid)) return false;
    if (!decode_normal(static_cast<std::uint32_t>(take_bytes(at, 3)), key.normal)) return false;
    key.area = decode_area(static_cast<std::uint32_t>(take_bytes(at, 2)));
    return true;
}

}  // namespace

void put_bytes(std::string& bytes, std::uint64_t value, std::size_t count) {
    char low_first[8];
    for (std::size_t i = 0; i < count; ++i)
        low_first[i] = static_cast<char>(value >> (8 * i));
    bytes.append(low_first, count);
}

std::uint64_t take_bytes(const char*& at, std::size_t count) {
    std::uint64_t value = 0;
    for (std::size_t i = 0; i < count; ++i)
        value |= std::uint64_t{static_cast<unsigned char>(*at++)} << (8 * i);
    return value;
}

std::uint64_t hash_of_keys(std::span<const FaceKey* const> keys) {
    Hasher hasher;
    hasher.u64(keys.size());
    for (const FaceKey* key : keys)
        hasher.u64(packed_hash(key->loop_hash));
    return hasher.value();
}

std::vector<std::string> pack_faces(std::span<const FaceKey* const> keys) {
    if (keys.empty()) return {};
    const auto row_bits = static_cast<int>(std::bit_width(keys.size() / faces_per_row));
    const auto row_of = [&](std::size_t k) {
        return packed_hash(keys[k]->loop_hash) >> (packed_hash_bits - row_bits);
    };
    std::vector<std::size_t> begin{0};
    for (std::size_t i = 1; i < keys.size(); ++i)
        if (row_of(i) != row_of(i - 1)) begin.push_back(i);
    begin.push_back(keys.size());
    std::vector<std::string> rows(begin.size() - 1);
    parallel_for(rows.size(), 64, [&](std::size_t first, std::size_t last) {
        std::string bytes;
        for (std::size_t row = first; row < last; ++row) {
            bytes.clear();
            for (std::size_t i = begin[row]; i < begin[row + 1]; ++i)
                put_face(bytes, *keys[i]);
            rows[row] = to_base64(bytes, Base64::plain);
        }
    });
    return rows;
}

bool unpack_faces(std::string_view row, std::vector<FaceKey>& keys) {
    const std::optional<std::string> bytes = from_base64(row, Base64::plain);
    if (!bytes || bytes->empty() || bytes->size() % bytes_per_face != 0) return false;
    const char* at = bytes->data();
    for (std::size_t i = 0; i < bytes->size() / bytes_per_face; ++i) {
        FaceKey key;
        if (!take_face(at, key)) return false;
        keys.push_back(std::move(key));
    }
    return true;
}

}  // namespace slipface
