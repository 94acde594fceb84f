// The same triangles twice: as instances of meshes, and as one flat soup.
#pragma once

#include "scenes.h"
#include "slipface/collision/instances.h"

namespace slipface::scenes {

// Faces 0, 1, 2, ... without gaps, as instances have them.
inline Soup dense(Soup soup) {
    FaceId next = 0;
    for (std::size_t i = 0; i < soup.faces.size(); ++i) {
        const FaceId was = soup.faces[i];
        const bool other = i + 1 < soup.faces.size() && soup.faces[i + 1] != was;
        soup.faces[i] = next;
        if (other) ++next;
    }
    return soup;
}

inline std::shared_ptr<const CollisionMesh> shared_mesh(const Soup& soup) {
    auto mesh = CollisionMesh::build(soup.view());
    if (!mesh) throw std::runtime_error(mesh.error().text());
    return *mesh;
}

class Instanced {
  public:
    Instanced(Soup ground, const std::vector<Soup>& meshes) : ground_(std::move(ground)), flat_(ground_) {
        for (const Soup& mesh : meshes)
            meshes_.push_back({dense(mesh), shared_mesh(dense(mesh))});
        faces_ = ground_.faces.empty() ? 0 : ground_.faces.back() + 1;
    }

    void add(std::size_t mesh, const Placement& at) {
        const auto& [soup, shared] = meshes_[mesh];
        instances_.push_back({shared, at, faces_});
        const auto first = static_cast<std::uint32_t>(flat_.positions.size());
        for (const Vec3f& rest : soup.positions)
            flat_.positions.push_back(at.apply(rest));
        for (auto [a, b, c] : soup.triangles) {
            if (at.mirrors()) std::swap(b, c);
            flat_.triangles.push_back({first + a, first + b, first + c});
        }
        for (const FaceId face : soup.faces)
            flat_.faces.push_back(faces_ + face);
        faces_ += static_cast<FaceId>(shared->face_count());
    }
    const Soup& flat() const { return flat_; }
    FaceId faces() const { return faces_; }
    CollisionWorld world() const {
        auto world = CollisionWorld::build(ground_.view(), instances_);
        if (!world) throw std::runtime_error(world.error().text());
        return std::move(*world);
    }

  private:
    Soup ground_, flat_;
    std::vector<std::pair<Soup, std::shared_ptr<const CollisionMesh>>> meshes_;
    std::vector<Instance> instances_;
    FaceId faces_ = 0;
};

// A scale for each axis up to `most` times larger or smaller, one axis in two mirrored.
inline Vec3 random_scale(Random& random, double most) {
    Vec3 scale;
    for (int axis = 0; axis < 3; ++axis)
        scale[axis] = std::pow(most, random.uniform(-1, 1)) * (random.below(2) == 0 ? 1.0 : -1.0);
    return scale;
}

}  // namespace slipface::scenes
