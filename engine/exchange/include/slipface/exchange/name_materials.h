// Writes painted types into the material names of the OBJ file. Modelling tools preserve these names, and new
// faces inherit them.
#pragma once

#include "slipface/level/level_file.h"

namespace slipface {

// The material name of each face. It contains the face's type if the material alone would not give that type.
struct TypedMaterials {
    std::vector<std::uint32_t> face_name;  // [face] index into `names`
    std::vector<std::string> names;
    std::vector<std::uint32_t> base;                // [name] material of the mesh
    std::vector<std::optional<SurfaceId>> of_type;  // [name] the type that was added; empty: none
};
// With `rules_too`, types that only the level's rules give are added too, for programs without the rules.
// Error: a type's name that cannot be part of a material's name.
Result<TypedMaterials> typed_materials(const Level& level, bool rules_too);

struct NamedObj {
    std::string obj;        // the file's new bytes
    std::size_t faces = 0;  // faces whose material has a type added
    TypedMaterials materials;
};

// The bytes of `obj` with the painted types of `level` in its `usemtl` lines: a face painted "ice" whose
// material alone would not give ice gets "MATERIAL__ice". Only `usemtl` lines are changed or inserted; all
// other bytes stay. Without painted faces the bytes are the same. Errors: `obj` is not the text that the
// level's mesh was read from; a type's name that cannot be part of a material's name.
Result<NamedObj> obj_with_names(const Level& level, std::string_view obj);

struct NamedMaterials {
    LoadedLevel after;  // read again; faces whose material now gives their type are no longer painted
    std::size_t faces = 0;
    std::vector<std::filesystem::path> written, backups;
    std::string text() const;  // "types of 12 faces written into easy.obj; the old file is easy.obj.bak"
};

// Writes obj_with_names() to the level's OBJ file and, to its material library, copies of the materials
// tinted with the type's colour. Stores the previous bytes of a file as NAME.bak and replaces an older one.
// Saves the level file without the paint that is in the names now. All of these files are written or none;
// none without painted faces. Errors: geometry that is no OBJ; a file that another program has changed since
// it was read; those of write_files_atomic().
Result<NamedMaterials> name_materials(const Level& level);

// The colour of a material that carries a type: the mean of the material's own colour and the type's.
Vec3f tinted(const Vec3f& diffuse, const SurfaceType& type);

}  // namespace slipface
