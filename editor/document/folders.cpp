#include "document/folders.h"

#include <algorithm>
#include <cstdlib>
#include <system_error>

namespace slipface {
namespace {

std::filesystem::path xdg_folder(const char* variable, const char* below_home) {
    // The specification says to ignore relative paths in the variable.
    if (const char* given = std::getenv(variable); given && *given == '/')
        return std::filesystem::path(given) / "slipface";
    if (const char* home = std::getenv("HOME"); home && *home == '/')
        return std::filesystem::path(home) / below_home / "slipface";
    return {};
}

}  // namespace

std::filesystem::path config_folder() {
    return xdg_folder("XDG_CONFIG_HOME", ".config");
}
std::filesystem::path state_folder() {
    return xdg_folder("XDG_STATE_HOME", ".local/state");
}

std::filesystem::path data_folder(std::filesystem::path program) {
    std::error_code error;
    if (program.empty()) program = std::filesystem::read_symlink("/proc/self/exe", error);
    const auto holds_levels = [&error](const std::filesystem::path& folder) {
        return std::filesystem::is_directory(folder / "levels", error);
    };
    std::filesystem::path folder = program.parent_path();
    if (const auto installed = folder.parent_path() / "share" / "slipface"; holds_levels(installed))
        return installed;
    for (; folder.has_relative_path(); folder = folder.parent_path())
        if (holds_levels(folder / "assets")) return folder / "assets";
    return {};
}

std::vector<std::filesystem::path> sample_levels() {
    std::vector<std::filesystem::path> levels;
    const std::filesystem::path data = data_folder();
    if (data.empty()) return levels;
    std::error_code error;
    for (const auto& entry : std::filesystem::directory_iterator(data / "levels", error))
        if (entry.path().extension() == ".obj") levels.push_back(entry.path());
    std::sort(levels.begin(), levels.end());
    return levels;
}

}  // namespace slipface
