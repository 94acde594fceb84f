// The namespace of code that is compiled once for each instruction set. Its inline functions and types have a
// different name in each, so the linker cannot use one that was compiled for AVX-512 on every processor.
#pragma once

#if defined(__AVX512VL__)
#define SLIPFACE_ISA avx512
#elif defined(__AVX2__)
#define SLIPFACE_ISA avx2
#else
#define SLIPFACE_ISA baseline
#endif
