# What find_package alone does not settle, for the engine's own build and for programs that find it installed.

# Debian's assimp package asks every program to link what its shared library has linked already: libz, whose -dev package
# it does not depend on, draco and minizip.
macro(slipface_repair_packages)
    if(TARGET assimp::assimp)
        get_target_property(assimp_type assimp::assimp TYPE)
        if(assimp_type STREQUAL SHARED_LIBRARY)
            set_target_properties(assimp::assimp PROPERTIES INTERFACE_LINK_LIBRARIES "")
        endif()
    endif()
endmacro()

# slipface_find_library(NAME HEADER PACKAGE): the target Slipface::NAME, for libraries without a CMake package.
function(slipface_find_library name header package)
    find_library(SLIPFACE_${name}_LIBRARY ${name})
    find_path(SLIPFACE_${name}_INCLUDE_DIR ${header})
    mark_as_advanced(SLIPFACE_${name}_LIBRARY SLIPFACE_${name}_INCLUDE_DIR)
    if(NOT SLIPFACE_${name}_LIBRARY OR NOT SLIPFACE_${name}_INCLUDE_DIR)
        message(FATAL_ERROR "Slipface: found no lib${name} with ${header}. On Debian: apt-get install ${package}")
    endif()
    if(NOT TARGET Slipface::${name})
        add_library(Slipface::${name} UNKNOWN IMPORTED GLOBAL)
        set_target_properties(Slipface::${name} PROPERTIES IMPORTED_LOCATION "${SLIPFACE_${name}_LIBRARY}"
            INTERFACE_INCLUDE_DIRECTORIES "${SLIPFACE_${name}_INCLUDE_DIR}")
    endif()
endfunction()
function(slipface_find_deflate)
    slipface_find_library(deflate libdeflate.h libdeflate-dev)
endfunction()
function(slipface_find_stb)
    slipface_find_library(stb stb/stb_image.h libstb-dev)
endfunction()
function(slipface_find_meshoptimizer)
    slipface_find_library(meshoptimizer meshoptimizer.h libmeshoptimizer-dev)
endfunction()
function(slipface_find_draco)
    slipface_find_library(draco draco/compression/decode.h libdraco-dev)
endfunction()
