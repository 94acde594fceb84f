// Included by <xmmintrin.h> of compilers that know MMX; WebAssembly has none.
