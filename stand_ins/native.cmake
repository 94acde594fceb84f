# What find_package finds in a build for Windows on Linux: threads are those of the desktop, but Debian has no compiled libraries.
include("${CMAKE_CURRENT_LIST_DIR}/packages.cmake")
slipface_stand_in_package(TBB TBB::tbb "${CMAKE_CURRENT_LIST_DIR}/tbb")
target_sources(slipface_stand_ins PRIVATE "${CMAKE_CURRENT_LIST_DIR}/tbb/threads.cpp")
target_link_libraries(TBB::tbb INTERFACE slipface_stand_ins)

# Debian's googletest comes as sources, too.
file(WRITE "${CMAKE_FIND_PACKAGE_REDIRECTS_DIR}/GTestConfig.cmake" "add_subdirectory(/usr/src/googletest googletest EXCLUDE_FROM_ALL)\n")
