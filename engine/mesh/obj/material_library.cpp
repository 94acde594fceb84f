#include "obj/material_library.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "obj/obj_text.h"
#include "slipface/base/files.h"
#include "slipface/base/system.h"
#include "slipface/base/text.h"

namespace slipface {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t max_library_bytes = std::uint64_t{64} << 20;

std::string with_slashes(std::string_view path) {
    std::string result(path);
    std::replace(result.begin(), result.end(), '\\', '/');
    return result;
}

// Skips the options of a texture statement. The rest is the file name, which may contain spaces.
std::string_view texture_name(std::string_view rest) {
    for (;;) {
        rest = trim(rest);
        std::string_view after = rest;
        const std::string option = to_lower(take_word(after));
        int arguments = 1;
        if (option == "-mm") {
            arguments = 2;
        } else if (option == "-o" || option == "-s" || option == "-t") {
            arguments = 3;
        } else if (option != "-blendu" && option != "-blendv" && option != "-bm" && option != "-boost" &&
                   option != "-cc" && option != "-clamp" && option != "-imfchan" && option != "-texres" &&
                   option != "-type") {
            return rest;
        }
        for (int i = 0; i < arguments; ++i) {
            std::string_view next = after;
            const std::string_view word = take_word(next);
            // -o, -s and -t may have only one or two numbers.
            if (arguments == 3 && i > 0 && !read_number(word)) break;
            after = next;
        }
        rest = after;
    }
}

// Kd r [g b]; a single number applies to all three.
bool read_color(std::string_view rest, Vec3f& color) {
    double values[3] = {0, 0, 0};
    for (int i = 0; i < 3; ++i) {
        const std::string_view word = take_word(rest);
        if (word.empty() && i == 1) {
            values[1] = values[2] = values[0];
            break;
        }
        const auto value = read_number(word);
        if (!value || !std::isfinite(*value)) return false;
        values[i] = *value;
    }
    for (int i = 0; i < 3; ++i)
        color[i] = static_cast<float>(std::clamp(values[i], 0.0, 1.0));
    return true;
}

bool has_parent_step(const fs::path& path) {
    return std::find(path.begin(), path.end(), fs::path("..")) != path.end();
}

// Loads each library once, however often and in whatever spelling it is named.
class LibraryLoader {
  public:
    LibraryLoader(const fs::path& obj, MaterialsByName& materials, std::vector<std::string>& files,
                  WarningList& warnings)
        : obj_(obj),
          folder_(obj.parent_path().empty() ? fs::path(".") : obj.parent_path()),
          materials_(materials),
          files_(files),
          warnings_(warnings) {}

    void load(const NameOnLine& statement) {
        const std::string whole = with_slashes(statement.name);
        std::error_code error;
        if (whole.find_first_of(" \t") == std::string::npos ||
            fs::is_regular_file(folder_ / inside(whole), error)) {
            return load_one(whole, statement.line);
        }
        std::string_view rest = whole;
        for (std::string_view word = take_word(rest); !word.empty(); word = take_word(rest)) {
            load_one(std::string(word), statement.line);
        }
    }

    bool any() const { return any_; }

  private:
    // A path that would leave the level's folder is replaced by its file name: exporters write paths of their
    // own machine.
    static fs::path inside(const std::string& name) {
        const fs::path path = path_of(name);
        const bool drive = name.size() > 1 && name[1] == ':';
        if (!drive && !path.has_root_path() && !has_parent_step(path)) return path.lexically_normal();
        return path.filename();
    }

    void load_one(const std::string& name, std::size_t line) {
        const std::string location = fmt::format("{}:{}", obj_.string(), line);
        const fs::path relative = inside(name);
        if (!seen_.insert(relative.generic_string()).second) return;
        if (relative.empty()) return warnings_.add(location, "mtllib names no file: ignored");
        files_.push_back((folder_ / relative).string());
        if (relative != path_of(name).lexically_normal()) {
            files_.push_back((folder_ / path_of(name)).string());
            warnings_.add(
                location,
                fmt::format("material library {} lies outside the level's folder: {} is used instead",
                            in_quotes(name), in_quotes(relative.generic_string())));
        }
        const fs::path file = folder_ / relative;
        if (!lies_within(file, folder_)) {
            return warnings_.add(location,
                                 fmt::format("material library {} leads out of the level's folder: not read",
                                             in_quotes(relative.generic_string())));
        }
        auto text = read_file(file, bytes_left_);
        if (!text) {
            return warnings_.add(location,
                                 fmt::format("material library {}: {}; only the material names are used",
                                             in_quotes(relative.generic_string()), text.error().message));
        }
        any_ = true;
        bytes_left_ -= text->size();
        read_mtl(std::move(*text), file.string(), relative.parent_path(), materials_, warnings_);
    }

    const fs::path& obj_;
    fs::path folder_;
    MaterialsByName& materials_;
    std::vector<std::string>& files_;
    WarningList& warnings_;
    std::set<std::string> seen_;
    std::uint64_t bytes_left_ = max_library_bytes;
    bool any_ = false;
};

}  // namespace

void read_mtl(std::string text, const std::string& location, const fs::path& folder,
              MaterialsByName& materials, WarningList& warnings) {
    text = text_of_file(std::move(text));
    if (const std::size_t at = find_binary(text); at != std::string::npos) {
        const bool is_library = text.find("newmtl") != std::string::npos;
        warnings.add(fmt::format("{}:{}", location, line_of(text, at)),
                     is_library ? "a byte that is not text: read as '?'"
                                : "no text; expected a material library: ignored",
                     is_library ? replace_binary(text) : 1);
        if (!is_library) return;
    }
    Material* material = nullptr;
    LineReader lines(text);
    const auto warn = [&](std::string message) {
        warnings.add(fmt::format("{}:{}", location, lines.number()), std::move(message));
    };
    bool converted = false;
    while (lines.next()) {
        std::string_view rest = lines.line();
        const std::string_view keyword = take_word(rest);
        if (keyword == "newmtl") {
            std::string name = utf8_name(trim(rest), converted);
            const auto [entry, added] = materials.try_emplace(name, named_material(name));
            material = added ? &entry->second : nullptr;
            if (!added) warn(fmt::format("material {} is defined twice: the first is used", in_quotes(name)));
        } else if (material == nullptr) {
            continue;
        } else if (keyword == "Kd") {
            if (!read_color(rest, material->diffuse)) {
                warn(fmt::format("Kd {}: expected three numbers; ignored", in_quotes(trim(rest))));
            }
        } else if (to_lower(keyword) == "map_kd") {
            const std::string name = utf8_name(with_slashes(texture_name(rest)), converted);
            if (!name.empty())
                material->texture = folder.empty() ? name : (folder / path_of(name)).generic_string();
        }
    }
}

bool load_libraries(const fs::path& obj, const std::vector<NameOnLine>& libraries, MaterialsByName& materials,
                    std::vector<std::string>& files, WarningList& warnings) {
    LibraryLoader loader(obj, materials, files, warnings);
    for (const NameOnLine& library : libraries)
        loader.load(library);
    return loader.any();
}

}  // namespace slipface
