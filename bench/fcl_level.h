// A level in FCL. Oriented boxes: for boxes along the axes FCL copies the whole mesh at every query.
// fastest.
#pragma once

#include <fcl/fcl.h>

#include "bench_scenes.h"

namespace slipface::bench {

class FclLevel {
  public:
    explicit FclLevel(const scenes::Soup& soup)
        : mesh_(std::make_shared<fcl::BVHModel<fcl::OBBRSS<double>>>()),
          sphere_(std::make_shared<fcl::Sphere<double>>(0.5)),
          level_(mesh_) {
        mesh_->beginModel(static_cast<int>(soup.triangles.size()), static_cast<int>(soup.positions.size()));
        std::vector<Vec3> corners;
        for (const Vec3f& position : soup.positions)
            corners.push_back(position.cast<double>());
        std::vector<fcl::Triangle> triangles;
        for (const auto& triangle : soup.triangles)
            triangles.emplace_back(triangle[0], triangle[1], triangle[2]);
        mesh_->addSubModel(corners, triangles);
        mesh_->endModel();
        level_.computeAABB();
    }

    // Whether a sphere of 0.5 m touches the level.
    bool overlaps(const Vec3& centre) const {
        const fcl::CollisionObject<double> body(sphere_, Eigen::Matrix3d::Identity(), centre);
        fcl::CollisionResult<double> result;
        return fcl::collide(&level_, &body, fcl::CollisionRequest<double>(), result) > 0;
    }

  private:
    std::shared_ptr<fcl::BVHModel<fcl::OBBRSS<double>>> mesh_;
    std::shared_ptr<fcl::Sphere<double>> sphere_;
    fcl::CollisionObject<double> level_;
};

}  // namespace slipface::bench
