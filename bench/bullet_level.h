// A level in Bullet 3 with its documented settings: btBvhTriangleMeshShape with quantised boxes, no allowed
// penetration. An ellipsoid is a btMultiSphereShape of one sphere scaled along the axes, the nearest that
// Bullet offers.
#pragma once

#include <btBulletCollisionCommon.h>

#include <memory>

#include "bench_scenes.h"

namespace slipface::bench {

inline btVector3 bt(const Vec3& v) {
    return {static_cast<btScalar>(v.x()), static_cast<btScalar>(v.y()), static_cast<btScalar>(v.z())};
}

class BulletLevel {
  public:
    explicit BulletLevel(const scenes::Soup& soup)
        : positions_(soup.positions),
          dispatcher_(&configuration_),
          world_(&dispatcher_, &broadphase_, &configuration_) {
        for (const auto& triangle : soup.triangles) {
            for (const std::uint32_t index : triangle)
                indices_.push_back(static_cast<int>(index));
        }
        mesh_ = std::make_unique<btTriangleIndexVertexArray>(
            static_cast<int>(soup.triangles.size()), indices_.data(), static_cast<int>(3 * sizeof(int)),
            static_cast<int>(positions_.size()), positions_[0].data(), static_cast<int>(sizeof(Vec3f)));
        shape_ = std::make_unique<btBvhTriangleMeshShape>(mesh_.get(), true);
        object_.setCollisionShape(shape_.get());
        world_.addCollisionObject(&object_);
    }
    ~BulletLevel() { world_.removeCollisionObject(&object_); }
    BulletLevel(const BulletLevel&) = delete;
    BulletLevel& operator=(const BulletLevel&) = delete;

    bool sweep(const btConvexShape& shape, const Query& query) const {
        const btVector3 from = bt(query.from);
        const btVector3 to = bt(query.from + query.move);
        btCollisionWorld::ClosestConvexResultCallback result(from, to);
        world_.convexSweepTest(&shape, btTransform(btQuaternion::getIdentity(), from),
                               btTransform(btQuaternion::getIdentity(), to), result);
        return result.hasHit();
    }
    // Whether a sphere of 0.5 m touches the level.
    bool overlaps(const Vec3& centre) const {
        struct AnyContact : btCollisionWorld::ContactResultCallback {
            bool found = false;
            btScalar addSingleResult(btManifoldPoint& point, const btCollisionObjectWrapper*, int, int,
                                     const btCollisionObjectWrapper*, int, int) override {
                found = found || point.getDistance() <= btScalar(0);
                return btScalar(0);
            }
        } any;
        btCollisionObject body;
        btSphereShape sphere(btScalar(0.5));
        body.setCollisionShape(&sphere);
        body.setWorldTransform(btTransform(btQuaternion::getIdentity(), bt(centre)));
        // The world's own object is not changed; the interface has no const.
        const_cast<btCollisionWorld&>(world_).contactPairTest(&body, const_cast<btCollisionObject*>(&object_),
                                                              any);
        return any.found;
    }

  private:
    std::vector<Vec3f> positions_;
    std::vector<int> indices_;
    std::unique_ptr<btTriangleIndexVertexArray> mesh_;
    std::unique_ptr<btBvhTriangleMeshShape> shape_;
    btCollisionObject object_;
    btDefaultCollisionConfiguration configuration_;
    btCollisionDispatcher dispatcher_;
    btDbvtBroadphase broadphase_;
    btCollisionWorld world_;
};

inline std::unique_ptr<btConvexShape> bullet_shape(bool ellipsoid) {
    if (!ellipsoid) return std::make_unique<btSphereShape>(btScalar(0.5));
    const btVector3 origin(0, 0, 0);
    const btScalar one(1);
    auto shape = std::make_unique<btMultiSphereShape>(&origin, &one, 1);
    shape->setLocalScaling(bt(radii_of(true)));
    return shape;
}

}  // namespace slipface::bench
