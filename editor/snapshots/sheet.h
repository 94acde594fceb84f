// Contact sheets: many pictures with their names on a few, to be looked at together.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "slipface/image/image.h"

namespace slipface {

struct SheetOptions {
    int width = 2400, height = 1600;  // of a sheet, pixels
    int columns = 4;
};

// Tiles `pictures` (files) under their names, in order, on as many sheets as they need: OUT/sheet-01.png and
// so on. A picture that cannot be read is shown as its error. Returns the files written.
Result<std::vector<std::filesystem::path>> write_sheets(
    const std::vector<std::pair<std::string, std::filesystem::path>>& images,
    const std::filesystem::path& out, const SheetOptions& options = {});

// Text in the editor's font, `pixels` high, its left end and baseline at x, y; cut off at `right`.
void draw_text(Image& image, int x, int y, int right, const std::string& text, float pixels);

}  // namespace slipface
