// Faces that lie over each other in one plane.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "checks.h"
#include "slipface/base/parallel.h"
#include "triangle_blocks.h"

namespace slipface::doctor {
namespace {

constexpr double off_plane_of_size = 1e-5;
constexpr double off_plane_of_position = 8.0 * 0x1p-24;

using Flat = std::array<Vec2, 3>;

struct FlatEdge {
    Vec2 from, outside;  // outside: unit, away from the triangle; zero for an edge without length
};
using FlatEdges = std::array<FlatEdge, 3>;

FlatEdges edges_of(const Flat& flat) {
    const Vec2 centre = (flat[0] + flat[1] + flat[2]) / 3.0;
    FlatEdges edges;
    for (std::size_t i = 0; i < 3; ++i) {
        const Vec2 from = flat[i], edge = flat[(i + 1) % 3] - from;
        const double length = edge.norm();
        Vec2 outside = Vec2::Zero();
        if (length > 0.0) outside = Vec2(edge.y() / length, -edge.x() / length);
        if (outside.dot(centre - from) > 0.0) outside = -outside;
        edges[i] = {from, outside};
    }
    return edges;
}

// No edge has all corners outside, or less than `margin` inside.
bool none_separates(const FlatEdges& edges, const Flat& corners, double margin) {
    return std::all_of(edges.begin(), edges.end(), [&](const FlatEdge& edge) {
        return std::any_of(corners.begin(), corners.end(), [&](const Vec2& corner) {
            return edge.outside.dot(corner - edge.from) <= -margin;
        });
    });
}

Flat flatten(const std::array<Vec3, 3>& corners, int drop) {
    Flat flat;
    for (std::size_t i = 0; i < 3; ++i)
        flat[i] = {corners[i][(drop + 1) % 3], corners[i][(drop + 2) % 3]};
    return flat;
}

// A triangle that is not thin, to tell which others lie over it.
class CoveredTriangle {
  public:
    CoveredTriangle(const Patient& patient, TriangleId triangle)
        : normal_of_face_(patient.topology.normal[patient.mesh.triangle_face[triangle]]),
          corners_(corners_of(patient, triangle)) {
        const Vec3 cross = (corners_[1] - corners_[0]).cross(corners_[2] - corners_[0]);
        const double area = cross.norm();
        const double size = longest_edge(corners_);
        normal_ = cross / area;
        normal_.cwiseAbs().maxCoeff(&drop_);
        const double largest = std::max({corners_[0].cwiseAbs().maxCoeff(), corners_[1].cwiseAbs().maxCoeff(),
                                         corners_[2].cwiseAbs().maxCoeff()});
        off_plane_ = std::max(off_plane_of_size * size, off_plane_of_position * largest);
        margin_ = std::max(1e-3 * size, off_plane_);
    }

    bool is_covered_by(const Patient& patient, TriangleId other) {
        const auto corners = corners_of(patient, other);
        for (const Vec3& corner : corners)
            if (std::abs(normal_.dot(corner - corners_[0])) > off_plane_) return false;
        // Two things that touch, such as a crate on a floor, hide what they share.
        if (normal_of_face_.dot(patient.topology.normal[patient.mesh.triangle_face[other]]) < 0.0)
            return false;
        if (!edges_) {
            flat_ = flatten(corners_, drop_);
            edges_ = edges_of(flat_);
        }
        const Flat flat = flatten(corners, drop_);
        return none_separates(*edges_, flat, margin_) && none_separates(edges_of(flat), flat_, margin_);
    }

  private:
    Vec3 normal_of_face_;
    std::array<Vec3, 3> corners_;
    Vec3 normal_;       // unit
    int drop_;          // the axis to look along
    double off_plane_;  // metres; what is farther away lies in another plane
    double margin_;     // metres; what overlaps by less only touches
    Flat flat_;
    std::optional<FlatEdges> edges_;  // of flat_, from the first time they are needed
};

// For a first look: which lanes of `block` have a box that touches that of the triangle in lane `of` of
// `covered`, and a centre about in its plane. Those of its plane are among them.
LaneMask look(const TriangleBlock& covered, std::size_t of, const TriangleBlock& block, float off_plane) {
    LaneMask near = block.boxes.touching(covered.boxes.at(of));
    const float n[3] = {covered.normal[0][of], covered.normal[1][of], covered.normal[2][of]};
    const float c[3] = {covered.centre[0][of], covered.centre[1][of], covered.centre[2][of]};
    for (std::size_t lane = 0; lane < lanes; ++lane) {
        const float above = n[0] * (block.centre[0][lane] - c[0]) + n[1] * (block.centre[1][lane] - c[1]) +
                            n[2] * (block.centre[2][lane] - c[2]);
        near[lane] &= (above <= off_plane) & (above >= -off_plane);
    }
    return near;
}

// The triangles of a block, to find what lies over each.
class CoveredBlock {
  public:
    // `rounding`: what a coordinate of the mesh is rounded by, metres.
    CoveredBlock(const Patient& patient, const TriangleBlock& block, float rounding) : block_(&block) {
        const Mesh& mesh = patient.mesh;
        constexpr auto of_position = static_cast<float>(off_plane_of_position * 0x1p24);
        for (std::size_t lane = 0; lane < block.count; ++lane) {
            if (block.thin[lane] != 0) continue;  // it has no plane
            limit_[lane] = mesh.face_first_triangle[mesh.triangle_face[block.id[lane]]];
            const Box box = block.boxes.at(lane);
            // And the rounding of two centres, along the normal.
            off_plane_[lane] = static_cast<float>(1.01 * off_plane_of_size) * (box.max - box.min).norm() +
                               (of_position + 4.0f) * rounding;
        }
        index_of_.fill(none);
        extent_ = block.around.extent();
        find_limit();
    }

    const Box& box() const { return block_->around; }
    // Only triangles below this can be an answer to one of them: of faces before, and before the one known.
    TriangleId limit() const { return highest_; }

    // Returns how much work it was.
    std::size_t look_in(const Patient& patient, const TriangleBlock& other) {
        std::size_t work = 4;
        // What is farther away is rounded by more.
        const float slack = 6.0f * 0x1p-24f * (extent_ + other.around.extent());
        each_bit(bits_of(block_->boxes.touching(other.around)), [&](std::size_t of) {
            if (other.lowest >= limit_[of]) return;
            each_bit(bits_of(look(*block_, of, other, off_plane_[of] + slack)), [&](std::size_t lane) {
                if (other.id[lane] >= limit_[of]) return;
                ++work;
                if (!covered(patient, of).is_covered_by(patient, other.id[lane])) return;
                limit_[of] = other.id[lane];
                find_limit();
            });
        });
        return work;
    }

    // over[triangle]: the first triangle of a face before its own that lies over it.
    void write(const Mesh& mesh, std::span<TriangleId> over) const {
        for (std::size_t lane = 0; lane < block_->count; ++lane) {
            const TriangleId id = block_->id[lane];
            const bool found = limit_[lane] < mesh.face_first_triangle[mesh.triangle_face[id]];
            if (found && block_->thin[lane] == 0) over[id] = limit_[lane];
        }
    }

  private:
    static constexpr std::uint8_t none = lanes;

    CoveredTriangle& covered(const Patient& patient, std::size_t lane) {
        if (index_of_[lane] == none) {
            triangles_.reserve(lanes);
            index_of_[lane] = static_cast<std::uint8_t>(triangles_.size());
            triangles_.emplace_back(patient, block_->id[lane]);
        }
        return triangles_[index_of_[lane]];
    }
    void find_limit() { highest_ = *std::max_element(limit_.begin(), limit_.end()); }

    const TriangleBlock* block_;
    std::array<TriangleId, lanes> limit_{};
    TriangleId highest_ = 0;
    Lanes off_plane_{};
    float extent_ = 0.0f;
    std::vector<CoveredTriangle> triangles_;    // of the lanes that needed it so far
    std::array<std::uint8_t, lanes> index_of_;  // [lane] in triangles_, or none
};

// Finds what lies over the triangles of a group, which takes about `most` steps of work. False if that was
// not enough.
bool look_over(const Patient& patient, const TriangleBlocks& triangles, float rounding, std::size_t group,
               std::size_t most, std::span<TriangleId> over) {
    std::vector<CoveredBlock> covered;
    covered.reserve(lanes);
    for (const TriangleBlock& block : triangles.blocks_of(group))
        covered.emplace_back(patient, block, rounding);
    std::size_t work = 0;
    const auto limit = [&] {
        TriangleId highest = 0;
        for (const CoveredBlock& block : covered)
            highest = std::max(highest, block.limit());
        return work < most ? highest : 0;
    };
    const BlockGroup& own = triangles.group(group);
    triangles.each_group_touching(own.around, limit(), [&](std::size_t index) {
        const BlockGroup& other = triangles.group(index);
        const auto blocks = triangles.blocks_of(index);
        each_bit(bits_of(own.boxes.touching(other.around)), [&](std::size_t i) {
            if (other.lowest >= covered[i].limit()) return;
            each_bit(bits_of(other.boxes.touching(covered[i].box())), [&](std::size_t k) {
                if (other.lowest_of[k] < covered[i].limit()) work += covered[i].look_in(patient, blocks[k]);
            });
        });
        ++work;
        return limit();
    });
    for (const CoveredBlock& block : covered)
        block.write(patient.mesh, over);
    return work < most;
}

// over[triangle]: the first triangle of a face before its own that lies over it, or no_id. Returns how many
// triangles were not compared with all that are near, because there are too many.
std::size_t find_triangles_over(const Patient& patient, std::span<TriangleId> over) {
    const Mesh& mesh = patient.mesh;
    const auto rounding = static_cast<float>(
        0x1p-24 * std::max(mesh.bounds.min.cwiseAbs().maxCoeff(), mesh.bounds.max.cwiseAbs().maxCoeff()));
    const TriangleBlocks triangles(mesh);
    std::vector<std::uint8_t> unfinished(triangles.group_count(), 1);
    const auto look = [&](std::size_t most) {
        parallel_for(unfinished.size(), 8, [&](std::size_t begin, std::size_t end) {
            for (std::size_t group = begin; group < end; ++group)
                if (unfinished[group] != 0 && look_over(patient, triangles, rounding, group, most, over))
                    unfinished[group] = 0;
        });
        return static_cast<std::size_t>(std::count(unfinished.begin(), unfinished.end(), 1));
    };
    // Groups of large triangles have more work than others: as much together.
    std::size_t left = look(8'000);
    if (left > 0) left = look(60'000'000 / left);
    return std::min(left * lanes * lanes, mesh.triangle_count());
}

}  // namespace

std::size_t find_overlaps(const Patient& patient, Problems& out) {
    const Mesh& mesh = patient.mesh;
    std::vector<TriangleId> over(mesh.triangle_count(), no_id);
    const std::size_t untried = find_triangles_over(patient, over);
    FaceId last = no_id;
    for (TriangleId t = 0; t < over.size(); ++t) {
        const FaceId face = mesh.triangle_face[t];
        if (over[t] == no_id || face == last) continue;
        const FaceId other = mesh.triangle_face[over[t]];
        // Faces with the same corners are duplicates, said already.
        if (sorted_loop(patient, face) == sorted_loop(patient, other)) continue;
        last = face;
        const auto corners = corners_of(patient, t);
        out.push_back({ProblemKind::overlap, face, other, (corners[0] + corners[1] + corners[2]) / 3.0, 0,
                       fmt::format("Overlaps face {} in one plane", other)});
    }
    return untried;
}

}  // namespace slipface::doctor
