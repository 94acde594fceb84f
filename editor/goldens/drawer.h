// What drew an image: the releases of the libraries whose pixels differ between releases. Images of one
// drawer are compared exactly, those of two coarsely, or with a golden of the drawer's own
// (docs/snapshots.md).
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace slipface {

// From the "renderer" section of an image's numbers: "Mesa 22.3", and for a window with the interface's
// library and letters, "Mesa 22.3, Dear ImGui 1.86, letters 5f1c09aa". Empty where the numbers have none.
std::string drawn_by(std::string_view numbers);

// The folder, below that of the goldens, of images that were approved for this drawer alone:
// "renderers/mesa-22.3". Empty for an empty drawer.
std::filesystem::path drawers_folder(std::string_view drawer);

}  // namespace slipface
