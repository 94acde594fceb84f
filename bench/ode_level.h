// A level in ODE: a triangle mesh geometry. ODE sweeps nothing along a path; it casts rays and finds
// contacts.
#pragma once

#include <ode/ode.h>

#include "bench_scenes.h"

namespace slipface::bench {

class OdeLevel {
  public:
    explicit OdeLevel(const scenes::Soup& soup) {
        dInitODE2(0);
        for (const Vec3f& position : soup.positions)
            corners_.insert(corners_.end(), position.begin(), position.end());
        for (const auto& triangle : soup.triangles)
            indices_.insert(indices_.end(), triangle.begin(), triangle.end());
        data_ = dGeomTriMeshDataCreate();
        dGeomTriMeshDataBuildSingle(data_, corners_.data(), 3 * sizeof(float),
                                    static_cast<int>(soup.positions.size()), indices_.data(),
                                    static_cast<int>(indices_.size()), 3 * sizeof(dTriIndex));
        mesh_ = dCreateTriMesh(nullptr, data_, nullptr, nullptr, nullptr);
        sphere_ = dCreateSphere(nullptr, dReal(0.5));
        ray_ = dCreateRay(nullptr, dReal(1));
        dGeomRaySetClosestHit(ray_, 1);
    }
    ~OdeLevel() {
        for (const dGeomID geometry : {mesh_, sphere_, ray_})
            dGeomDestroy(geometry);
        dGeomTriMeshDataDestroy(data_);
        dCloseODE();
    }
    OdeLevel(const OdeLevel&) = delete;
    OdeLevel& operator=(const OdeLevel&) = delete;

    // Whether a sphere of 0.5 m touches the level.
    bool overlaps(const Vec3& centre) const {
        dGeomSetPosition(sphere_, dReal(centre.x()), dReal(centre.y()), dReal(centre.z()));
        dContactGeom contact;
        return dCollide(mesh_, sphere_, 1, &contact, sizeof contact) > 0;
    }
    // The fraction of the move at which the ray hits; 1 if it does not.
    double ray(const Query& query) const {
        const double length = query.move.norm();
        const Vec3 along = query.move / length;
        dGeomRaySetLength(ray_, dReal(length));
        dGeomRaySet(ray_, dReal(query.from.x()), dReal(query.from.y()), dReal(query.from.z()),
                    dReal(along.x()), dReal(along.y()), dReal(along.z()));
        dContactGeom contact;
        return dCollide(mesh_, ray_, 1, &contact, sizeof contact) > 0 ? double{contact.depth} / length : 1.0;
    }

  private:
    std::vector<float> corners_;
    std::vector<dTriIndex> indices_;
    dTriMeshDataID data_ = nullptr;
    dGeomID mesh_ = nullptr, sphere_ = nullptr, ray_ = nullptr;
};

}  // namespace slipface::bench
