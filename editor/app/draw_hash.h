// Hashes of images before they are drawn: equal hashes mean equal pixels.
#pragma once

#include <imgui.h>

#include "slipface/base/hash.h"
#include "slipface/render/level_renderer.h"
#include "slipface/render/overlay.h"

namespace slipface {

std::uint64_t hash_draw_data(const ImDrawData& data);
void hash_camera(Hasher& hasher, const Camera& camera);
void hash_style(Hasher& hasher, const LevelStyle& style);
void hash_overlay(Hasher& hasher, const Overlay& overlay);

}  // namespace slipface
