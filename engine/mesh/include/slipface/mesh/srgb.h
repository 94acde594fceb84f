// Colours of glTF files, which are linear, and of Material, which are sRGB.
#pragma once

#include "slipface/base/types.h"

namespace slipface {

// Each channel 0..1. Source: IEC 61966-2-1.
Vec3f srgb_of_linear(const Vec3f& linear);
Vec3f linear_of_srgb(const Vec3f& srgb);

}  // namespace slipface
