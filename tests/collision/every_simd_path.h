// A test that runs on every instruction set.
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "slipface/collision/simd.h"

namespace slipface {

// Every instruction set that this processor has, one after the other, and then the one that was chosen.
class EverySimdPath : public testing::Test {
  protected:
    void TearDown() override { set_simd_path(before_); }

  private:
    std::string before_{simd_path()};
};

}  // namespace slipface
