#include "slipface/exchange/name_materials.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "material_blocks.h"
#include "slipface/base/counted.h"
#include "slipface/base/files.h"
#include "slipface/base/text.h"
#include "slipface/level/material_name.h"
#include "slipface/mesh/formats.h"
#include "slipface/mesh/obj_lines.h"

namespace slipface {
namespace {

namespace fs = std::filesystem;

// The name for faces without a material that follow a face with one.
constexpr const char* unnamed_material = "none";

Level without_paint(const Level& level) {
    Level plain = level;
    plain.overrides.assign(level.mesh.face_count(), std::nullopt);
    for (Prop& prop : plain.props)
        prop.type.clear();
    return plain;
}

// Copies the statements and changes or inserts `usemtl` lines, so that each face has its wanted material.
class Patcher {
  public:
    Patcher(const Level& level, const TypedMaterials& materials, std::string_view text)
        : mesh_(*level.mesh), materials_(materials), text_(text) {}

    Result<NamedObj> run(const std::string& location) {
        std::size_t face = 0;
        for (const ObjStatement& statement : obj_statements(text_)) {
            switch (statement.kind) {
                case ObjStatement::Kind::material:
                    leave_pending();
                    pending_ = statement;
                    authored_ = text_.substr(statement.name_begin, statement.name_end - statement.name_begin);
                    break;
                case ObjStatement::Kind::object:
                    // At a new object Blender resets the material.
                    if (!pending_ && written_ != authored_) written_.reset();
                    break;
                case ObjStatement::Kind::face:
                    if (face == mesh_.face_count() ||
                        statement.corners != mesh_.face_corner_count(static_cast<FaceId>(face)))
                        return Error{location, "contains other faces than before; open it again"};
                    add_face(static_cast<FaceId>(face++), statement);
                    break;
                case ObjStatement::Kind::library: break;
            }
        }
        if (face != mesh_.face_count())
            return Error{location, "contains other faces than before; open it again"};
        leave_pending();
        out_.obj += text_.substr(copied_);
        return std::move(out_);
    }

  private:
    void add_face(FaceId face, const ObjStatement& statement) {
        const std::uint32_t name = materials_.face_name[face];
        const bool typed = materials_.of_type[name].has_value();
        if (typed) ++out_.faces;
        const std::string_view wanted = typed ? std::string_view(materials_.names[name]) : authored_;
        if (pending_ && typed) {
            replace_pending(wanted);
        } else {
            leave_pending();
        }
        if (written_ == wanted) return;
        copy_until(statement.begin);
        out_.obj += "usemtl ";
        out_.obj += wanted.empty() ? std::string_view(unnamed_material) : wanted;
        out_.obj += line_ending_near(text_, statement.begin);
        written_ = std::string(wanted);
    }

    // The file's own `usemtl` stays as it is.
    void leave_pending() {
        if (!pending_) return;
        written_ = std::string(authored_);
        pending_.reset();
    }

    // Changes the file's `usemtl` line itself, because its first face needs another name.
    void replace_pending(std::string_view name) {
        copy_until(pending_->name_begin);
        if (pending_->name_begin == pending_->name_end && !out_.obj.ends_with(' ')) out_.obj += ' ';
        out_.obj += name;
        copied_ = pending_->name_end;
        written_ = std::string(name);
        pending_.reset();
    }

    void copy_until(std::size_t position) {
        out_.obj += text_.substr(copied_, position - copied_);
        copied_ = position;
    }

    const Mesh& mesh_;
    const TypedMaterials& materials_;
    const std::string_view text_;
    std::size_t copied_ = 0;
    std::string_view authored_;                // by the file's last `usemtl`
    std::optional<std::string> written_ = "";  // what a reader of the new text takes for the material
    std::optional<ObjStatement> pending_;      // a `usemtl` without a face so far
    NamedObj out_;
};

// Reads the geometry with its new names, from `obj` or from the file, and clears the paint of faces whose
// material now gives their type.
Result<LoadedLevel> read_named(const Level& level, const std::string* obj) {
    Result<LoadedLevel> loaded = reload_mesh(level, nullptr, obj);
    if (!loaded) return loaded;
    Level& after = loaded->level;
    const ResolvedSurfaces plain = resolve_surfaces(without_paint(after));
    for (std::size_t face = 0; face < own_mesh(after)->face_count(); ++face) {
        if (after.overrides[face] == plain.surface[face]) after.overrides[face].reset();
    }
    return loaded;
}

// The patched files and the level file, all or none.
Status write_named(const std::vector<MaterialPatch>& patches, const Level& after, NamedMaterials& named) {
    const std::string level_text = level_to_json(after);
    std::vector<FileToWrite> files;
    for (const MaterialPatch& patch : patches) {
        named.backups.emplace_back(patch.path) += ".bak";
        named.written.push_back(patch.path);
        files.push_back({named.backups.back(), patch.before});
    }
    for (const MaterialPatch& patch : patches)
        files.push_back({patch.path, patch.after});
    files.push_back({after.file_path, level_text});
    return write_files_atomic(files);
}

}  // namespace

Vec3f tinted(const Vec3f& diffuse, const SurfaceType& type) {
    return 0.5F * (diffuse + Vec3f(type.color[0], type.color[1], type.color[2]));
}

Result<TypedMaterials> typed_materials(const Level& level, bool rules_too) {
    const Mesh& mesh = *level.mesh;
    const ResolvedSurfaces resolved = resolve_surfaces(level);
    const ResolvedSurfaces plain = resolve_surfaces(without_paint(level));
    TypedMaterials result;
    std::map<std::pair<std::uint32_t, int>, std::uint32_t> known;
    result.face_name.reserve(mesh.face_count());
    for (std::size_t face = 0; face < mesh.face_count(); ++face) {
        const std::uint32_t material = mesh.face_material[face];
        const SurfaceId surface = resolved.surface[face];
        const bool by_rule = resolved.source[face] == SurfaceSource::rule;
        const bool typed = surface != plain.surface[face] || (rules_too && by_rule);
        const auto [entry, added] = known.try_emplace({material, typed ? int{surface} : -1},
                                                      static_cast<std::uint32_t>(result.names.size()));
        result.face_name.push_back(entry->second);
        if (!added) continue;
        std::string name = mesh.materials[material].name;
        if (typed) {
            const auto with_type = typed_material(name, surface, level.surfaces);
            if (!with_type)
                return Error{level.file_path.string() + ":/surfaces",
                             fmt::format("the type \"{}\" cannot stand in a material's name; expected a name "
                                         "without an ending like .001",
                                         level.surfaces[surface].name)};
            name = *with_type;
        }
        result.names.push_back(std::move(name));
        result.base.push_back(material);
        result.of_type.push_back(typed ? std::optional(surface) : std::nullopt);
    }
    return result;
}

Result<NamedObj> obj_with_names(const Level& any_level, std::string_view obj) {
    const Level level = without_props(any_level);
    const std::string location = level.mesh_path.string();
    if (file_stamp(obj) != level.mesh_stamp)
        return Error{location, "was changed by another program since it was read; reload it first"};
    Result<TypedMaterials> materials = typed_materials(level, false);
    if (!materials) return materials.error();
    Result<NamedObj> named = Patcher(level, *materials, obj).run(location);
    if (named) named->materials = std::move(*materials);
    return named;
}

Result<NamedMaterials> name_materials(const Level& level) {
    const std::string location = level.mesh_path.string();
    if (to_lower(level.mesh_path.extension().string()) != ".obj")
        return Error{location, "is read only; only OBJ files are written (slipface export writes others)"};
    Result<std::string> bytes = read_file(level.mesh_path, max_geometry_bytes);
    if (!bytes) return bytes.error();
    if (bytes->find('\0') != std::string::npos)
        return Error{location, "is UTF-16 or has zero bytes; only OBJ files in UTF-8 are written"};
    Result<NamedObj> text = obj_with_names(level, *bytes);
    if (!text) return text.error();

    NamedMaterials named;
    named.faces = text->faces;
    if (text->faces > 0) {
        const Result<LoadedLevel> planned = read_named(level, &text->obj);
        if (!planned) return planned.error();
        std::vector<MaterialPatch> patches = patch_libraries(level, *bytes, text->materials);
        patches.push_back({level.mesh_path, std::move(*bytes), std::move(text->obj)});
        if (Status status = write_named(patches, planned->level, named); !status) return status.error();
    }
    Result<LoadedLevel> after = read_named(level, nullptr);
    if (!after) return after.error();
    named.after = std::move(*after);
    return named;
}

std::string NamedMaterials::text() const {
    const std::string name = after.level.mesh_path.filename().string();
    if (faces == 0) return "no face is painted: " + name + " stays as it is";
    return fmt::format("types of {} written into {}; the old file is {}.bak", counted(faces, "face"), name,
                       name);
}

}  // namespace slipface
