// A second manager beside GeometricManager (lecture: "VoxelManager" with a "ChunkGenerator"): a world of
// blocks in chunks that come and go as its walkers move. Each chunk is a level of its own; adding or removing
// one rebuilds no other.
#pragma once

#include <slipface/level/level_scene.h>
#include <slipface/movement/step.h>
#include <slipface/world/geometric_manager.h>

#include <array>
#include <functional>
#include <map>
#include <memory>

using ChunkId = std::array<int, 3>;  // the chunk's lowest block is 16 times this

// Whether there is a block with its lowest corner at (x, y, z), whole metres.
using ChunkGenerator = std::function<bool(int x, int y, int z)>;

// Rolling hills over rock without a bottom, with caves and pillars: the same for the same seed.
ChunkGenerator hills(std::uint64_t seed);

// Somebody who walks among blocks.
class Walker : public slipface::Entity {
  public:
    slipface::PlayerState state;
    slipface::PlayerInput input;
    slipface::MovementSettings settings;
    void on_draw(slipface::Graphics& graphics) const override {
        graphics.draw_ellipsoid(state.position, settings.radii);
    }
};

class VoxelManager : public slipface::Manager {
  public:
    static constexpr int edge = 16;  // blocks of a metre

    // With `beside`, walkers collide with its level, too; it must be added to the world before this one.
    explicit VoxelManager(ChunkGenerator generator, int view_chunks = 2,
                          slipface::GeometricManager* beside = nullptr)
        : generator_(std::move(generator)), view_chunks_(view_chunks), beside_(beside) {}

    void on_tick(double seconds) override;
    void on_draw(slipface::Graphics& graphics) override;
    void on_entity_added(slipface::Entity& entity) override;
    void on_entity_removed(slipface::Entity& entity) override;

    // What a walker of these radii at `centre` can touch in one tick. Valid until the next tick or call.
    slipface::MovementScene scene_at(const slipface::Vec3& centre);
    std::size_t chunk_count() const { return chunks_.size(); }
    std::size_t built_count() const { return built_; }

  private:
    struct Chunk {
        slipface::Level level;
        slipface::CollisionWorld collision;
    };
    void keep_around_walkers();
    std::unique_ptr<Chunk> build(const ChunkId& id) const;
    const Chunk& chunk_at(const ChunkId& id);

    ChunkGenerator generator_;
    int view_chunks_;
    slipface::GeometricManager* beside_;
    std::map<ChunkId, std::unique_ptr<Chunk>> chunks_;
    std::vector<Walker*> walkers_;
    std::vector<slipface::MovingPart> near_;
    slipface::CollisionWorld nothing_;
    std::vector<slipface::SurfaceType> types_ = slipface::preset_surface_types();
    std::size_t built_ = 0;
};
