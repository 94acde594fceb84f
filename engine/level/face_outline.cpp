#include "face_outline.h"

#include <algorithm>
#include <cmath>

namespace slipface {
namespace {

// Byte 0: in bits 0 and 1 the axis along which the polygon is seen, in bits 2 and 3 the number of corners
// less three (3: one more byte has the number), in bits 4 to 7 the extent. Then two signed bytes per corner
// but the last, offsets from the centroid along the other axes: 127 is the extent. The mean of all offsets is
// zero, which gives the last corner.
constexpr std::size_t no_axis = 3, many_corners = 6;
constexpr std::size_t max_corners = 255;
constexpr int max_extent = 15;
constexpr double full_step = 127.0;

// Of a polygon: half a square's side, then in steps of the root of two.
double extent_of(int code, double area) {
    const double root = code % 2 != 0 ? 1.4142135623730951 : 1.0;
    return 0.25 * std::sqrt(area) * root * static_cast<double>(1 << code / 2);
}

int largest_axis(const Vec3& normal) {
    int axis = 0;
    normal.cwiseAbs().maxCoeff(&axis);
    return axis;
}

std::size_t header_size(std::size_t corners) {
    return corners < many_corners ? 1 : 2;
}

// Number of corners of the outline that begins there; 0 if it is empty or not valid.
std::size_t corner_count(std::string_view bytes) {
    const auto head = static_cast<unsigned char>(bytes[0]);
    if ((head & 3) == no_axis) return 0;
    const std::size_t more = head >> 2 & 3;
    if (more < many_corners - 3) return more + 3;
    const std::size_t count = bytes.size() < 2 ? 0 : static_cast<unsigned char>(bytes[1]);
    return count < many_corners ? 0 : count;
}

}  // namespace

void FaceOutlines::add(const Mesh& mesh, FaceId face, const FaceKey& key) {
    first_.push_back(static_cast<std::uint32_t>(bytes_.size()));
    const double area = key.area;
    const int axis = largest_axis(key.normal);
    const int sides[] = {(axis + 1) % 3, (axis + 2) % 3};
    const std::uint32_t count = mesh.face_corner_count(face);
    double largest = 0.0;
    const auto offset = [&](std::uint32_t corner, int side) {
        return mesh.corner_position(mesh.face_first_corner[face] + corner).cast<double>()[side] -
               key.centroid[side];
    };
    for (std::uint32_t c = 0; c < count; ++c)
        for (const int side : sides)
            largest = std::max(largest, std::abs(offset(c, side)));
    int extent = 0;
    while (extent <= max_extent && extent_of(extent, area) < largest)
        ++extent;
    if (!(area > 0.0) || count < 3 || count > max_corners || extent > max_extent) {
        bytes_.push_back(static_cast<char>(no_axis));
        return;
    }
    const std::size_t more = std::min<std::size_t>(count, many_corners) - 3;
    bytes_.push_back(static_cast<char>(static_cast<std::size_t>(axis) | more << 2 |
                                       static_cast<std::size_t>(extent) << 4));
    if (count >= many_corners) bytes_.push_back(static_cast<char>(count));
    const double step = extent_of(extent, area) / full_step;
    double carry[] = {0.0, 0.0};  // what rounding left, so that the last corner is right, too
    for (std::uint32_t c = 0; c + 1 < count; ++c) {
        for (std::size_t k = 0; k < 2; ++k) {
            const double exact = offset(c, sides[k]) / step + carry[k];
            const double rounded = std::clamp(std::round(exact), -full_step, full_step);
            carry[k] = exact - rounded;
            bytes_.push_back(static_cast<char>(static_cast<int>(rounded)));
        }
    }
}

std::vector<Vec3> FaceOutlines::corners(std::size_t i, const FaceKey& key) const {
    const std::string_view data = bytes(i);
    const std::size_t count = corner_count(data);
    if (count < 3 || !(key.area > 0.0) || key.normal.isZero()) return {};
    const auto head = static_cast<unsigned char>(data[0]);
    const int axis = head & 3;
    const int sides[] = {(axis + 1) % 3, (axis + 2) % 3};
    if (std::abs(key.normal[axis]) < 0.1) return {};  // of another face
    const double step = extent_of(head >> 4, key.area) / full_step;
    std::vector<Vec3> offsets;
    Vec3 sum = Vec3::Zero();
    const char* at = data.data() + header_size(count);
    for (std::size_t c = 0; c + 1 < count; ++c) {
        Vec3& offset = offsets.emplace_back(Vec3::Zero());
        for (const int side : sides)
            offset[side] = step * static_cast<double>(static_cast<signed char>(*at++));
        sum += offset;
    }
    offsets.emplace_back(-sum);
    for (Vec3& offset : offsets) {
        offset[axis] = 0.0;
        offset[axis] = -key.normal.dot(offset) / key.normal[axis];
        offset += key.centroid;
    }
    return offsets;
}

// By rounding and by what it carried, a step along each axis; the plane's tilt against them lengthens it.
double FaceOutlines::rounding(std::size_t i, const FaceKey& key) const {
    const int head = static_cast<unsigned char>(bytes(i)[0]);
    return 2.5 * extent_of(head >> 4, key.area) / full_step;
}

std::string_view FaceOutlines::bytes(std::size_t i) const {
    const std::size_t end = i + 1 < first_.size() ? first_[i + 1] : bytes_.size();
    return std::string_view(bytes_).substr(first_[i], end - first_[i]);
}

bool FaceOutlines::add_bytes(std::string_view bytes) {
    for (std::size_t at = 0; at < bytes.size();) {
        const std::string_view rest = bytes.substr(at);
        const std::size_t count = corner_count(rest);
        const bool empty = (static_cast<unsigned char>(rest[0]) & 3) == no_axis;
        const std::size_t size = empty ? 1 : header_size(count) + 2 * (count - 1);
        if (!empty && (count < 3 || size > rest.size())) return false;
        first_.push_back(static_cast<std::uint32_t>(bytes_.size() + at));
        at += size;
    }
    bytes_ += bytes;
    return true;
}

}  // namespace slipface
