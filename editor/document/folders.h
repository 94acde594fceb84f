// Where the program keeps its own files, as the XDG base directory specification says.
#pragma once

#include <filesystem>

namespace slipface {

// $XDG_CONFIG_HOME/slipface or ~/.config/slipface: preferences and recent files.
// $XDG_STATE_HOME/slipface or ~/.local/state/slipface: autosaves.
// $XDG_CACHE_HOME/slipface or ~/.cache/slipface: thumbnails, which may be deleted at any time.
// Empty when neither the variable (an absolute path) nor HOME is known.
std::filesystem::path config_folder();
std::filesystem::path state_folder();
std::filesystem::path cache_folder();

}  // namespace slipface
