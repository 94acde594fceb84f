#include "face_index.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "packed_faces.h"
#include "slipface/level/material_name.h"

namespace slipface {

FaceIndex::FaceIndex(const Mesh& mesh, SurfaceTable surfaces) : mesh_(mesh) {
    std::vector<FaceId> faces(mesh.face_count());
    std::iota(faces.begin(), faces.end(), FaceId{0});
    keys_ = face_keys(mesh, faces);
    material_base_.reserve(mesh.materials.size());
    for (const Material& material : mesh.materials)
        material_base_.push_back(base_material(material.name, surfaces));

    Vec3 extent = Vec3::Zero();
    for (const FaceKey& key : keys_)
        extent = extent.cwiseMax(key.centroid.cwiseAbs());
    centroids_.emplace(faces.size(), 8.0 * position_tolerance(extent),
                       [&](std::size_t face) { return keys_[face].centroid; });
    by_hash_.reserve(keys_.size());
    for (const FaceId face : faces)
        by_hash_.push_back({packed_hash(keys_[face].loop_hash), face});
    sort_by_key(by_hash_);
}

std::vector<FaceId> FaceIndex::with_hash(std::uint64_t loop_hash) const {
    std::vector<FaceId> faces;
    const std::uint64_t wanted = packed_hash(loop_hash);
    auto entry = std::lower_bound(by_hash_.begin(), by_hash_.end(), wanted,
                                  [](const KeyedIndex& a, std::uint64_t hash) { return a.key < hash; });
    for (; entry != by_hash_.end() && entry->key == wanted; ++entry)
        faces.push_back(entry->index);
    return faces;
}

std::vector<FaceId> FaceIndex::near(const Vec3& centroid, double tolerance) const {
    std::vector<FaceId> faces;
    centroids_->near(centroid, tolerance, [&](FaceId face) {
        if ((keys_[face].centroid - centroid).norm() <= tolerance) faces.push_back(face);
    });
    std::sort(faces.begin(), faces.end());
    return faces;
}

bool FaceIndex::covers(FaceId face, const Vec3& point, const Vec3& direction) const {
    for (std::uint32_t t = mesh_.face_first_triangle[face]; t < mesh_.face_first_triangle[face + 1]; ++t) {
        Vec3 corner[3];
        for (std::size_t i = 0; i < 3; ++i) {
            corner[i] = mesh_.corner_position(mesh_.triangles[t][i]).cast<double>() - point;
        }
        // The line hits the triangle if it passes all edges on the same side.
        const double a = direction.dot(corner[0].cross(corner[1]));
        const double b = direction.dot(corner[1].cross(corner[2]));
        const double c = direction.dot(corner[2].cross(corner[0]));
        if (((a >= 0 && b >= 0 && c >= 0) || (a <= 0 && b <= 0 && c <= 0)) && a + b + c != 0.0) return true;
    }
    return false;
}

double FaceIndex::radius(FaceId face) const {
    const std::uint32_t first = mesh_.face_first_corner[face];
    double length = 0.0;
    for (std::uint32_t i = 0; i < mesh_.face_corner_count(face); ++i) {
        length =
            std::max(length, (mesh_.corner_position(first + i).cast<double>() - keys_[face].centroid).norm());
    }
    return length;
}

bool FaceIndex::is_sliver(FaceId face, double tolerance) const {
    return keys_[face].area <= 4.0 * tolerance * radius(face);
}

}  // namespace slipface
