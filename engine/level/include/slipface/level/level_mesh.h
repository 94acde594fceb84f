// The geometry of a level: its own faces, and after them those of its props.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <type_traits>
#include <utility>

#include "slipface/mesh/mesh.h"

namespace slipface {

struct PlacedGeometry;

// Reads as a pointer to one mesh that has all faces. For a level with props this mesh is made at the first
// such access and kept as long as a copy of this object: 10 000 props of a thousand triangles are half a
// gigabyte. The functions called with a dot do without it; prop_instances(), resolve_parts() and prop_mesh()
// are the ways to what props share. Safe to read from several threads.
class LevelMesh {
  public:
    LevelMesh() = default;
    LevelMesh(std::nullptr_t) {}
    template <class T>
    requires std::is_convertible_v<T, MeshPtr> LevelMesh(T&& mesh) : own_(std::forward<T>(mesh)) {}
    LevelMesh(MeshPtr own, std::shared_ptr<const PlacedGeometry> placed)
        : own_(std::move(own)), placed_(std::move(placed)) {}

    explicit operator bool() const { return own_ != nullptr; }
    const MeshPtr& whole() const;
    operator const MeshPtr&() const { return whole(); }
    const Mesh* get() const { return whole().get(); }
    const Mesh& operator*() const { return *whole(); }
    const Mesh* operator->() const { return whole().get(); }

    const MeshPtr& own() const { return own_; }                                      // without the props
    const std::shared_ptr<const PlacedGeometry>& placed() const { return placed_; }  // null: no props
    // Zero, or nothing, without a mesh.
    std::size_t face_count() const;
    std::size_t triangle_count() const;
    Aabb bounds() const;
    // Of a face below face_count(): its group, which is a prop's name, and its material as its file names it.
    const std::string& group_of(FaceId face) const;
    const std::string& material_of(FaceId face) const;
    bool has_many_groups() const { return placed_ || (own_ && own_->groups.size() > 1); }
    // Of the own faces and of the props' meshes and places.
    std::uint64_t fingerprint() const;
    // Another one for other geometry, as long as this one exists.
    const void* id() const { return placed_ ? static_cast<const void*>(placed_.get()) : own_.get(); }
    friend bool operator==(const LevelMesh& a, const LevelMesh& b) { return a.id() == b.id(); }

  private:
    MeshPtr own_;
    std::shared_ptr<const PlacedGeometry> placed_;
};

}  // namespace slipface
