#include "document/path_text.h"

#include <algorithm>
#include <cstdlib>

namespace slipface {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view replacement = "\xef\xbf\xbd";

// The bytes of the UTF-8 character that begins at `at`; 0: there is none.
std::size_t character_length(std::string_view text, std::size_t at) {
    const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
    const unsigned char lead = byte(at);
    const std::size_t length = lead < 0x80   ? 1
                               : lead < 0xc2 ? 0
                               : lead < 0xe0 ? 2
                               : lead < 0xf0 ? 3
                               : lead < 0xf5 ? 4
                                             : 0;
    if (length == 0 || at + length > text.size()) return 0;
    for (std::size_t i = 1; i < length; ++i)
        if ((byte(at + i) & 0xc0) != 0x80) return 0;
    // Longer than needed, half of a UTF-16 pair, or beyond Unicode.
    if (lead == 0xe0 && byte(at + 1) < 0xa0) return 0;
    if (lead == 0xed && byte(at + 1) >= 0xa0) return 0;
    if (lead == 0xf0 && byte(at + 1) < 0x90) return 0;
    if (lead == 0xf4 && byte(at + 1) >= 0x90) return 0;
    return length;
}

// C0 and C1 controls, and delete.
bool is_control(std::string_view character) {
    const auto first = static_cast<unsigned char>(character[0]);
    if (character.size() == 1) return first < 0x20 || first == 0x7f;
    return first == 0xc2 && static_cast<unsigned char>(character[1]) < 0xa0;
}

fs::path home() {
    const char* const folder = std::getenv("HOME");
    return folder && *folder == '/' ? fs::path(folder).lexically_normal() : fs::path();
}

std::size_t common_length(std::string_view a, std::string_view b) {
    return static_cast<std::size_t>(
        std::mismatch(a.begin(), a.begin() + static_cast<std::ptrdiff_t>(std::min(a.size(), b.size())),
                      b.begin())
            .first -
        a.begin());
}

// The last `count` folders of the path's own folder.
std::string folder_end(const fs::path& path, std::size_t count) {
    fs::path end;
    fs::path folder = path.parent_path();
    for (; count > 0 && folder.has_relative_path(); --count, folder = folder.parent_path())
        end = end.empty() ? folder.filename() : folder.filename() / end;
    return printable(end.empty() ? path.parent_path().string() : end.string());
}

}  // namespace

std::string printable(std::string_view bytes) {
    std::string text;
    for (std::size_t at = 0; at < bytes.size();) {
        const std::size_t length = character_length(bytes, at);
        const std::string_view character = bytes.substr(at, std::max<std::size_t>(length, 1));
        text += length == 0 || is_control(character) ? replacement : character;
        at += character.size();
    }
    return text;
}

std::string with_tilde(const fs::path& path) {
    const fs::path folder = home();
    if (folder.has_relative_path() && path.is_absolute()) {
        const fs::path below = path.lexically_normal().lexically_relative(folder);
        if (below == ".") return "~";
        if (!below.empty() && *below.begin() != "..") return printable("~/" + below.string());
    }
    return printable(path.string());
}

fs::path expand_tilde(std::string_view text) {
    const bool alone = text == "~";
    if (!alone && !text.starts_with("~/")) return fs::path(text);
    const fs::path folder = home();
    if (folder.empty()) return fs::path(text);
    return alone ? folder / "" : folder / fs::path(text.substr(2));
}

std::vector<std::string> distinguishing_folders(std::span<const fs::path> paths) {
    std::vector<std::string> folders;
    for (const fs::path& path : paths) {
        std::size_t count = 1;
        const auto twin = [&](const fs::path& other) {
            return other != path && other.filename() == path.filename() &&
                   folder_end(other, count) == folder_end(path, count);
        };
        const auto depth = static_cast<std::size_t>(std::distance(path.begin(), path.end()));
        while (count < depth && std::any_of(paths.begin(), paths.end(), twin))
            ++count;
        folders.push_back(folder_end(path, count));
    }
    return folders;
}

PathCompletion complete_path(std::string_view text, const fs::path& base, FolderWants wants) {
    PathCompletion result{std::string(text), {}};
    if (text == "~") result.text = "~/";
    const std::size_t slash = result.text.rfind('/');
    const std::string typed_folder = slash == std::string::npos ? "" : result.text.substr(0, slash + 1);
    const std::string begun = result.text.substr(typed_folder.size());
    fs::path folder = expand_tilde(typed_folder);
    if (!folder.is_absolute()) folder = base / folder;

    wants.hidden = begun.starts_with('.');
    std::vector<std::string> names;
    for (const FolderEntry& entry : list_folder(folder, wants).entries)
        if (entry.name.starts_with(begun) && printable(entry.name) == entry.name)
            names.push_back(entry.folder ? entry.name + "/" : entry.name);
    std::sort(names.begin(), names.end());
    if (names.empty()) return result;
    std::size_t certain = names.front().size();
    for (const std::string& name : names)
        certain = std::min(certain, common_length(names.front(), name));
    // Do not end in the middle of a character.
    while (certain > begun.size() && certain < names.front().size() &&
           (static_cast<unsigned char>(names.front()[certain]) & 0xc0) == 0x80)
        --certain;
    result.text = typed_folder + names.front().substr(0, certain);
    if (names.size() > 1) result.others = std::move(names);
    return result;
}

}  // namespace slipface
