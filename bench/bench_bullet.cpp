// The same sweeps through Bullet 3, with its documented settings: btBvhTriangleMeshShape with quantised
// boxes, no allowed penetration. An ellipsoid is a btMultiSphereShape of one sphere scaled along the axes,
// which is the nearest that Bullet has.
#include <benchmark/benchmark.h>
#include <btBulletCollisionCommon.h>

#include "bench_scenes.h"

namespace slipface::bench {
namespace {

btVector3 bt(const Vec3& v) {
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

    const btCollisionWorld& world() const { return world_; }

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

const BulletLevel& bullet_level(std::int64_t triangles) {
    static std::map<std::int64_t, BulletLevel> levels;
    return levels.try_emplace(triangles, level(triangles).soup).first->second;
}

void bullet_sweep(benchmark::State& state) {
    const btCollisionWorld& world = bullet_level(state.range(0)).world();
    const bool ellipsoid = state.range(2) != 0;
    const Vec3 radii = radii_of(ellipsoid);
    const auto list = queries(level(state.range(0)), radii, static_cast<double>(state.range(1)) / 1000);
    btSphereShape sphere(btScalar(0.5));
    const btVector3 origin(0, 0, 0);
    const btScalar one(1);
    btMultiSphereShape scaled(&origin, &one, 1);
    scaled.setLocalScaling(bt(radii));
    const btConvexShape* shape = ellipsoid ? static_cast<const btConvexShape*>(&scaled) : &sphere;
    std::size_t i = 0;
    std::size_t hits = 0;
    for (auto _ : state) {
        const Query& query = list[i++ & 4095];
        const btVector3 from = bt(query.from);
        const btVector3 to = bt(query.from + query.move);
        btCollisionWorld::ClosestConvexResultCallback result(from, to);
        world.convexSweepTest(shape, btTransform(btQuaternion::getIdentity(), from),
                              btTransform(btQuaternion::getIdentity(), to), result);
        hits += result.hasHit();
        benchmark::DoNotOptimize(result.m_closestHitFraction);
    }
    state.counters["hits"] = static_cast<double>(hits) / static_cast<double>(state.iterations());
}
BENCHMARK(bullet_sweep)->Apply(sweep_arguments);

}  // namespace
}  // namespace slipface::bench
