# Cross-compiling for browsers and node with Debian's emscripten. scripts/build_web.sh uses it.
include(/usr/share/emscripten/cmake/Modules/Platform/Emscripten.cmake)
set(CMAKE_PROJECT_Slipface_INCLUDE "${CMAKE_CURRENT_LIST_DIR}/packages.cmake")
# Where emscripten's standard library or the browser lack something, a header of the same name comes first.
set(CMAKE_CXX_FLAGS_INIT "-isystem ${CMAKE_CURRENT_LIST_DIR}/stand_ins -fwasm-exceptions")
set(CMAKE_C_FLAGS_INIT "-fwasm-exceptions")
if(SLIPFACE_WEB_SIMD)
    string(APPEND CMAKE_CXX_FLAGS_INIT " -msimd128 -msse2 -include ${CMAKE_CURRENT_LIST_DIR}/stand_ins/eigen_asm.h -isystem /usr/include/eigen3")
    string(APPEND CMAKE_C_FLAGS_INIT " -msimd128")
endif()
list(APPEND CMAKE_TRY_COMPILE_PLATFORM_VARIABLES SLIPFACE_WEB_SIMD)
# A browser has no threads for a page that its server does not isolate: std::thread is a call on the page's one thread
# (one_thread.cpp).
set(CMAKE_EXE_LINKER_FLAGS_INIT "-fwasm-exceptions -sALLOW_MEMORY_GROWTH=1 -sMAXIMUM_MEMORY=4GB -sINITIAL_MEMORY=64MB -sTOTAL_STACK=2MB -Wl,--wrap=pthread_create,--wrap=pthread_join,--wrap=pthread_detach,--wrap=sched_yield")
