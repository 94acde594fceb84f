#include "slipface/mesh/import.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <new>
#include <utility>

#include "assimp/import_scene.h"
#include "assimp/imported_soup.h"
#include "assimp/scene_child.h"
#include "bsp/import_bsp.h"
#include "obj/import_obj.h"
#include "obj/obj_text.h"
#include "slipface/base/files.h"
#include "slipface/base/hash.h"
#include "slipface/base/text.h"
#include "slipface/mesh/build.h"
#include "slipface/mesh/formats.h"
#include "slipface/mesh/rig.h"
#include "warning_list.h"

namespace slipface {
namespace {

// A level file holds positions up to 1e9 m, so what is read can be saved and opened again.
constexpr double largest_position_m = 1e8;

std::string extension_of(const std::filesystem::path& path) {
    std::string extension = to_lower(path.extension().string());
    if (extension.starts_with('.')) extension.erase(0, 1);
    return extension;
}

Result<ImportedSoup> read_soup(const std::filesystem::path& path, std::string bytes, WarningList& warnings,
                               Progress* progress) {
    const std::string extension = extension_of(path);
    if (extension == "obj") {
        auto obj = import_obj(path, std::move(bytes), warnings, progress);
        if (!obj) return obj.error();
        ImportedSoup imported{.soup = std::move(*obj)};
        imported.frame.up_reason = "OBJ files have Y up as a rule";
        imported.frame.scale_reason = "OBJ files have no unit: metres";
        return imported;
    }
    if (bytes.empty()) return Error{path.string(), "is empty"};
    if (extension == "bsp") {
        auto answered = import_scene_in_child(path, bytes, warnings, progress);
        return answered ? std::move(*answered) : import_bsp(bytes, path.string(), warnings, progress);
    }
    return import_scene(path, extension, std::move(bytes), warnings, progress);
}

// Converts the positions to metres and +Y up.
ImportSummary transform(ImportedSoup& imported, const ImportTransform& how) {
    const FileFrame& frame = imported.frame;
    ImportSummary summary{frame.scale,   frame.scale_from, frame.scale_reason, frame.up,
                          frame.up_from, frame.up_reason,  Vec3::Zero()};
    if (how.scale) {
        summary.scale = *how.scale;
        summary.scale_from = ImportSource::given;
    }
    Eigen::Matrix3f upright = frame.upright;
    if (how.up) {
        if (*how.up != frame.up) upright = upright_rotation(*how.up);
        summary.up = *how.up;
        summary.up_from = ImportSource::given;
    }
    const auto scale = static_cast<float>(summary.scale);
    if (!upright.isIdentity(0.0F) || scale != 1.0F) {
        for (std::vector<Vec3f>* positions : {&imported.soup.corner_position, &imported.soup.vertex_position})
            for (Vec3f& p : *positions)
                p = Vec3f(upright * p) * scale;
        Eigen::Matrix4d turn = Eigen::Matrix4d::Identity();
        turn.topLeftCorner<3, 3>() = upright.cast<double>() * static_cast<double>(scale);
        const Eigen::Matrix4d back = turn.inverse();
        for (MeshNode& node : imported.soup.nodes)
            node.world = (turn * node.world.cast<double>() * back).cast<float>();
        if (imported.soup.rig) imported.soup.rig->level_from_file.leftCols<3>() = upright * scale;
    }
    const Eigen::Matrix3d rotation = upright.cast<double>();
    const Eigen::Matrix3d turned = rotation * upright_rotation(frame.up).cast<double>().transpose();
    for (FoundSpawn& spawn : imported.spawns) {
        spawn.feet = rotation * spawn.feet * summary.scale;
        const Vec3 ahead = turned * Vec3(-std::sin(spawn.yaw), 0, -std::cos(spawn.yaw));
        if (!turned.isIdentity(0.0)) spawn.yaw = std::atan2(-ahead.x(), -ahead.z());
    }
    return summary;
}

// Reads the corners of every face backwards, from the same first one.
void flip_faces(PolygonSoup& soup) {
    const auto turn = [&](auto& corners) {
        for (std::size_t face = 0; !corners.empty() && face + 1 < soup.face_first_corner.size(); ++face)
            std::reverse(corners.begin() + soup.face_first_corner[face] + 1,
                         corners.begin() + soup.face_first_corner[face + 1]);
    };
    turn(soup.corner_position);
    turn(soup.corner_vertex);
    turn(soup.corner_uv);
}

Status check_transform(const std::filesystem::path& path, const ImportTransform& how) {
    if (!how.scale || (*how.scale >= smallest_import_scale && *how.scale <= largest_import_scale)) return {};
    return Error{path.string(), fmt::format("a scale of {} is out of range; expected {} to {}", *how.scale,
                                            smallest_import_scale, largest_import_scale)};
}

Result<ImportedMesh> read_mesh(const std::filesystem::path& path, const ImportOptions& options) {
    if (mesh_format_of(path) == nullptr) {
        if (extension_of(path) == "blend")
            return Error{path.string(),
                         "only Blender reads its own files; export it from there as glTF or OBJ"};
        return Error{path.string(), fmt::format("is no level; found the ending {}, expected a file named {}",
                                                in_quotes(extension_of(path)), mesh_formats_text())};
    }
    if (auto status = check_transform(path, options.transform); !status) return status.error();
    begin_stage(options.progress, "Reading the file", 0.0, 0.1);
    auto bytes = options.content != nullptr ? Result<std::string>(*options.content)
                                            : read_file(path, max_geometry_bytes);
    if (!bytes) return bytes.error();
    ImportedMesh imported;
    imported.stamp = file_stamp(*bytes);

    WarningList warnings(options.max_warnings);
    begin_stage(options.progress, "Reading faces", 0.1, 0.8);
    auto read = read_soup(path, std::move(*bytes), warnings, options.progress);
    if (!read) return read.error();
    begin_stage(options.progress, "Cutting faces into triangles", 0.8, 1.0);
    imported.summary = transform(*read, options.transform);
    if (options.transform.flip) flip_faces(read->soup);
    auto mesh = build_mesh(std::move(read->soup));
    if (!mesh) return Error{path.string(), mesh.error().message};
    if (cancelled(options.progress)) return cancelled_error(path);
    const Aabb& bounds = (*mesh)->bounds;
    const double reach = std::max(bounds.min.cwiseAbs().maxCoeff(), bounds.max.cwiseAbs().maxCoeff());
    if (reach > largest_position_m)
        return Error{
            path.string(),
            fmt::format("lies up to {:.3g} m from the origin with {} m per unit; expected at most {:g} m",
                        reach, imported.summary.scale, largest_position_m)};
    imported.mesh = std::move(*mesh);
    imported.summary.size = imported.mesh->bounds.size();
    imported.spawns = std::move(read->spawns);
    imported.types = std::move(read->types);
    imported.type_table = std::move(read->type_table);
    imported.undrawn = std::move(read->undrawn);
    imported.warnings = warnings.take(path.string());
    return imported;
}

}  // namespace

FileStamp file_stamp(std::string_view bytes) {
    return {.size = bytes.size(), .hash = hash_blocks(bytes.data(), bytes.size())};
}

Result<ImportedMesh> import_mesh(const std::filesystem::path& path, const ImportOptions& options) {
    try {
        return read_mesh(path, options);
    } catch (const std::bad_alloc&) {
        return Error{path.string(), "needs more memory than there is"};
    } catch (const std::exception& exception) {
        return Error{path.string(), exception.what()};
    }
}

Result<ImportedMesh> import_mesh(const std::filesystem::path& path, std::size_t max_warnings) {
    ImportOptions options;
    options.max_warnings = max_warnings;
    return import_mesh(path, options);
}

}  // namespace slipface
