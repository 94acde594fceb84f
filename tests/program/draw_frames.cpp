// A program that is not Slipface's: it draws the boxes that a file lists, `x y width height` each, as the
// frame "map" and, with a border, as "menu". SHIFT moves the first box, EXTRA is one more frame, FAIL a
// complaint.
#include <slipface/capture.h>

#include <cstdlib>
#include <fstream>
#include <iostream>

namespace {

constexpr int width = 160, height = 90;

int variable(const char* name) {
    const char* const value = std::getenv(name);
    return value == nullptr ? 0 : std::atoi(value);
}

bool draw(const std::string& frame, const char* file, std::uint8_t background) {
    std::vector<std::uint8_t> rgba(std::size_t{4} * width * height, background);
    slipface::Capture capture(frame);
    std::ifstream boxes(file);
    int count = 0;
    for (int x = 0, y = 0, w = 0, h = 0; boxes >> x >> y >> w >> h; ++count) {
        if (count == 0) x += variable("SHIFT");
        for (int row = y; row < y + h && row < height; ++row)
            for (int column = x; column < x + w && column < width; ++column)
                rgba[4 * static_cast<std::size_t>(row * width + column)] = 255;
        capture.widget("box " + std::to_string(count), x, y, w, h);
    }
    capture.number("boxes", count + variable("LOST"));
    capture.text("title", "a \"game\"");
    return capture.write(rgba.data(), width, height);
}

}  // namespace

int main(int count, char** arguments) {
    if (count != 2 || variable("FAIL") != 0) {
        std::cerr << "starting\nno such boxes\n";
        return 3;
    }
    if (variable("EXTRA") != 0) draw("credits", arguments[1], 9);
    return draw("map", arguments[1], 30) && draw("menu", arguments[1], 90) ? 0 : 1;
}
