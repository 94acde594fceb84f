#include "voxel_manager.h"

#include <slipface/level/level_scene.h>
#include <slipface/mesh/build.h>

#include <algorithm>
#include <cmath>

using namespace slipface;

namespace {

ChunkId chunk_of(const Vec3& point) {
    ChunkId id{};
    for (int axis = 0; axis < 3; ++axis)
        id[static_cast<std::size_t>(axis)] = static_cast<int>(std::floor(point[axis] / VoxelManager::edge));
    return id;
}

std::uint64_t mix(std::uint64_t seed, int x, int y, int z) {
    for (const int part : {x, y, z}) {
        seed ^=
            static_cast<std::uint64_t>(static_cast<std::int64_t>(part)) + 0x9e3779b97f4a7c15ULL + (seed << 6);
        seed = (seed ^ (seed >> 30)) * 0xbf58476d1ce4e5b9ULL;
        seed ^= seed >> 27;
    }
    return seed;
}

int floor_div(int a, int b) {
    return a / b - (a % b < 0 ? 1 : 0);
}

// Values at the corners of a grid of `size` blocks, blended in between: 0 to 1.
double noise(std::uint64_t seed, int x, int z, int size) {
    const int i = floor_div(x, size), j = floor_div(z, size);
    const double u = static_cast<double>(x - i * size) / size, v = static_cast<double>(z - j * size) / size;
    const auto at = [&](int a, int b) { return static_cast<double>(mix(seed, a, 0, b) >> 11) * 0x1p-53; };
    return (at(i, j) * (1 - u) + at(i + 1, j) * u) * (1 - v) +
           (at(i, j + 1) * (1 - u) + at(i + 1, j + 1) * u) * v;
}

}  // namespace

ChunkGenerator hills(std::uint64_t seed) {
    return [seed](int x, int y, int z) {
        const double height = 12.0 * noise(seed, x, z, 24) + 4.0 * noise(seed + 1, x, z, 7);
        const bool pillar = mix(seed + 2, floor_div(x, 2), 0, floor_div(z, 2)) % 60 == 0 && y < height + 7.0;
        const bool cave = y > -6 && noise(seed + 3, x, z, 9) > 0.7 && y < height - 3.0;
        return (y < height || pillar) && !cave;
    };
}

// A face for each side of a block that is open. A block's sides belong to its own chunk, so that neighbours
// need not know each other's geometry.
std::unique_ptr<VoxelManager::Chunk> VoxelManager::build(const ChunkId& id) const {
    PolygonSoup soup;
    soup.face_first_corner.push_back(0);
    soup.materials = {{"earth", Vec3f(0.55F, 0.42F, 0.32F), ""}, {"grass", Vec3f(0.45F, 0.66F, 0.34F), ""}};
    for (int block = 0; block < edge * edge * edge; ++block) {
        const std::array<int, 3> at{id[0] * edge + block % edge, id[1] * edge + block / edge % edge,
                                    id[2] * edge + block / (edge * edge)};
        if (!generator_(at[0], at[1], at[2])) continue;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            for (const int side : {0, 1}) {
                std::array<int, 3> other = at;
                other[axis] += side == 1 ? 1 : -1;
                if (generator_(other[0], other[1], other[2])) continue;
                const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
                constexpr std::array<std::array<int, 2>, 4> around{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
                for (std::size_t k = 0; k < 4; ++k) {
                    const auto [a, b] = around[side == 1 ? k : 3 - k];  // counter-clockwise from outside
                    std::array<int, 3> corner = at;
                    corner[axis] += side;
                    corner[u] += a;
                    corner[v] += b;
                    soup.corner_position.emplace_back(static_cast<float>(corner[0]),
                                                      static_cast<float>(corner[1]),
                                                      static_cast<float>(corner[2]));
                }
                soup.face_first_corner.push_back(static_cast<std::uint32_t>(soup.corner_position.size()));
                soup.face_material.push_back(axis == 1 && side == 1 ? 1 : 0);
            }
        }
    }
    auto chunk = std::make_unique<Chunk>();
    if (soup.corner_position.empty()) return chunk;  // all air or all rock
    Result<MeshPtr> mesh = build_mesh(std::move(soup));
    if (!mesh) return chunk;
    chunk->level.mesh = *mesh;
    if (Result<CollisionWorld> world = build_collision_world(chunk->level))
        chunk->collision = std::move(*world);
    return chunk;
}

const VoxelManager::Chunk& VoxelManager::chunk_at(const ChunkId& id) {
    std::unique_ptr<Chunk>& chunk = chunks_[id];
    if (!chunk) {
        chunk = build(id);
        ++built_;
    }
    return *chunk;
}

// The chunks that a walker can touch in a tick are there before it moves; those that nobody is near go.
void VoxelManager::keep_around_walkers() {
    std::erase_if(chunks_, [&](const auto& entry) {
        return std::ranges::none_of(walkers_, [&](const Walker* walker) {
            const ChunkId here = chunk_of(walker->state.position);
            for (std::size_t axis = 0; axis < 3; ++axis)
                if (std::abs(entry.first[axis] - here[axis]) > view_chunks_ + 1) return false;
            return true;
        });
    });
    for (const Walker* walker : walkers_) {
        const ChunkId here = chunk_of(walker->state.position);
        for (int x = -view_chunks_; x <= view_chunks_; ++x)
            for (int y = -1; y <= 1; ++y)
                for (int z = -view_chunks_; z <= view_chunks_; ++z)
                    chunk_at({here[0] + x, here[1] + y, here[2] + z});
    }
}

// Chunks are the scene's parts that could move and do not.
MovementScene VoxelManager::scene_at(const Vec3& centre) {
    near_.clear();
    if (beside_ != nullptr) {
        const std::span<const MovingPart> platforms = beside_->scene().platforms;
        near_.assign(platforms.begin(), platforms.end());
    }
    const double reach = 0.5 * edge;  // more than a walker moves in a tick
    const ChunkId low = chunk_of(centre - Vec3::Constant(reach)),
                  high = chunk_of(centre + Vec3::Constant(reach));
    for (int x = low[0]; x <= high[0]; ++x)
        for (int y = low[1]; y <= high[1]; ++y)
            for (int z = low[2]; z <= high[2]; ++z)
                if (const Chunk& chunk = chunk_at({x, y, z}); chunk.collision.triangle_count() > 0)
                    near_.emplace_back().rest = &chunk.collision;
    if (beside_ == nullptr) return {.collision = nothing_, .surfaces = types_, .platforms = near_};
    MovementScene scene = beside_->scene();
    scene.platforms = near_;
    scene.tree = nullptr;  // it does not know the chunks
    return scene;
}

void VoxelManager::on_tick(double seconds) {
    keep_around_walkers();
    for (Walker* walker : walkers_)
        walker->state =
            step(scene_at(walker->state.position), walker->settings, walker->state, walker->input, seconds)
                .state;
}

void VoxelManager::on_draw(Graphics& graphics) {
    for (const auto& [id, chunk] : chunks_)
        if (chunk->level.mesh) graphics.draw_level(chunk->level, 0.0);
}

void VoxelManager::on_entity_added(Entity& entity) {
    if (auto* walker = dynamic_cast<Walker*>(&entity)) walkers_.push_back(walker);
}

void VoxelManager::on_entity_removed(Entity& entity) {
    std::erase(walkers_, dynamic_cast<Walker*>(&entity));
}
