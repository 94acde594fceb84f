// slipface_generate_levels OUT_FOLDER: writes the shipped levels, the same bytes at every run.
#include <fmt/format.h>

#include <exception>
#include <filesystem>

#include "easy.h"
#include "obj_writer.h"
#include "slipface/base/files.h"

namespace {

int generate(const std::filesystem::path& out) {
    using namespace slipface;
    const generate::Model easy = generate::make_easy();
    for (const auto& [name, text] : {std::pair<std::string, std::string>{"easy.obj", generate::obj_text(easy, "easy", "easy.mtl")},
                                     {"easy.mtl", generate::mtl_text(easy, "easy")}}) {
        if (const Status status = write_file_atomic(out / name, text); !status.ok()) {
            fmt::print(stderr, "{}\n", status.error().text());
            return 1;
        }
    }
    std::size_t triangles = 0;
    for (const auto& face : easy.faces()) triangles += face.vertices.size() - 2;
    fmt::print("easy: {} faces, {} triangles, {} vertices\n", easy.faces().size(), triangles, easy.positions().size());
    return 0;
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 2) {
        fmt::print(stderr, "usage: slipface_generate_levels OUT_FOLDER\n");
        return 2;
    }
    try {
        return generate(argv[1]);
    } catch (const std::exception& error) {
        fmt::print(stderr, "slipface_generate_levels: {}\n", error.what());
        return 1;
    }
}
