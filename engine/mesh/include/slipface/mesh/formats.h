// Which geometry files can be read: one table for the importer, the file dialog and the command line's help.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>

namespace slipface {

struct MeshFormat {
    std::string_view ending;  // of the file's name, lower case, without the dot
    std::string_view name;    // of the format, as a list shows it; endings of one format share it
};

// What import_mesh() reads, "obj" first.
std::span<const MeshFormat> mesh_formats();

// The format that the file's name tells, upper or lower case; null: none that is read.
const MeshFormat* mesh_format_of(const std::filesystem::path& path);

// "*.obj, *.bsp, ... or *.off"
std::string mesh_formats_text();

}  // namespace slipface
