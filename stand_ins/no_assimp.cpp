// Instead of the readers of formats that need assimp.
#include <assimp/DefaultLogger.hpp>
#include <assimp/NullLogger.hpp>

#include "assimp/import_scene.h"
#include "assimp/scene_child.h"
#include "gltf/import_gltf.h"

namespace slipface {

bool reads_scenes() {
    return false;
}

Result<ImportedSoup> import_scene(const std::filesystem::path& path, const std::string& extension,
                                  std::string bytes, WarningList& warnings, Progress* progress) {
    if (extension == "gltf" || extension == "glb")
        return import_gltf(path, std::move(bytes), warnings, progress);
    return Error{
        path.string(),
        "is a file of the format " + extension +
            ", which only Slipface with assimp reads (on Linux); expected *.obj, *.bsp, *.gltf or *.glb"};
}

std::optional<Result<ImportedSoup>> import_scene_in_child(const std::filesystem::path&, std::string_view,
                                                          WarningList&, Progress*) {
    return std::nullopt;
}

}  // namespace slipface

// What assimp's reader of numbers, which the OBJ reader uses, calls for numbers with too many digits.
namespace Assimp {

Logger* DefaultLogger::get() {
    static NullLogger silent;
    return &silent;
}

void Logger::warn(const char*) {}

void Intern::AllocateFromAssimpHeap::operator delete(void* memory) {
    ::operator delete(memory);
}

}  // namespace Assimp
