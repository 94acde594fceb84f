#include "material_blocks.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "slipface/base/files.h"
#include "slipface/base/named_file.h"
#include "slipface/base/text.h"
#include "slipface/mesh/obj_lines.h"

namespace slipface {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t max_library_bytes = std::uint64_t{64} << 20;

// The lines of an MTL with their line endings.
std::vector<std::string_view> lines_of(std::string_view text) {
    std::vector<std::string_view> lines;
    while (!text.empty()) {
        const std::size_t newline = text.find('\n');
        const std::size_t size = newline == std::string_view::npos ? text.size() : newline + 1;
        lines.push_back(text.substr(0, size));
        text.remove_prefix(size);
    }
    return lines;
}

// The text after `keyword` on the line, or nothing if the line starts with another word.
std::optional<std::string_view> after_keyword(std::string_view line, std::string_view keyword) {
    line = trim(line);
    if (!line.starts_with(keyword)) return std::nullopt;
    line.remove_prefix(keyword.size());
    if (!line.empty() && line[0] != ' ' && line[0] != '\t') return std::nullopt;
    return trim(line);
}

std::string color_line(const Vec3f& color, std::string_view ending) {
    return fmt::format("Kd {:.4f} {:.4f} {:.4f}{}", color[0], color[1], color[2], ending);
}

// The lines of material `base` under another name, with another diffuse colour. Without such a material: only
// the name and the colour.
std::string block(const std::vector<std::string_view>& lines, std::string_view base, const std::string& name,
                  const Vec3f& color, std::string_view ending) {
    std::string text = "newmtl " + name + std::string(ending);
    bool inside = false;
    bool colored = false;
    for (const std::string_view line : lines) {
        if (const auto other = after_keyword(line, "newmtl")) {
            if (inside) break;
            inside = *other == base;
        } else if (inside && after_keyword(line, "Kd")) {
            text += color_line(color, ending);
            colored = true;
        } else if (inside && !trim(line).empty()) {
            text += line;
            if (!text.ends_with('\n')) text += ending;
        }
    }
    if (!colored) text += color_line(color, ending);
    return text;
}

// The libraries that the OBJ names and that may be written.
std::vector<fs::path> libraries_of(const Level& level, std::string_view obj) {
    const fs::path folder = level.mesh_path.parent_path();
    std::vector<fs::path> paths;
    for (const ObjStatement& statement : obj_statements(obj)) {
        if (statement.kind != ObjStatement::Kind::library) continue;
        const NamedFile library =
            named_file(obj.substr(statement.name_begin, statement.name_end - statement.name_begin), folder);
        std::error_code error;
        if (library && fs::is_regular_file(fs::symlink_status(library.path, error)) &&
            std::find(paths.begin(), paths.end(), library.path) == paths.end())
            paths.push_back(library.path);
    }
    return paths;
}

struct Library {
    MaterialPatch patch;
    std::vector<std::string_view> lines;  // of patch.before
    std::set<std::string_view> names;
};

std::vector<Library> read_libraries(const Level& level, std::string_view obj) {
    std::vector<Library> libraries;
    const std::vector<fs::path> paths = libraries_of(level, obj);
    libraries.reserve(paths.size());  // views into texts: they must not move
    for (const fs::path& path : paths) {
        Result<std::string> text = read_file(path, max_library_bytes);
        if (!text) continue;
        Library& library = libraries.emplace_back();
        library.patch = {path, *text, *text};
        library.lines = lines_of(library.patch.before);
        for (const std::string_view line : library.lines)
            if (const auto name = after_keyword(line, "newmtl")) library.names.insert(*name);
    }
    return libraries;
}

}  // namespace

std::vector<MaterialPatch> patch_libraries(const Level& level, std::string_view obj,
                                           const TypedMaterials& materials) {
    std::vector<Library> libraries = read_libraries(level, obj);
    std::vector<MaterialPatch> patches;
    if (libraries.empty()) return patches;
    for (std::size_t i = 0; i < materials.names.size(); ++i) {
        const std::string& name = materials.names[i];
        const auto has = [](std::string_view wanted) {
            return [wanted](const Library& library) { return library.names.contains(wanted); };
        };
        if (!materials.of_type[i] || std::any_of(libraries.begin(), libraries.end(), has(name))) continue;
        const Material& base = level.mesh->materials[materials.base[i]];
        auto library = std::find_if(libraries.begin(), libraries.end(), has(base.name));
        if (library == libraries.end()) library = libraries.begin();
        std::string& text = library->patch.after;
        const std::string_view ending = line_ending_near(library->patch.before, 0);
        if (!text.empty() && !text.ends_with('\n')) text += ending;
        text += ending;
        text += block(library->lines, base.name, name,
                      tinted(base.diffuse, level.surfaces[*materials.of_type[i]]), ending);
    }
    for (Library& library : libraries)
        if (library.patch.after != library.patch.before) patches.push_back(std::move(library.patch));
    return patches;
}

}  // namespace slipface
