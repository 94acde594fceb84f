// The program that draws the level's faces, in variants (level_shaders.h) that are compiled at first use.
#pragma once

#include <array>

#include "gl_util.h"
#include "slipface/base/result.h"

namespace slipface {

class LevelPrograms {
  public:
    // Bits of a variant.
    static constexpr unsigned painted = 1, lit = 2, textured = 4, cutout = 8, placed = 16, posed = 32;

    explicit LevelPrograms(GlTable gl) : gl_(std::move(gl)) {}
    ~LevelPrograms();
    LevelPrograms(const LevelPrograms&) = delete;
    LevelPrograms& operator=(const LevelPrograms&) = delete;

    // The program of a variant. Error: the driver refused valid GLSL 3.30.
    Result<unsigned> get(unsigned variant);

  private:
    GlTable gl_;
    std::array<unsigned, 64> programs_{};
};

}  // namespace slipface
