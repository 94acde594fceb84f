// The floors on which a player may begin, ranked by how much of the level is reached from them.
#pragma once

#include <optional>

#include "floor_columns.h"
#include "start_room.h"

namespace slipface {

class OpenFloor {
  public:
    // `scene` and `settings` must outlive it.
    OpenFloor(const MovementScene& scene, const MovementSettings& settings);

    // Whether a player there is in no solid, and reaches nearly as much from the floor below as from
    // anywhere.
    bool is_good(const Vec3& centre) const;
    // Whether the floor below belongs to the inside of a solid.
    bool in_solid(const Vec3& centre) const;
    // The best place; nothing: no floor has room. `all_tried` becomes false if there were too many triangles
    // to look at all places.
    std::optional<Vec3> best(bool& all_tried) const;

  private:
    // Floor that a player walks to and fro on.
    struct Region {
        std::size_t cells = 0, front = 0;       // floor in columns; of these with faces that look up
        std::size_t inside = 0, inverted = 0;   // of these inside of shells that look out, and in
        double reached = 0.0;                   // m^2, by walking, jumping and dropping
        bool candidate = false, solid = false;  // as the faces are wound; a solid's inside
        bool good = false;
    };
    struct Spot {
        std::size_t standing = 0;  // index into columns_.standings
        std::uint32_t region = 0;
        int links = 0;  // neighbouring cells of the same region
    };

    void connect();
    void attribute();
    void judge();
    std::size_t root(std::size_t i);
    const Region* region_around(const Vec3& centre, int dx, int dz) const;
    std::uint32_t region_near(std::size_t cell, double y) const;
    template <class Visit>
    void arcs(std::size_t cell, const FloorColumns::Place& from, int dx, int dz, Visit visit) const;
    bool walks(const FloorColumns::Place& a, const FloorColumns::Place& b) const;
    std::optional<Vec3> stand_at(const FloorColumns::Standing& standing) const;

    const MovementScene& scene_;
    const MovementSettings& settings_;
    FloorColumns columns_;
    double step_ = 0.0, jump_ = 0.0;     // metres
    std::vector<std::size_t> parent_;    // [place]
    std::vector<std::uint32_t> region_;  // [place] index into regions_, or no_id
    std::vector<Region> regions_;
    std::vector<std::pair<std::uint32_t, std::uint32_t>> ways_;  // from a region to another, ascending
    std::vector<Spot> spots_;
};

}  // namespace slipface
