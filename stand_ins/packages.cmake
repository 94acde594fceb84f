# What find_package finds where Debian has libraries for its own processor alone: its header-only libraries, and stand-ins for
# the compiled ones. Toolchain files include it through CMAKE_PROJECT_Slipface_INCLUDE.
# Debian's headers are linked into a folder of their own, because /usr/include has this machine's system headers, too.
set(SLIPFACE_STAND_INS ON)
set(headers "${PROJECT_BINARY_DIR}/headers")
file(MAKE_DIRECTORY "${headers}")
foreach(name nlohmann fmt CLI stb assimp fast_float)
    if(EXISTS "/usr/include/${name}")
        file(CREATE_LINK "/usr/include/${name}" "${headers}/${name}" SYMBOLIC)
    endif()
endforeach()

# slipface_stand_in_package(PACKAGE TARGET [FOLDER...]): find_package(PACKAGE) succeeds and gives TARGET.
function(slipface_stand_in_package package target)
    file(WRITE "${CMAKE_FIND_PACKAGE_REDIRECTS_DIR}/${package}Config.cmake" "set(${package}_FOUND TRUE)\n")
    if(NOT TARGET ${target})
        add_library(${target} INTERFACE IMPORTED GLOBAL)
        target_include_directories(${target} SYSTEM INTERFACE ${ARGN})
    endif()
endfunction()
slipface_stand_in_package(Eigen3 Eigen3::Eigen /usr/include/eigen3)
slipface_stand_in_package(fmt fmt::fmt "${headers}")
slipface_stand_in_package(nlohmann_json nlohmann_json::nlohmann_json "${headers}")
slipface_stand_in_package(assimp assimp::assimp "${headers}")
slipface_stand_in_package(CLI11 CLI11::CLI11 "${headers}")

# The compiled parts: stb's, and compression by stb under libdeflate's names. fmt is its headers alone.
add_library(slipface_stand_ins STATIC "${CMAKE_CURRENT_LIST_DIR}/deflate/libdeflate.cpp" "${CMAKE_CURRENT_LIST_DIR}/stb.c")
target_compile_features(slipface_stand_ins PUBLIC cxx_std_20)
target_compile_definitions(slipface_stand_ins PUBLIC FMT_HEADER_ONLY=1)
target_include_directories(slipface_stand_ins SYSTEM PUBLIC "$<BUILD_INTERFACE:${headers}>"
    "$<BUILD_INTERFACE:${CMAKE_CURRENT_LIST_DIR}/deflate>")
set_target_properties(slipface_stand_ins PROPERTIES EXPORT_NAME stand_ins)
target_link_libraries(fmt::fmt INTERFACE slipface_stand_ins)
foreach(name deflate stb meshoptimizer draco webp)
    add_library(Slipface::${name} INTERFACE IMPORTED GLOBAL)
    target_link_libraries(Slipface::${name} INTERFACE slipface_stand_ins)
    set(SLIPFACE_${name}_LIBRARY stand-in CACHE INTERNAL "")
    set(SLIPFACE_${name}_INCLUDE_DIR stand-in CACHE INTERNAL "")
endforeach()

# slipface_replace_sources(TARGET REGEX FILE...): other files, from the project's top folder, instead of those that this system
# cannot have.
function(slipface_replace_sources target without)
    get_target_property(sources ${target} SOURCES)
    list(FILTER sources EXCLUDE REGEX "${without}")
    list(TRANSFORM ARGN PREPEND "${PROJECT_SOURCE_DIR}/" OUTPUT_VARIABLE with)
    set_target_properties(${target} PROPERTIES SOURCES "${sources};${with}")
endfunction()
