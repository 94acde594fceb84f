#include "document/folders.h"

#include <cstdlib>

namespace slipface {
namespace {

std::filesystem::path xdg_folder(const char* variable, const char* below_home) {
    // Relative paths in the variable are to be ignored.
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
std::filesystem::path cache_folder() {
    return xdg_folder("XDG_CACHE_HOME", ".cache");
}

}  // namespace slipface
