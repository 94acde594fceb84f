// Any bytes as an OBJ file: an error or a mesh whose indices fit, and naming no material of it changes
// nothing.
#include <cstdlib>
#include <string_view>

#include "fuzz/scratch_file.h"
#include "slipface/mesh/import.h"
#include "slipface/mesh/obj_lines.h"

using namespace slipface;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    write_scratch("level.obj", data, size);
    const auto imported = import_mesh(scratch_folder() / "level.obj", 10);
    if (!imported) return 0;
    const Mesh& mesh = *imported->mesh;
    for (const auto& triangle : mesh.triangles)
        for (const std::uint32_t corner : triangle)
            if (mesh.corner_vertex.at(corner) >= mesh.positions.size()) std::abort();
    if (!mesh.bounds.min.allFinite() || !mesh.bounds.max.allFinite()) std::abort();
    face_neighbours(mesh);

    const std::string_view text(reinterpret_cast<const char*>(data), size);
    if (text.find('\0') != std::string_view::npos) return 0;  // such files are never written
    std::size_t faces = 0;
    for (const ObjStatement& statement : obj_statements(text)) {
        if (statement.begin > size || statement.name_begin > statement.name_end || statement.name_end > size)
            std::abort();
        if (statement.kind != ObjStatement::Kind::face) continue;
        if (faces >= mesh.face_count() ||
            statement.corners != mesh.face_corner_count(static_cast<FaceId>(faces)))
            std::abort();
        ++faces;
    }
    if (faces != mesh.face_count()) std::abort();
    return 0;
}
