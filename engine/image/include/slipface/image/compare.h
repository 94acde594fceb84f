// The gate that decides whether two pictures are the same. Thresholds follow measurements of rasteriser noise
// against the smallest real changes (docs/snapshots.md).
#pragma once

#include <array>
#include <span>
#include <string>

#include "slipface/image/image.h"

namespace slipface {

struct CompareTolerance {
    int pixel_delta = 2;  // a pixel differs when any channel differs by more than this, 0..255
    double ratio =
        0.0005;  // at most this fraction of pixels (and at least `minimum_pixels` of them) may differ
    int minimum_pixels = 10;
    int strong_delta = 4;   // a pixel differs strongly when any channel differs by more than this
    int window = 16;        // side of the density window, pixels
    int window_pixels = 6;  // as many strongly differing pixels within one window fail
};

inline constexpr CompareTolerance scene_tolerance{};
inline constexpr CompareTolerance ui_tolerance{.pixel_delta = 1, .window_pixels = 4};

struct Comparison {
    bool same = false;
    bool size_differs = false;
    int max_delta = 0;          // largest channel difference
    std::size_t differing = 0;  // pixels beyond pixel_delta
    std::size_t allowed = 0;    // pixels that may be
    int densest_window = 0;     // strongly differing pixels in the worst window (every position is tried)
    int densest_x = 0, densest_y = 0;
    std::string verdict;  // one line with the numbers that decided
};

// Compares colour and alpha. Pictures of different size are never the same.
Comparison compare_images(const Image& expected, const Image& actual, const CompareTolerance& tolerance);

// A part of a picture that is not compared: a clock, a version number, what somebody else draws.
struct MaskRect {
    int x = 0, y = 0, width = 0, height = 0;  // pixels from the upper left corner
    friend bool operator==(const MaskRect&, const MaskRect&) = default;
};

// `actual` with the masked parts taken from `expected`, so that they cannot differ. Pictures of different
// size stay as they are.
Image masked(const Image& expected, Image actual, std::span<const MaskRect> masks);

// How many pixels would differ at other tolerances: whether a limit decided, or a landslide.
struct SweepRow {
    int pixel_delta = 0;
    std::size_t differing = 0;
};
std::array<SweepRow, 8> threshold_sweep(const Image& expected,
                                        const Image& actual);  // none for unequal sizes

// Where they differ: the expected picture in faint grey, differing pixels from yellow (weak) to red (strong).
// Pictures of different size are compared over the larger of both, what is missing counting as strongest
// difference.
Image difference_image(const Image& expected, const Image& actual);

}  // namespace slipface
