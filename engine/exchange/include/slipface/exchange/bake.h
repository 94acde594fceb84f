// Handing painted types over to modelling tools: they go into the material names of the OBJ file, which
// survive whatever such a tool does, and new faces inherit them.
#pragma once

#include "slipface/level/level_file.h"

namespace slipface {

// The material name of each face with its type in it where the material alone would not give the type.
// `[face]` index into `names`; `of_type[name]` the type that was put in, if one was.
struct TypedMaterials {
    std::vector<std::uint32_t> face_name;
    std::vector<std::string> names;
    std::vector<std::uint32_t> base;                // [name] material of the mesh
    std::vector<std::optional<SurfaceId>> of_type;  // [name]
};
// With `rules_too`, types that only the level's rules give are put in as well: for programs that do not have
// the rules.
Result<TypedMaterials> typed_materials(const Level& level, bool rules_too);

struct BakedText {
    std::string obj;        // the file's new bytes
    std::size_t faces = 0;  // whose material changed
    TypedMaterials materials;
};

// The bytes of `obj` with the painted types of `level` in its `usemtl` lines: a face painted "ice" whose
// material alone would not make it so gets "MATERIAL__ice". Only `usemtl` lines change or come in; every
// other byte stays. With nothing painted the bytes are the same. Errors: `obj` is not what the level's mesh
// was read from; a type's name that cannot stand in a material's name.
Result<BakedText> bake_text(const Level& level, std::string_view obj);

struct Baked {
    LoadedLevel after;  // read again; what the materials now say is no longer painted
    std::size_t faces = 0;
    std::vector<std::filesystem::path> written, backups;
    std::string text() const;  // "12 faces baked into easy.obj; the file before is easy.obj.bak"
};

// Writes bake_text() to the level's OBJ file and copies of the materials, tinted with the type's colour, to
// its material library. Keeps what was there as NAME.bak (one; an older one is replaced). Refuses geometry
// that is no OBJ and a file that another program has changed since it was read. The level file is not
// written: save_level(after.level) does.
Result<Baked> bake_level(const Level& level);

// Types as a material's colour: half the material's own.
Vec3f tinted(const Vec3f& diffuse, const SurfaceType& type);

}  // namespace slipface
