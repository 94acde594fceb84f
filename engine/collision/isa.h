// The namespace of code that is compiled once for each instruction set. Inline functions and types in it have
// another name in each, so the linker never takes one that was compiled for AVX-512 into code for every
// processor.
#pragma once

#if defined(__AVX512VL__)
#define SLIPFACE_ISA avx512
#elif defined(__AVX2__)
#define SLIPFACE_ISA avx2
#else
#define SLIPFACE_ISA baseline
#endif
