// Decides whether two images are the same. The thresholds follow measurements of rasteriser noise against the
// smallest real changes (docs/snapshots.md).
#pragma once

#include <array>
#include <span>
#include <string>

#include "slipface/image/image.h"

namespace slipface {

struct CompareTolerance {
    int pixel_delta = 2;  // a pixel differs when any channel differs by more than this, 0..255
    double ratio =
        0.0005;  // at most this fraction of the pixels may differ, or `minimum_pixels` if that is more
    int minimum_pixels = 10;
    int strong_delta = 4;   // a pixel differs strongly when any channel differs by more than this
    int window = 16;        // side of the density window, pixels
    int window_pixels = 6;  // this many strongly differing pixels in one window fail
};

inline constexpr CompareTolerance scene_tolerance{};
inline constexpr CompareTolerance ui_tolerance{.pixel_delta = 1, .window_pixels = 4};

struct Comparison {
    bool same = false;
    bool size_differs = false;
    int max_delta = 0;          // largest channel difference
    std::size_t differing = 0;  // pixels that differ by more than pixel_delta
    std::size_t allowed = 0;    // how many pixels may differ
    int densest_window = 0;     // strongly differing pixels in the worst window, of all window positions
    int densest_x = 0, densest_y = 0;  // its upper left corner, pixels
    std::string verdict;               // one line with the numbers that decided
};

// Compares colour and alpha. Images of different size are never the same.
Comparison compare_images(const Image& expected, const Image& actual, const CompareTolerance& tolerance);

// What two releases of the drawing libraries may do to an image that shows the same: they draw edges and
// textures otherwise, so only the mean colours of squares are compared.
struct CoarseTolerance {
    int square = 16;          // side, pixels
    double mean_delta = 6.0;  // a square differs when the mean of any channel differs by more than this
    double ratio = 0.0;       // at most this fraction of the squares may differ
};

// Letters of another release stand otherwise, so squares hold several of them.
inline constexpr CoarseTolerance ui_elsewhere{.square = 64, .mean_delta = 8.0};

// Fills of a comparison: same, size_differs, max_delta, and differing and allowed as squares; and the
// verdict.
Comparison compare_coarsely(const Image& expected, const Image& actual, const CoarseTolerance& tolerance);

// A part of an image that is not compared: a clock, a version number, the output of another program.
struct MaskRect {
    int x = 0, y = 0, width = 0, height = 0;  // pixels from the upper left corner
    friend bool operator==(const MaskRect&, const MaskRect&) = default;
};

// Returns `actual` with the masked parts copied from `expected`, so that they cannot differ. If the sizes
// differ, `actual` is returned unchanged.
Image masked(const Image& expected, Image actual, std::span<const MaskRect> masks);

// How many pixels would differ at another tolerance. Shows whether a result was close to the limit.
struct SweepRow {
    int pixel_delta = 0;
    std::size_t differing = 0;
};
std::array<SweepRow, 8> threshold_sweep(const Image& expected,
                                        const Image& actual);  // all zero if the sizes differ

// Shows where two images differ: the expected image in faint grey, differing pixels from yellow (weak) to red
// (strong). Images of different size are compared over the larger width and height; a pixel that only one of
// them has counts as the strongest difference.
Image difference_image(const Image& expected, const Image& actual);

}  // namespace slipface
