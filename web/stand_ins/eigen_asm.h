// Included before every file when Eigen uses WebAssembly's vectors as SSE. To Eigen clang is GCC 4.2, for
// whose errors it has assembler text for x86. A newer version has none of it.
#pragma once
#include <Eigen/src/Core/util/Macros.h>
#undef EIGEN_COMP_GNUC
#define EIGEN_COMP_GNUC 120
