// Instead of the decompression that needs libraries.
#include "gltf/decompress.h"

namespace slipface {
namespace {

[[noreturn]] void refuse(const GltfValue& extension) {
    extension.refuse("is compressed, which only Slipface for Linux reads; export it without compression");
}

}  // namespace

std::string decompress_meshopt(const GltfValue& extension, std::string_view) {
    refuse(extension);
}

DracoMesh decompress_draco(const GltfValue& extension, std::string_view, const std::vector<std::string>&) {
    refuse(extension);
}

}  // namespace slipface
