// Any bytes as the material library of an OBJ file.
#include <cstdlib>
#include <string_view>

#include "fuzz/scratch_file.h"
#include "slipface/mesh/import.h"

using namespace slipface;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const bool written = [] {
        const std::string_view obj =
            "mtllib level.mtl\nv 0 0 0\nv 0 0 1\nv 1 0 0\nusemtl stone\nf 1 2 3\nusemtl a b\nf 3 2 1\n";
        write_scratch("level.obj", reinterpret_cast<const std::uint8_t*>(obj.data()), obj.size());
        return true;
    }();
    write_scratch("level.mtl", data, size);
    const auto imported = import_mesh(scratch_folder() / "level.obj", 10);
    if (!written || !imported) std::abort();
    for (const Material& material : imported->mesh->materials)
        if (!material.diffuse.allFinite()) std::abort();
    return 0;
}
