// A level in Embree 3, built with medium quality.
#pragma once

#include <embree3/rtcore.h>

#include <string>

#include "bench_scenes.h"

namespace slipface::bench {

class EmbreeScene {
  public:
    // `robust`: no ray passes between two triangles that share an edge; ours never do. `threads`: for the
    // build.
    explicit EmbreeScene(const scenes::Soup& soup, bool robust = false, int threads = 1)
        : device_(rtcNewDevice(("threads=" + std::to_string(threads)).c_str())),
          scene_(rtcNewScene(device_)) {
        if (robust) rtcSetSceneFlags(scene_, RTC_SCENE_FLAG_ROBUST);
        RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
        auto* vertices = static_cast<float*>(rtcSetNewGeometryBuffer(
            geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 12, soup.positions.size()));
        for (std::size_t i = 0; i < soup.positions.size(); ++i)
            std::copy_n(soup.positions[i].data(), 3, vertices + 3 * i);
        auto* indices = static_cast<std::uint32_t*>(rtcSetNewGeometryBuffer(
            geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 12, soup.triangles.size()));
        for (std::size_t i = 0; i < soup.triangles.size(); ++i)
            std::copy_n(soup.triangles[i].data(), 3, indices + 3 * i);
        rtcCommitGeometry(geometry);
        rtcAttachGeometry(scene_, geometry);
        rtcReleaseGeometry(geometry);
        rtcCommitScene(scene_);
    }
    ~EmbreeScene() {
        rtcReleaseScene(scene_);
        rtcReleaseDevice(device_);
    }
    EmbreeScene(const EmbreeScene&) = delete;
    EmbreeScene& operator=(const EmbreeScene&) = delete;

    float ray(const Query& query) const {
        const Vec3f from = query.from.cast<float>();
        const Vec3f move = query.move.cast<float>();
        RTCRayHit hit{};
        hit.ray.org_x = from.x();
        hit.ray.org_y = from.y();
        hit.ray.org_z = from.z();
        hit.ray.dir_x = move.x();
        hit.ray.dir_y = move.y();
        hit.ray.dir_z = move.z();
        hit.ray.tfar = 1.0F;
        hit.ray.mask = ~0U;
        hit.hit.geomID = RTC_INVALID_GEOMETRY_ID;
        RTCIntersectContext context;
        rtcInitIntersectContext(&context);
        rtcIntersect1(scene_, &context, &hit);
        return hit.ray.tfar;
    }

  private:
    RTCDevice device_;
    RTCScene scene_;
};

}  // namespace slipface::bench
