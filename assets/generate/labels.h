// The numbers on the signs of the test room, all in one texture.
#pragma once

#include <array>
#include <string>

#include "model.h"

namespace slipface::generate {

inline constexpr int label_columns = 4;
inline constexpr int label_rows = 8;

// What stands in the cells, row by row from the top; '*' is a degree sign.
inline constexpr std::array<const char*, 25> labels{
    "5*",  "10*", "15*", "20*", "25*", "30*", "35*", "40*", "45*", "49*", "55*",  "60*", "65*",
    "70*", "75*", "85*", "0.1", "0.2", "0.3", "0.4", "0.5", "0.6", "24",  "SEAM", "ICE"};

// A sign with that text, as large as the rectangle whose lower edge runs from `from` to `to` (left to right),
// twice as wide as high.
void add_label(Model& model, const std::string& text, const Vec3& from, const Vec3& to);

}  // namespace slipface::generate
