#include "face_outline.h"

#include <algorithm>
#include <cmath>

#include "packed_faces.h"

namespace slipface {
namespace {

// One byte number of corners, 0 for an empty outline, else one byte extent, as a power of two. Then of each
// corner but the last its offset from the centroid, signed numbers of two bytes of which the largest is the
// extent. The mean of all offsets is zero, which gives the last corner.
constexpr std::size_t max_corners = 255;
constexpr int min_extent = -100, max_extent = 100;

// Flat ones. Byte 0: in bits 0 and 1 the axis along which the polygon is seen (3: an empty outline), in bits
// 2 and 3 the number of corners less three (3: one more byte has the number), in bits 4 to 7 the extent: half
// a square's side of the same area, then in steps of the root of two. Then two signed bytes per corner but
// the last, along the other axes.
constexpr unsigned no_axis = 3, many_corners = 6;

unsigned byte_at(std::string_view bytes, std::size_t i) {
    return i < bytes.size() ? static_cast<unsigned char>(bytes[i]) : 0;
}

}  // namespace

FaceOutlines::Head FaceOutlines::head(std::string_view bytes, double area) const {
    const unsigned first = byte_at(bytes, 0), second = byte_at(bytes, 1);
    if (!flat_) return {first, first == 0 ? 1U : 2U, std::exp2(static_cast<std::int8_t>(second)) / 32767.0};
    const unsigned more = (first >> 2 & 3) + 3;
    return {(first & 3) == no_axis ? 0
            : more == many_corners ? second
                                   : more,
            more == many_corners && (first & 3) != no_axis ? 2U : 1U,
            0.25 * std::sqrt(area) * std::exp2(0.5 * (first >> 4)) / 127.0};
}

void FaceOutlines::add(const Mesh& mesh, FaceId face, const FaceKey& key) {
    first_.push_back(static_cast<std::uint32_t>(bytes_.size()));
    std::vector<Vec3> offsets;
    double largest = 0.0;
    for (std::uint32_t c = mesh.face_first_corner[face]; c < mesh.face_first_corner[face + 1]; ++c) {
        offsets.emplace_back(mesh.corner_position(c).cast<double>() - key.centroid);
        largest = std::max(largest, offsets.back().cwiseAbs().maxCoeff());
    }
    int extent = 0;
    std::frexp(largest, &extent);
    const std::size_t count = offsets.size();
    if (!(key.area > 0.0) || count < 3 || count > max_corners || extent < min_extent || extent > max_extent) {
        bytes_.push_back(0);
        return;
    }
    bytes_.push_back(static_cast<char>(count));
    bytes_.push_back(static_cast<char>(extent));
    const double step = std::exp2(extent) / 32767.0;
    Vec3 carry = Vec3::Zero();  // what rounding left, so that the last corner is right, too
    offsets.pop_back();
    for (const Vec3& offset : offsets) {
        const Vec3 exact = offset / step + carry, rounded = exact.array().round();
        carry = exact - rounded;
        for (const double number : rounded)
            put_bytes(bytes_, static_cast<std::uint16_t>(static_cast<int>(number)), 2);
    }
}

std::vector<Vec3> FaceOutlines::corners(std::size_t i, const FaceKey& key) const {
    const std::string_view data = bytes(i);
    const Head head = this->head(data, key.area);
    if (head.corners < 3 || !(key.area > 0.0) || key.normal.isZero()) return {};
    const auto axis = static_cast<int>(byte_at(data, 0) & 3);
    if (flat_ && std::abs(key.normal[axis]) < 0.1) return {};  // of another face
    std::vector<Vec3> corners;
    Vec3 last = Vec3::Zero();
    const char* at = data.data() + head.size;
    for (std::size_t c = 0; c + 1 < head.corners; ++c) {
        Vec3& offset = corners.emplace_back(Vec3::Zero());
        if (flat_)
            for (const int k : {1, 2})
                offset[(axis + k) % 3] = head.step * static_cast<std::int8_t>(take_bytes(at, 1));
        else
            for (double& number : offset)
                number = head.step * static_cast<std::int16_t>(take_bytes(at, 2));
        last -= offset;
    }
    corners.push_back(last);
    for (Vec3& corner : corners) {
        if (flat_) corner[axis] = -key.normal.dot(corner) / key.normal[axis];
        corner += key.centroid;
    }
    return corners;
}

// By rounding and by what it carried, a step along each axis; a plane's tilt against them lengthens it.
double FaceOutlines::rounding(std::size_t i, const FaceKey& key) const {
    return 2.5 * head(bytes(i), key.area).step;
}

std::string_view FaceOutlines::bytes(std::size_t i) const {
    const std::size_t end = i + 1 < first_.size() ? first_[i + 1] : bytes_.size();
    return std::string_view(bytes_).substr(first_[i], end - first_[i]);
}

bool FaceOutlines::add_bytes(std::string_view bytes) {
    for (std::size_t at = 0; at < bytes.size();) {
        const std::string_view rest = bytes.substr(at);
        const Head head = this->head(rest, 1.0);
        const std::size_t size = head.size + (head.corners == 0 ? 0 : corner_bytes() * (head.corners - 1));
        if ((head.corners != 0 && head.corners < 3) || size > rest.size()) return false;
        first_.push_back(static_cast<std::uint32_t>(bytes_.size() + at));
        at += size;
    }
    bytes_ += bytes;
    return true;
}

}  // namespace slipface
