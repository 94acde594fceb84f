// The geometry file formats that can be read: one table for the importer, the file dialog and the command
// line's help.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

namespace slipface {

// A larger geometry file is refused before it is read.
inline constexpr std::uint64_t max_geometry_bytes = std::uint64_t{1} << 30;

struct MeshFormat {
    std::string_view ending;  // of the file name, lower case, without the dot
    std::string_view name;    // of the format, as shown in lists; several endings may have the same
};

// The formats that import_mesh() reads, "obj" first. In a browser and on Windows there are
// two: OBJ and Quake 3 maps.
std::span<const MeshFormat> mesh_formats();

// The format for the ending of the file name, in upper or lower case; null if it is not read.
const MeshFormat* mesh_format_of(const std::filesystem::path& path);

// "*.obj, *.bsp, ... or *.off"
std::string mesh_formats_text();

}  // namespace slipface
