// A file in memory that the program under test opens by its name.
#pragma once

#include <unistd.h>

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>

namespace slipface {

inline const std::filesystem::path& scratch_folder() {
    static const std::filesystem::path folder = [] {
        std::string name = "/dev/shm/slipface-fuzz-XXXXXX";
        if (::mkdtemp(name.data()) == nullptr) std::abort();
        std::atexit([] { std::filesystem::remove_all(scratch_folder()); });
        return name;
    }();
    return folder;
}

inline void write_scratch(const std::string& name, const std::uint8_t* data, std::size_t size) {
    std::FILE* file = std::fopen((scratch_folder() / name).c_str(), "wb");
    if (file == nullptr || std::fwrite(data, 1, size, file) != size) std::abort();
    std::fclose(file);
}

}  // namespace slipface
