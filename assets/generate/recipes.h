// The shipped levels: how each is made.
#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "model.h"
#include "slipface/level/level.h"

namespace slipface::generate {

struct Recipe {
    std::string name;
    const char* preset;  // a shipped one: how the level wants to be walked
    Model (*make)();
    // Puts surface types, paint, cameras, light and all else on the imported geometry.
    void (*annotate)(Level& level);
    // Writes what the level has beside mesh and light into `folder`; may be null.
    Status (*write_more)(const std::filesystem::path& folder) = nullptr;
};

std::span<const Recipe> recipes();

void annotate_easy(Level& level);
void annotate_hard(Level& level);
void annotate_island(Level& level);
void annotate_playground(Level& level);
Status write_island_heights(const std::filesystem::path& folder);

// The rules that all shipped levels share: what a material's name says about its faces.
void add_common_rules(Level& level);

// One face to paint by hand: the one of `material` whose middle is nearest to `point`.
struct PaintedFace {
    Vec3 point;
    const char* material;
    const char* surface;
};
void paint_faces(Level& level, std::span<const PaintedFace> faces);

}  // namespace slipface::generate
