// The checks, one function each. Each appends its problems in ascending order of face, and returns how many
// places it has left untried because there are too many.
#pragma once

#include <cstddef>
#include <optional>

#include "slipface/collision/collision_world.h"
#include "slipface/doctor/doctor.h"
#include "topology.h"

namespace slipface::doctor {

// The world is built when the first check asks for it: a level without suspects needs none. Ask before a
// parallel loop, not first from within it: the build is parallel itself.
class WorldOnDemand {
  public:
    explicit WorldOnDemand(const Level& level) : level_(level) {}
    const CollisionWorld& get();

  private:
    const Level& level_;
    std::optional<CollisionWorld> world_;
};

struct Patient {
    const Level& level;
    const Mesh& mesh;
    const Topology& topology;
    const ResolvedSurfaces& resolved;
    WorldOnDemand& world_on_demand;
    // About how many steps, sweeps and rays have been tried at a place, whose number follows from the level
    // alone.
    std::size_t& effort;

    const CollisionWorld& world() const { return world_on_demand.get(); }

    // What queries within `box` cost beyond the usual: among very many triangles, which boxes do not tell
    // apart, one is as slow as thousands.
    std::size_t effort_among_many(std::size_t queries, const Aabb& box) const;
    void spend(std::size_t queries, const Aabb& box) const { effort += effort_among_many(queries, box); }
    // Too much for one place.
    bool is_spent() const { return effort > 300'000; }

    const SurfaceType& surface(FaceId face) const { return level.surfaces[resolved.surface[face]]; }
};

using Problems = std::vector<Problem>;

std::size_t find_open_edges(const Patient& patient, Problems& out);  // T-junctions and cracks
void find_slivers(const Patient& patient, Problems& out);            // faces with triangles too thin
void find_duplicates(const Patient& patient, Problems& out);         // the same corners twice
std::size_t find_overlaps(const Patient& patient, Problems& out);    // coplanar faces that overlap
void find_flipped(const Patient& patient, Problems& out);  // wound the other way than their neighbours
std::size_t find_acute_corners(const Patient& patient, Problems& out);  // wedges that the player can enter
std::size_t find_limit_slopes(const Patient& patient, Problems& out);
std::size_t find_limit_steps(const Patient& patient, Problems& out);
void find_orphans(const Patient& patient, Problems& out);
void find_missing_textures(const Patient& patient, Problems& out);

inline std::array<Vec3, 3> corners_of(const Patient& patient, TriangleId triangle) {
    std::array<Vec3, 3> corners;
    for (std::size_t i = 0; i < 3; ++i)
        corners[i] = patient.mesh.corner_position(patient.mesh.triangles[triangle][i]).cast<double>();
    return corners;
}
std::vector<std::uint32_t> sorted_loop(const Patient& patient, FaceId face);  // welded vertices, ascending

std::string metres(double value);     // "0.40 mm", "12 cm", "1.25 m"
std::string degrees(double radians);  // "49.8°"

}  // namespace slipface::doctor
