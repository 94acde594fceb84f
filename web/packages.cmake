# What find_package finds in a build for the web, besides what every build without Debian's compiled libraries has.
include("${CMAKE_CURRENT_LIST_DIR}/../stand_ins/packages.cmake")
# The page's own headers first: it has one thread.
slipface_stand_in_package(TBB TBB::tbb "${CMAKE_CURRENT_LIST_DIR}/stand_ins" "${CMAKE_CURRENT_LIST_DIR}/../stand_ins/tbb")
target_sources(slipface_stand_ins PRIVATE "${CMAKE_CURRENT_LIST_DIR}/one_thread.cpp")

# Dear ImGui from Debian's source package, which scripts/build_web.sh unpacks: its library is for the desktop's processor.
file(GLOB imgui_folder "${PROJECT_BINARY_DIR}/imgui-*")
if(imgui_folder)
    add_library(slipface_web_imgui STATIC "${imgui_folder}/imgui.cpp" "${imgui_folder}/imgui_draw.cpp"
        "${imgui_folder}/imgui_tables.cpp" "${imgui_folder}/imgui_widgets.cpp" "${imgui_folder}/imgui_stdlib.cpp")
    target_compile_features(slipface_web_imgui PRIVATE cxx_std_20)
    # WebGL 2 draws no indices relative to a vertex, so indices have 32 bits.
    target_compile_definitions(slipface_web_imgui PUBLIC "ImDrawIdx=unsigned int")
    target_include_directories(slipface_web_imgui SYSTEM PUBLIC "${imgui_folder}")
    set(IMGUI_LIBRARY slipface_web_imgui CACHE INTERNAL "")
    set(IMGUI_INCLUDE_DIR "${imgui_folder}" CACHE INTERNAL "")
endif()
