#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <limits>
#include <map>
#include <unordered_map>

#include "export_parts.h"
#include "gltf/buffer.h"
#include "gltf/materials.h"
#include "gltf/objects.h"
#include "gltf/physics.h"
#include "slipface/base/hash.h"
#include "slipface/base/text.h"

namespace slipface {
namespace {

namespace fs = std::filesystem;

// A material with a texture needs texture positions, be they all zero.
bool has_textures(const Mesh& mesh) {
    return std::any_of(mesh.materials.begin(), mesh.materials.end(),
                       [](const Material& material) { return !material.texture.empty(); });
}

// The faces of an object in the order of its meshes, with their corners in the object's own coordinates.
struct ObjectFaces {
    std::vector<FaceId> faces;           // by type, then by material
    std::vector<std::uint32_t> corners;  // of these faces; in a mirrored object backwards, as its mesh is
    std::vector<Vec3f> positions;        // [corner of these faces]
    bool mirrored = false;
};

// Meshes of one surface type each: engines make one body of each.
struct TypedMesh {
    SurfaceId surface = default_surface;
    std::size_t mesh = 0;  // index in the file
};

using Corner = std::array<std::uint32_t, 3>;  // vertex, and the bits of U and V
struct CornerHash {
    std::size_t operator()(const Corner& corner) const {
        Hasher hasher;
        for (const std::uint32_t part : corner)
            hasher.u64(part);
        return static_cast<std::size_t>(hasher.value());
    }
};

struct SharedMeshes {
    ObjectFaces from;
    std::vector<TypedMesh> meshes;
};

// Builds the scene's JSON and its binary buffer.
class GltfWriter {
  public:
    GltfWriter(const Level& level, const TypedMaterials& materials)
        : level_(level),
          mesh_(*level.mesh),
          materials_(materials),
          surface_(resolve_surfaces(level).surface),
          textured_(textured(mesh_) || has_textures(mesh_)),
          physics_(level.surfaces) {}

    void write(std::span<const GltfNode> nodes) {
        const std::vector<GltfObject> objects = gltf_objects(level_);
        std::vector<std::vector<FaceId>> faces(mesh_.groups.size());
        for (FaceId face = 0; face < mesh_.face_count(); ++face)
            faces[mesh_.face_group[face]].push_back(face);
        for (const GltfObject& object : objects) {
            add_object(object);
            ++copies_[object.shape];
        }
        for (std::size_t i = 0; i < objects.size(); ++i)
            if (objects[i].group != no_id) fill_object(i, objects[i], std::move(faces[objects[i].group]));
        for (const GltfNode& node : nodes)
            add_node(node);
        root_["asset"] = {{"version", "2.0"}, {"generator", "Slipface"}};
        root_["scene"] = 0;
        root_["scenes"] = {{{"nodes", roots_}, {"extras", {{"slipface_types", types_json()}}}}};
        for (std::size_t i = 0; i < nodes_.size(); ++i)
            if (!children_[i].empty()) nodes_[i]["children"] = children_[i];
        root_["nodes"] = std::move(nodes_);
        root_["meshes"] = std::move(meshes_);
        physics_.append_to(root_);
    }

    GltfJson root_ = GltfJson::object();
    GltfBuffer buffer_;

  private:
    // The types as a level file has them, so that reading the exported file gives them again.
    GltfJson types_json() const {
        Level bare;
        bare.surfaces = level_.surfaces;
        return GltfJson::parse(level_to_json(bare))["surfaces"];
    }

    std::size_t append_node(GltfJson node, std::size_t parent) {
        nodes_.push_back(std::move(node));
        children_.push_back(GltfJson::array());
        (parent == no_parent ? roots_ : children_[parent]).push_back(nodes_.size() - 1);
        return nodes_.size() - 1;
    }

    // Before the objects below it, so that a reader meets the faces in the same order again.
    std::size_t append_part(GltfJson node, std::size_t parent, std::ptrdiff_t place) {
        nodes_.push_back(std::move(node));
        children_.push_back(GltfJson::array());
        children_[parent].insert(children_[parent].begin() + place, nodes_.size() - 1);
        return nodes_.size() - 1;
    }

    void add_object(const GltfObject& object) {
        GltfJson node{{"name", object.name}};
        const Vec3f &at = object.translation, &scale = object.scale;
        const Eigen::Quaternionf& turn = object.rotation;
        if (!at.isZero(0.0F)) node["translation"] = {at.x(), at.y(), at.z()};
        if (!turn.vec().isZero(0.0F)) node["rotation"] = {turn.x(), turn.y(), turn.z(), turn.w()};
        if (scale != Vec3f::Ones()) node["scale"] = {scale.x(), scale.y(), scale.z()};
        append_node(std::move(node), object.parent == no_id ? no_parent : object.parent);
    }

    void add_node(const GltfNode& node) {
        const Vec3& at = node.position;
        append_node({{"name", node.name},
                     {"translation", {at.x(), at.y(), at.z()}},
                     {"extras", GltfJson::parse(node.extras, nullptr, false)}},
                    no_parent);
    }

    // An object of one type and without children has its mesh itself; another gets a node for each type.
    void fill_object(std::size_t node, const GltfObject& object, std::vector<FaceId> faces) {
        if (faces.empty()) return;
        const std::vector<TypedMesh> meshes = meshes_of(object, std::move(faces));
        const bool in_parts = meshes.size() > 1 || object.has_children;
        std::ptrdiff_t part = 0;
        for (const TypedMesh& one : meshes) {
            const SurfaceType& type = level_.surfaces[one.surface];
            std::size_t holder = node;
            if (in_parts) {
                const GltfJson extras{{"slipface_part", true}, {"slipface_type", type.name}};
                holder =
                    append_part({{"name", object.name + " " + type.name}, {"extras", extras}}, node, part++);
            } else {
                nodes_[node]["extras"] = {{"slipface_type", type.name}};
            }
            nodes_[holder]["mesh"] = one.mesh;
            if (!type.solid) continue;
            const std::string name = nodes_[holder]["name"].get<std::string>() + " collider";
            append_node(physics_.collider(name, one.surface, one.mesh, holder), holder);
        }
    }

    // Copies of one object with the same types share their meshes.
    std::vector<TypedMesh> meshes_of(const GltfObject& object, std::vector<FaceId> list) {
        ObjectFaces faces = own_faces(object, std::move(list));
        if (object.shape == no_id || copies_[object.shape] < 2) return make_meshes(object.name, faces);
        std::vector<SharedMeshes>& known = shared_[object.shape];
        for (const SharedMeshes& other : known)
            if (same(other.from, faces)) return other.meshes;
        std::vector<TypedMesh> made = make_meshes(object.name, faces);
        known.push_back({std::move(faces), made});
        return made;
    }

    ObjectFaces own_faces(const GltfObject& object, std::vector<FaceId> list) const {
        const auto key = [&](FaceId face) { return std::pair(surface_[face], materials_.face_name[face]); };
        std::stable_sort(list.begin(), list.end(), [&](FaceId a, FaceId b) { return key(a) < key(b); });
        const bool stays = object.world.isIdentity(0.0);
        const Eigen::Matrix4d to_own = object.world.inverse();
        ObjectFaces own;
        own.faces = std::move(list);
        own.mirrored = object.world.determinant() < 0.0;
        for (const FaceId face : own.faces) {
            const std::uint32_t first = mesh_.face_first_corner[face];
            const std::uint32_t count = mesh_.face_corner_count(face);
            for (std::uint32_t k = 0; k < count; ++k) {
                const std::uint32_t corner = first + (own.mirrored ? count - 1 - k : k);
                if (object.rest) {
                    const Mesh& rest = *object.rest;
                    own.corners.push_back(corner);
                    own.positions.push_back(
                        rest.corner_position(rest.face_first_corner[face - object.first_face] + k));
                    continue;
                }
                const Vec3f world = mesh_.corner_position(corner);
                const Vec3 local = (to_own * world.cast<double>().homogeneous()).head<3>();
                own.corners.push_back(corner);
                own.positions.push_back(stays ? world : Vec3f(local.cast<float>()));
            }
        }
        return own;
    }

    bool same(const ObjectFaces& a, const ObjectFaces& b) const {
        if (a.faces.size() != b.faces.size() || a.positions.size() != b.positions.size()) return false;
        for (std::size_t i = 0; i < a.faces.size(); ++i) {
            const FaceId one = a.faces[i], two = b.faces[i];
            if (materials_.face_name[one] != materials_.face_name[two] || surface_[one] != surface_[two] ||
                mesh_.face_corner_count(one) != mesh_.face_corner_count(two))
                return false;
        }
        for (std::size_t i = 0; i < a.corners.size(); ++i)
            if (mesh_.corner_uv[a.corners[i]] != mesh_.corner_uv[b.corners[i]]) return false;
        // The positions went through the objects' transformations and back, in float.
        constexpr float rounding = 2e-5F;
        float largest = 1.0F;
        for (const Vec3f& position : a.positions)
            largest = std::max(largest, position.cwiseAbs().maxCoeff());
        for (std::size_t i = 0; i < a.positions.size(); ++i)
            if (!((a.positions[i] - b.positions[i]).cwiseAbs().maxCoeff() <= rounding * largest))
                return false;
        return true;
    }

    std::vector<TypedMesh> make_meshes(const std::string& name, const ObjectFaces& faces) {
        std::vector<TypedMesh> made;
        std::size_t corner = 0;
        for (std::size_t begin = 0; begin < faces.faces.size();) {
            const SurfaceId surface = surface_[faces.faces[begin]];
            std::size_t end = begin;
            while (end < faces.faces.size() && surface_[faces.faces[end]] == surface)
                ++end;
            std::size_t corners = 0;
            for (std::size_t i = begin; i < end; ++i)
                corners += mesh_.face_corner_count(faces.faces[i]);
            made.push_back({surface, meshes_.size()});
            add_mesh(name, faces, std::span(faces.faces).subspan(begin, end - begin), corner);
            corner += corners;
            begin = end;
        }
        return made;
    }

    // One primitive for each material, all with the same vertices.
    void add_mesh(const std::string& name, const ObjectFaces& object, std::span<const FaceId> faces,
                  std::size_t corner) {
        std::vector<Vec3f> vertices;
        std::vector<Vec2f> uvs;
        std::vector<std::uint32_t> vertex;  // [corner]
        std::unordered_map<Corner, std::uint32_t, CornerHash> known;
        std::vector<std::uint32_t> indices;
        struct Range {
            std::uint32_t material;
            std::size_t first;
        };
        std::vector<Range> ranges;
        for (const FaceId face : faces) {
            const std::uint32_t first = mesh_.face_first_corner[face];
            vertex.resize(mesh_.face_corner_count(face));
            for (std::size_t k = 0; k < vertex.size(); ++k, ++corner) {
                const std::uint32_t at = object.corners[corner];
                const Vec2f& uv = mesh_.corner_uv[at];
                const auto [entry, added] =
                    known.try_emplace({mesh_.corner_vertex[at], std::bit_cast<std::uint32_t>(uv.x()),
                                       std::bit_cast<std::uint32_t>(uv.y())},
                                      static_cast<std::uint32_t>(vertices.size()));
                if (added) {
                    vertices.push_back(object.positions[corner]);
                    uvs.push_back(uv);
                }
                vertex[at - first] = entry->second;
            }
            const std::uint32_t material = materials_.face_name[face];
            if (ranges.empty() || ranges.back().material != material)
                ranges.push_back({material, indices.size()});
            for (std::uint32_t t = mesh_.face_first_triangle[face]; t < mesh_.face_first_triangle[face + 1];
                 ++t)
                for (std::size_t side = 0; side < 3; ++side)
                    indices.push_back(vertex[mesh_.triangles[t][object.mirrored ? 2 - side : side] - first]);
        }
        GltfJson attributes{{"POSITION", buffer_.positions(vertices)}};
        if (textured_) attributes["TEXCOORD_0"] = buffer_.uvs(uvs);
        const std::size_t view = buffer_.index_view(indices);
        const std::string& type = level_.surfaces[surface_[faces.front()]].name;
        GltfJson primitives = GltfJson::array();
        for (std::size_t i = 0; i < ranges.size(); ++i) {
            const std::size_t end = i + 1 < ranges.size() ? ranges[i + 1].first : indices.size();
            primitives.push_back({{"attributes", attributes},
                                  {"indices", buffer_.indices(view, ranges[i].first, end - ranges[i].first)},
                                  {"material", ranges[i].material},
                                  {"extras", {{"slipface_type", type}}}});
        }
        meshes_.push_back({{"name", name}, {"primitives", std::move(primitives)}});
    }

    static constexpr std::size_t no_parent = std::numeric_limits<std::size_t>::max();

    const Level& level_;
    const Mesh& mesh_;
    const TypedMaterials& materials_;
    const std::vector<SurfaceId> surface_;
    const bool textured_;
    GltfPhysics physics_;
    std::map<std::uint32_t, std::vector<SharedMeshes>> shared_;  // by shape
    std::map<std::uint32_t, std::size_t> copies_;                // likewise: how many objects
    GltfJson nodes_ = GltfJson::array(), meshes_ = GltfJson::array(), roots_ = GltfJson::array();
    std::vector<GltfJson> children_;  // [node]
};

std::string json_text(const GltfJson& root) {
    return root.dump(-1, ' ', false, GltfJson::error_handler_t::replace);
}

std::string u32_text(std::size_t value) {
    std::string text;
    for (int i = 0; i < 4; ++i)
        text.push_back(static_cast<char>(value >> (8 * i)));
    return text;
}

// Header, JSON chunk, binary chunk.
Result<std::string> glb_bytes(const GltfJson& root, const std::string& binary, const fs::path& path) {
    std::string json = json_text(root);
    json.resize((json.size() + 3) / 4 * 4, ' ');
    const std::size_t size = 12 + 8 + json.size() + 8 + binary.size();
    if (size > std::numeric_limits<std::uint32_t>::max())
        return Error{path.string(), fmt::format("would be {} bytes long, but a .glb has at most 4 GiB; "
                                                "expected a name that ends in .gltf",
                                                size)};
    return "glTF" + u32_text(2) + u32_text(size) + u32_text(json.size()) + "JSON" + json +
           u32_text(binary.size()) + std::string("BIN\0", 4) + binary;
}

}  // namespace

Result<std::vector<ExportedFile>> gltf_files(const Level& level, const fs::path& path,
                                             std::span<const GltfNode> nodes) {
    const Result<TypedMaterials> materials = typed_materials(level, true);
    if (!materials) return materials.error();
    const bool one_file = to_lower(path.extension().string()) == ".glb";
    GltfWriter writer(level, *materials);
    writer.write(nodes);
    std::vector<ExportedFile> files =
        add_gltf_materials(level, *materials, path, one_file, writer.buffer_, writer.root_);
    fs::path binary = path;
    binary.replace_extension(".bin");
    writer.buffer_.append_to(writer.root_, one_file ? std::string() : uri_text(binary.filename()));
    if (one_file) {
        Result<std::string> bytes = glb_bytes(writer.root_, writer.buffer_.bytes(), path);
        if (!bytes) return bytes.error();
        files.push_back({path, std::move(*bytes)});
        return files;
    }
    files.push_back({binary, writer.buffer_.take()});
    files.push_back({path, json_text(writer.root_) + "\n"});
    return files;
}

}  // namespace slipface
