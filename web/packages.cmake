# What find_package finds in a build for the web: Debian's header-only libraries, and stand-ins for the compiled ones.
# Debian's headers are linked into a folder of their own, because /usr/include has this machine's system headers, too.
set(headers "${PROJECT_BINARY_DIR}/headers")
file(MAKE_DIRECTORY "${headers}")
foreach(name nlohmann fmt CLI stb assimp fast_float)
    if(EXISTS "/usr/include/${name}")
        file(CREATE_LINK "/usr/include/${name}" "${headers}/${name}" SYMBOLIC)
    endif()
endforeach()

# slipface_web_package(PACKAGE TARGET [FOLDER...]): find_package(PACKAGE) succeeds and gives TARGET.
function(slipface_web_package package target)
    file(WRITE "${CMAKE_FIND_PACKAGE_REDIRECTS_DIR}/${package}Config.cmake" "set(${package}_FOUND TRUE)\n")
    if(NOT TARGET ${target})
        add_library(${target} INTERFACE IMPORTED GLOBAL)
        target_include_directories(${target} SYSTEM INTERFACE ${ARGN})
    endif()
endfunction()
slipface_web_package(Eigen3 Eigen3::Eigen /usr/include/eigen3)
slipface_web_package(fmt fmt::fmt "${headers}")
slipface_web_package(TBB TBB::tbb)
slipface_web_package(nlohmann_json nlohmann_json::nlohmann_json "${headers}")
slipface_web_package(assimp assimp::assimp "${headers}")
slipface_web_package(CLI11 CLI11::CLI11 "${headers}")

# The compiled parts: fmt's, stb's, and compression by stb under libdeflate's names.
add_library(slipface_web_stand_ins STATIC "${CMAKE_CURRENT_LIST_DIR}/deflate.cpp" "${CMAKE_CURRENT_LIST_DIR}/fmt.cpp"
    "${CMAKE_CURRENT_LIST_DIR}/one_thread.cpp" "${CMAKE_CURRENT_LIST_DIR}/stb.c")
target_compile_features(slipface_web_stand_ins PUBLIC cxx_std_20)
target_include_directories(slipface_web_stand_ins SYSTEM PUBLIC "${headers}")
target_link_libraries(fmt::fmt INTERFACE slipface_web_stand_ins)
foreach(name deflate stb)
    add_library(Slipface::${name} INTERFACE IMPORTED GLOBAL)
    target_link_libraries(Slipface::${name} INTERFACE slipface_web_stand_ins)
    set(SLIPFACE_${name}_LIBRARY stand-in CACHE INTERNAL "")
    set(SLIPFACE_${name}_INCLUDE_DIR stand-in CACHE INTERNAL "")
endforeach()

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

# slipface_replace_sources(TARGET REGEX FILE...): files of web/ instead of those that a browser cannot have.
function(slipface_replace_sources target without)
    get_target_property(sources ${target} SOURCES)
    list(FILTER sources EXCLUDE REGEX "${without}")
    list(TRANSFORM ARGN PREPEND "${PROJECT_SOURCE_DIR}/web/" OUTPUT_VARIABLE with)
    set_target_properties(${target} PROPERTIES SOURCES "${sources};${with}")
endfunction()
