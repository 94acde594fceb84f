// Where the program stores its own files (XDG base directory specification), and where the files that ship
// with it are.
#pragma once

#include <filesystem>
#include <vector>

namespace slipface {

// $XDG_CONFIG_HOME/slipface or ~/.config/slipface: preferences and recent files.
// $XDG_STATE_HOME/slipface or ~/.local/state/slipface: autosaves.
// $XDG_CACHE_HOME/slipface or ~/.cache/slipface: thumbnails, which may be deleted at any time.
// Empty when neither the variable (an absolute path) nor HOME is known.
std::filesystem::path config_folder();
std::filesystem::path state_folder();

// The folder that holds `levels`, `presets` and `tapes`: PREFIX/share/slipface of a program in PREFIX/bin,
// else `assets` of the source tree that the program was built in. Empty when there is neither. `program` is
// the running program's file unless a caller names another.
std::filesystem::path data_folder(std::filesystem::path program = {});

// The OBJ files of the levels that ship with the program, by name. Empty when data_folder() is empty.
std::vector<std::filesystem::path> sample_levels();

}  // namespace slipface
