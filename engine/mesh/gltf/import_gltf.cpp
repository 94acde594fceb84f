// Source: glTF 2.0, and the extension EXT_mesh_gpu_instancing.
#include "gltf/import_gltf.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "gltf/gltf_clips.h"
#include "gltf/gltf_materials.h"
#include "gltf/gltf_primitives.h"
#include "gltf/gltf_scene.h"
#include "material_names.h"
#include "rig_corners.h"
#include "scene_nodes.h"
#include "slipface/base/counted.h"

namespace slipface {
namespace {

constexpr std::size_t max_faces = std::size_t{1} << 26;
constexpr double largest_coordinate = 1e7;  // metres

constexpr std::string_view table_key = "slipface_types";  // of the scene
constexpr std::string_view part_key = "slipface_part";    // of a node

// A matrix that moves vertices: that of a node, or of a joint.
struct Mover {
    GltfMatrix matrix;
    std::uint32_t node = 0;
    GltfMatrix bind = GltfMatrix::Identity();  // matrix = world of the node * bind
};

class GltfReader {
  public:
    GltfReader(GltfFile& file, WarningList& warnings, Progress* progress)
        : file_(file),
          warnings_(warnings),
          progress_(progress),
          materials_(gltf_materials(file, warnings)),
          nodes_(gltf_nodes(file)),
          index_of_(file.root()["nodes"].size(), no_id) {
        for (std::uint32_t i = 0; i < nodes_.size(); ++i)
            index_of_[nodes_[i].number] = i;
    }

    PolygonSoup run() {
        for (const GltfMaterial& material : materials_)
            soup_.materials.push_back(material.material);
        soup_.face_first_corner.push_back(0);
        read_rig();
        std::vector<std::uint32_t> object_of(nodes_.size(), no_id);
        for (std::uint32_t i = 0; i < nodes_.size() && !cancelled(progress_); ++i) {
            advance(progress_, static_cast<double>(i) / static_cast<double>(nodes_.size()));
            const std::uint32_t parent = nodes_[i].parent == no_id ? no_id : object_of[nodes_[i].parent];
            object_of[i] = add_node(i, parent);
        }
        if (soup_.face_material.empty() && !cancelled(progress_))
            throw GltfRefused({file_.location(), "has no faces"});
        if (dropped_ > 0)
            warnings_.add(
                file_.location(),
                fmt::format("dropped {} of {}", counted(dropped_, "point or line", "points and lines"),
                            counted(meshes_with_dropped_, "mesh", "meshes")));
        drop_empty_nodes(soup_, shapes_);
        soup_.other_files = file_.other_files;
        soup_.rig = rig_.take();
        return std::move(soup_);
    }

  private:
    GltfValue value_of(std::uint32_t node) const { return file_.root()["nodes"].at(nodes_[node].number); }

    void read_rig() {
        Rig rig;
        for (std::uint32_t i = 0; i < nodes_.size(); ++i) {
            const GltfSceneNode& from = nodes_[i];
            RigNode& node = rig.nodes.emplace_back();
            node.parent = from.parent;
            node.translation = from.translation.cast<float>();
            const Eigen::Vector4f turn = from.rotation.coeffs().cast<float>();
            node.rotation = {turn[0], turn[1], turn[2], turn[3]};
            node.scale = from.scale.cast<float>();
            node.local = from.local.topRows<3>().cast<float>();
            node.first_weight = static_cast<std::uint32_t>(rig.weights.size());
            const std::vector<float> weights = weights_of(i);
            node.weights = static_cast<std::uint32_t>(weights.size());
            rig.weights.insert(rig.weights.end(), weights.begin(), weights.end());
        }
        weights_ = rig.weights;
        for (const RigNode& node : rig.nodes)
            first_weight_.push_back(node.first_weight);
        rig.clips = gltf_clips(file_, rig, index_of_);
        if (!rig.clips.empty()) rig_ = RigCorners(std::move(rig));
    }

    // Those of the morph targets of the node's mesh.
    std::vector<float> weights_of(std::uint32_t node) const {
        const GltfValue reference = value_of(node)["mesh"];
        if (!reference) return {};
        const GltfValue mesh = file_.element("meshes", reference), primitives = mesh["primitives"];
        std::size_t targets = 0;
        for (std::size_t i = 0; i < primitives.size(); ++i)
            targets = std::max(targets, primitives.at(i)["targets"].size());
        std::vector<float> weights(targets, 0.0F);
        const GltfValue own = value_of(node)["weights"], usual = mesh["weights"];
        const GltfValue given = own ? own : usual;
        for (std::size_t i = 0; i < std::min(targets, given.size()); ++i)
            weights[i] = static_cast<float>(given.at(i).number());
        return weights;
    }

    // The object that its faces belong to; for a node without any, that which its children belong to.
    std::uint32_t add_node(std::uint32_t node, std::uint32_t parent) {
        const GltfValue from = value_of(node);
        const GltfValue mesh = from["mesh"];
        const GltfValue part = from["extras"][part_key];
        // A part of its parent, which export_level() wrote apart because it has a surface type of its own.
        const bool is_part = parent != no_id && part.is_truth() && part.truth(false) &&
                             nodes_[node].local == GltfMatrix::Identity();
        if (is_part) {
            if (mesh) add_mesh(node, parent, nodes_[node].world, GltfMatrix::Identity());
            return parent;
        }
        std::string name = from["name"].text("");
        if (name.empty() && mesh) name = file_.element("meshes", mesh)["name"].text("");
        if (name.empty()) name = fmt::format("node {}", nodes_[node].number);
        const GltfValue copies = from.extension("EXT_mesh_gpu_instancing")["attributes"];
        const std::uint32_t object = add_object(name, parent, nodes_[node].world);
        if (!mesh) return object;
        if (!copies) {
            add_mesh(node, object, nodes_[node].world, GltfMatrix::Identity());
            return object;
        }
        const std::vector<GltfMatrix> places = places_of(copies);
        for (std::size_t i = 0; i < places.size(); ++i) {
            const GltfMatrix world = nodes_[node].world * places[i];
            add_mesh(node, add_object(fmt::format("{} {}", name, i + 1), object, world), world, places[i]);
        }
        return object;
    }

    std::uint32_t add_object(const std::string& name, std::uint32_t parent, const GltfMatrix& world) {
        soup_.nodes.push_back({.name = name, .parent = parent, .world = world.cast<float>()});
        return static_cast<std::uint32_t>(soup_.nodes.size() - 1);
    }

    std::vector<GltfMatrix> places_of(const GltfValue& attributes) {
        GltfNumbers translations, rotations, scales;
        if (attributes["TRANSLATION"]) translations = file_.numbers(attributes["TRANSLATION"], 3);
        if (attributes["ROTATION"]) rotations = file_.numbers(attributes["ROTATION"], 4);
        if (attributes["SCALE"]) scales = file_.numbers(attributes["SCALE"], 3);
        const std::size_t count = std::max({translations.count, rotations.count, scales.count});
        for (const GltfNumbers* numbers : {&translations, &rotations, &scales})
            if (numbers->count != 0 && numbers->count != count)
                attributes.refuse(
                    fmt::format("has {} and {} instances; expected as many", numbers->count, count));
        std::vector<GltfMatrix> places;
        for (std::size_t i = 0; i < count; ++i) {
            const auto vector = [&](const GltfNumbers& from, double otherwise) -> Eigen::Vector3d {
                if (from.count == 0) return Eigen::Vector3d::Constant(otherwise);
                return Eigen::Map<const Vec3f>(from.at(i)).cast<double>();
            };
            Eigen::Quaterniond turn = Eigen::Quaterniond::Identity();
            if (rotations.count > 0) {
                const float* const q = rotations.at(i);
                turn = Eigen::Quaterniond(q[3], q[0], q[1], q[2]);
                turn = turn.norm() > 1e-6 ? turn.normalized() : Eigen::Quaterniond::Identity();
            }
            places.push_back(gltf_matrix(vector(translations, 0.0), turn, vector(scales, 1.0)));
        }
        return places;
    }

    // The joints of the node's skin, which move its vertices instead of its own place; else the node.
    std::vector<Mover> movers_of(std::uint32_t node, const GltfMatrix& world, const GltfMatrix& place) {
        const GltfValue reference = value_of(node)["skin"];
        if (!reference) return {{world, node, place}};
        const GltfValue skin = file_.element("skins", reference), joints = skin["joints"];
        GltfNumbers binds;
        if (skin["inverseBindMatrices"]) binds = file_.numbers(skin["inverseBindMatrices"], 16);
        if (binds.components != 0 && binds.count < joints.size())
            skin["inverseBindMatrices"].refuse(
                fmt::format("has {} matrices; expected {}, one for each joint", binds.count, joints.size()));
        std::vector<Mover> movers;
        for (std::size_t i = 0; i < joints.size(); ++i) {
            file_.element("nodes", joints.at(i));
            const std::uint32_t joint = index_of_[joints.at(i).whole()];
            if (joint == no_id) joints.at(i).refuse("the joint is not in the scene");
            GltfMatrix bind = GltfMatrix::Identity();
            if (binds.count > 0) bind = Eigen::Map<const Eigen::Matrix4f>(binds.at(i)).cast<double>();
            movers.push_back({nodes_[joint].world * bind, joint, bind});
        }
        if (movers.empty()) joints.refuse("a skin without joints");
        return movers;
    }

    void add_mesh(std::uint32_t node, std::uint32_t number, const GltfMatrix& world,
                  const GltfMatrix& place) {
        MeshNode& object = soup_.nodes[number];
        if (object.group == no_id) {
            object.group = static_cast<std::uint32_t>(soup_.groups.size());
            soup_.groups.push_back(object.name);
        }
        const GltfValue reference = value_of(node)["mesh"];
        const GltfValue mesh = file_.element("meshes", reference), primitives = mesh["primitives"];
        std::vector<std::size_t>& shape = shapes_[number];
        shape.push_back(reference.whole());
        const bool skinned = static_cast<bool>(value_of(node)["skin"]);
        if (skinned) shape.push_back(nodes_[node].number);  // bent, and no copy of another
        const std::vector<Mover> movers = movers_of(node, world, place);
        const std::size_t dropped_before = dropped_;
        for (std::size_t i = 0; i < primitives.size(); ++i)
            add_primitive(primitives.at(i), read_primitive(reference.whole(), i, primitives.at(i)), node,
                          object.group, movers, skinned);
        if (dropped_ > dropped_before) ++meshes_with_dropped_;
    }

    std::uint32_t material_of(const GltfValue& primitive) const {
        const GltfValue material = primitive["material"];
        if (!material) return static_cast<std::uint32_t>(materials_.size() - 1);
        file_.element("materials", material);
        return static_cast<std::uint32_t>(material.whole());
    }

    // Those of one mesh that stands in many places are read once.
    const GltfPrimitive& read_primitive(std::size_t mesh, std::size_t number, const GltfValue& primitive) {
        if (mesh != read_mesh_) read_.clear();
        read_mesh_ = mesh;
        const auto known = read_.find(number);
        if (known != read_.end()) return known->second;
        return read_
            .emplace(number, gltf_primitive(file_, primitive, materials_[material_of(primitive)].uv_set))
            .first->second;
    }

    void add_primitive(const GltfValue& primitive, const GltfPrimitive& from, std::uint32_t node,
                       std::uint32_t group, const std::vector<Mover>& movers, bool skinned) {
        dropped_ += from.dropped;
        if (soup_.face_material.size() + from.corners.size() / 3 > max_faces)
            throw GltfRefused({file_.location(), fmt::format("has more than {} faces", max_faces)});
        const std::uint32_t material = material_of(primitive);
        // A mirroring transformation reverses the winding; reading the triangle backwards preserves its
        // front.
        const bool mirrored = movers[0].matrix.topLeftCorner<3, 3>().determinant() < 0.0;
        const std::vector<Vec3f> placed = placed_vertices(primitive, from, node, movers, skinned);
        for (std::size_t i = 0; i < from.corners.size(); ++i) {
            const std::uint32_t vertex = from.corners[mirrored ? i / 3 * 3 + 2 - i % 3 : i];
            soup_.corner_position.push_back(placed[vertex]);
            Vec2f uv = Vec2f::Zero();
            if (!from.uv.empty()) {
                const Vec3f at(from.uv[vertex].x(), from.uv[vertex].y(), 1.0F);
                uv = materials_[material].uv_transform * at;
            }
            soup_.corner_uv.push_back(uv.allFinite() ? uv : Vec2f(0, 0));
            if (rig_) add_to_rig(from, vertex, node, movers, skinned);
            if (i % 3 != 2) continue;
            soup_.face_first_corner.push_back(static_cast<std::uint32_t>(soup_.corner_position.size()));
            soup_.face_material.push_back(material);
            soup_.face_group.push_back(group);
        }
    }

    // In the file's space, with the morph targets' default weights and the joints' pose.
    std::vector<Vec3f> placed_vertices(const GltfValue& primitive, const GltfPrimitive& from,
                                       std::uint32_t node, const std::vector<Mover>& movers,
                                       bool skinned) const {
        std::vector<Vec3f> placed(from.positions.size());
        for (std::size_t vertex = 0; vertex < placed.size(); ++vertex) {
            Eigen::Vector4d own = from.positions[vertex].cast<double>().homogeneous();
            for (std::size_t i = 0; i < from.targets.size(); ++i)
                if (!from.targets[i].empty())
                    own.head<3>() += static_cast<double>(weights_[first_weight_[node] + i]) *
                                     from.targets[i][vertex].cast<double>();
            Eigen::Vector3d at = Eigen::Vector3d::Zero();
            double sum = 0.0;
            for (std::size_t i = vertex * from.influences; skinned && i < (vertex + 1) * from.influences;
                 ++i) {
                const auto weight = static_cast<double>(from.weights[i]);
                if (!(weight > 0.0)) continue;
                if (from.joints[i] >= movers.size())
                    primitive.refuse(fmt::format("joint {} of vertex {} is out of range; the skin has {}",
                                                 from.joints[i], vertex, movers.size()));
                at += weight * (movers[from.joints[i]].matrix * own).head<3>();
                sum += weight;
            }
            // Weights of full sum are meant; a vertex without any follows the first joint, or its node.
            at = sum > 0.0 ? (at / sum).eval() : (movers[0].matrix * own).head<3>().eval();
            if (!(at.cwiseAbs().maxCoeff() <= largest_coordinate))
                primitive["attributes"]["POSITION"].refuse(
                    fmt::format("vertex {} is not within {} m of the origin", vertex, largest_coordinate));
            placed[vertex] = at.cast<float>();
        }
        return placed;
    }

    void add_to_rig(const GltfPrimitive& from, std::uint32_t vertex, std::uint32_t node,
                    const std::vector<Mover>& movers, bool skinned) {
        const auto bone = [&](const Mover& mover) {
            return rig_.bone(mover.node, mover.bind.topRows<3>().cast<float>());
        };
        rig_.begin_corner(from.positions[vertex]);
        for (std::size_t i = vertex * from.influences; skinned && i < (vertex + 1) * from.influences; ++i)
            if (from.weights[i] > 0.0F) rig_.follow(bone(movers[from.joints[i]]), from.weights[i]);
        for (std::size_t i = 0; i < from.targets.size(); ++i)
            if (!from.targets[i].empty())
                rig_.morph(first_weight_[node] + static_cast<std::uint32_t>(i), from.targets[i][vertex]);
        rig_.end_corner(bone(movers[0]));
    }

    GltfFile& file_;
    WarningList& warnings_;
    Progress* progress_;
    const std::vector<GltfMaterial> materials_;
    const std::vector<GltfSceneNode> nodes_;
    std::vector<std::uint32_t> index_of_;      // [node of the file] in nodes_
    std::vector<float> weights_;               // of morph targets
    std::vector<std::uint32_t> first_weight_;  // [node]
    RigCorners rig_;                           // empty if the file has no clips
    PolygonSoup soup_;
    NodeShapes shapes_;
    std::size_t read_mesh_ = static_cast<std::size_t>(-1);
    std::map<std::size_t, GltfPrimitive> read_;          // those of read_mesh_
    std::size_t dropped_ = 0, meshes_with_dropped_ = 0;  // points and lines
};

}  // namespace

Result<ImportedSoup> import_gltf(const std::filesystem::path& path, std::string bytes, WarningList& warnings,
                                 Progress* progress, bool* too_old) {
    try {
        GltfFile file(path, std::move(bytes));
        ImportedSoup imported{.soup = GltfReader(file, warnings, progress).run()};
        if (cancelled(progress)) return cancelled_error(path);
        imported.frame = frame_of(1.0, ImportSource::declared, "glTF is in metres", UpAxis::y,
                                  ImportSource::declared, "glTF has Y up");
        imported.type_table = gltf_scene_extras(file)[table_key].json();
        name_materials(imported.soup);
        return imported;
    } catch (const GltfTooOld& refused) {
        if (too_old != nullptr) *too_old = true;
        return refused.error;
    } catch (const GltfRefused& refused) {
        return refused.error;
    }
}

}  // namespace slipface
