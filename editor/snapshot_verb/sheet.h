// Contact sheets: many images with their names on a few pages.
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

// Tiles `images` (files) with their names, in order, on as many sheets as needed: OUT/sheet-01.png and so on.
// An unreadable image appears as its error. Returns the files written.
Result<std::vector<std::filesystem::path>> write_sheets(
    const std::vector<std::pair<std::string, std::filesystem::path>>& images,
    const std::filesystem::path& out, const SheetOptions& options = {});

// Text in the editor's font, `pixels` high; its left end and baseline are at x, y. Clipped at `right`.
void draw_text(Image& image, int x, int y, int right, const std::string& text, float pixels);

}  // namespace slipface
