# Targets with the house's compile rules: the warnings, and floating point gives the same bits everywhere.

function(slipface_compile_rules target)
    # Every part formats text, and no public header needs fmt, so each links it for itself.
    target_link_libraries(${target} PRIVATE fmt::fmt)
    target_compile_options(${target} PRIVATE
        $<$<COMPILE_LANGUAGE:CXX>:-Wall -Wextra -Wpedantic -Wconversion -Wshadow $<$<BOOL:${SLIPFACE_WERROR}>:-Werror>>
        $<$<COMPILE_LANG_AND_ID:CXX,Clang>:-Wshadow-uncaptured-local>
        -ffp-contract=off -fno-fast-math)
    # GCC 12 sees overlapping and overlong copies in std::string's operator+ that are not there (its bug 105651), and its
    # SLP vectoriser drops the rounding of double(float(x)).
    if(CMAKE_CXX_COMPILER_ID STREQUAL GNU)
        target_compile_options(${target} PRIVATE
            $<$<COMPILE_LANGUAGE:CXX>:-Wno-restrict -Wno-array-bounds -Wno-stringop-overflow -fno-tree-slp-vectorize>)
    endif()
    # Windows aligns the stack to 16 bytes, and GCC keeps vectors of 32 and 64 there with instructions that ask for more (its
    # bug 54412). The assembler replaces them by those that do not ask.
    if(MINGW AND CMAKE_CXX_COMPILER_ID STREQUAL GNU)
        target_compile_options(${target} PRIVATE $<$<COMPILE_LANGUAGE:CXX>:-Wa,-muse-unaligned-vector-move>)
    endif()
    if(EMSCRIPTEN)
        # Its std::size_t has 32 bits, as what indexes have, which on the desktop are shorter; files as large as that do not
        # fit into its memory.
        target_compile_options(${target} PRIVATE
            $<$<COMPILE_LANGUAGE:CXX>:-Wno-shorten-64-to-32 -Wno-sign-conversion>)
    endif()
    if(SLIPFACE_SANITIZE)
        # Instrumented code makes GCC warn of what is not there; the plain builds keep warnings out.
        target_compile_options(${target} PRIVATE -fsanitize=${SLIPFACE_SANITIZE} -fno-omit-frame-pointer
            -fno-sanitize-recover=all $<$<COMPILE_LANGUAGE:CXX>:-Wno-error>)
        target_link_options(${target} PUBLIC -fsanitize=${SLIPFACE_SANITIZE})
    endif()
    # Nobody waits for a test as long as for its compiler.
    if(target MATCHES "tests_|pch_test")
        target_compile_options(${target} PRIVATE $<$<AND:$<CONFIG:Release>,$<COMPILE_LANGUAGE:CXX>>:-O1>)
    endif()
    if(SLIPFACE_UNITY AND target MATCHES "${SLIPFACE_UNITY_TARGETS}" AND
       (target MATCHES "^tests_" OR NOT SLIPFACE_UNITY STREQUAL TESTS))
        set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 8)
        # Names of files' own meet in one translation unit; a build without SLIPFACE_UNITY is told of real shadows.
        target_compile_options(${target} PRIVATE $<$<COMPILE_LANGUAGE:CXX>:-Wno-shadow>
            $<$<COMPILE_LANG_AND_ID:CXX,GNU>:-Wno-subobject-linkage>)
    endif()
    # The program's own two files would wait longer for a header of their kind than they gain by it; the libraries for C and
    # Python hide their names, and a precompiled header has to agree in that.
    if(SLIPFACE_PCH AND NOT target MATCHES "^slipface(_c|_mover.*|_python|_movement)?$|slipface_pch_")
        slipface_precompile(${target})
    endif()
endfunction()

# With SLIPFACE_UNITY these are compiled eight files at a time: what every file instantiates anew is then compiled once
# for eight of them. A build from nothing takes about half the time; one after a small change takes longer.
set(SLIPFACE_UNITY_TARGETS
    "^(slipface_(mesh|movement|level|doctor|exchange|light|sim|repair|scenes|render|editor_.*|cli|generate_levels)|tests_.*)$")

# Precompiling costs seconds and 100 MB, so targets of one kind share one: they have the same flags and read the same
# headers. A row: which targets (the first that matches counts), the kind, its header in cmake/, and whose headers that reads.
set(SLIPFACE_PRECOMPILED
    "^tests_editor$|test_editor|precompiled_test_editor.h|slipface_editor_widgets slipface_editor_tools GTest::gmock"
    "^tests_(level|levels|c|doctor|exchange|world|sim|reach|recast|repair|scenes|render|snapshot|cli)$|test_level|precompiled_test_level.h|slipface_level GTest::gmock"
    "^tests_|test|precompiled_test.h|GTest::gmock"
    "^slipface_(level|doctor|exchange|light|world|sim|reach|repair|scenes|render|editor_goldens|editor_snapshots|editor_document|editor_tools|editor_nightly|cli)$|level|precompiled_level.h|slipface_level"
    "^slipface_editor_(panels|app|snapshot_verb)$|editor|precompiled_editor.h|slipface_editor_widgets slipface_editor_tools"
    "|library|precompiled.h|")

# Executables have flags of their own, and a kind of their own with them.
function(slipface_precompile target)
    get_target_property(type ${target} TYPE)
    foreach(row IN LISTS SLIPFACE_PRECOMPILED)
        string(REGEX MATCH "^(.*)\\|([a-z_]+)\\|([a-z_.]+)\\|([A-Za-z0-9_: ]*)$" row "${row}")
        set(targets "${CMAKE_MATCH_1}")
        set(kind "${CMAKE_MATCH_2}")
        set(header "${CMAKE_MATCH_3}")
        separate_arguments(libraries UNIX_COMMAND "${CMAKE_MATCH_4}")
        if(targets STREQUAL "" OR target MATCHES "${targets}")
            break()
        endif()
    endforeach()
    if(type STREQUAL EXECUTABLE AND NOT kind MATCHES "^test")
        set(kind program_${kind})
    endif()
    set(host slipface_pch_${kind})
    if(NOT TARGET ${host})
        set(source "${PROJECT_BINARY_DIR}/${host}.cpp")
        if(type STREQUAL EXECUTABLE)
            file(CONFIGURE OUTPUT "${source}" CONTENT "int main() { return 0; }\n")
            add_executable(${host} "${source}")
        else()
            file(CONFIGURE OUTPUT "${source}" CONTENT "namespace slipface {}\n")
            add_library(${host} OBJECT "${source}")
        endif()
        target_link_libraries(${host} PRIVATE Eigen3::Eigen fmt::fmt)
        foreach(library IN LISTS libraries)
            if(library MATCHES "::")
                target_link_libraries(${host} PRIVATE ${library})
                continue()
            endif()
            # Linking our own would be a circle: they wait for this header.
            target_include_directories(${host} PRIVATE $<TARGET_PROPERTY:${library},INTERFACE_INCLUDE_DIRECTORIES>)
            target_include_directories(${host} SYSTEM PRIVATE
                $<TARGET_PROPERTY:${library},INTERFACE_SYSTEM_INCLUDE_DIRECTORIES>)
        endforeach()
        slipface_compile_rules(${host})
        target_precompile_headers(${host} PRIVATE "$<$<COMPILE_LANGUAGE:CXX>:${PROJECT_SOURCE_DIR}/cmake/${header}>")
    endif()
    target_precompile_headers(${target} REUSE_FROM ${host})
endfunction()

# slipface_need(ITEM...): of what a target links, the engine's modules are added and the packages are found, unless they are
# there already.
function(slipface_need)
    foreach(item IN LISTS ARGN)
        if(TARGET ${item} OR NOT item MATCHES "^([A-Za-z0-9_]+)::([A-Za-z0-9_]+)$")
            continue()
        endif()
        set(package ${CMAKE_MATCH_1})
        set(name ${CMAKE_MATCH_2})
        if(NOT package STREQUAL Slipface)
            find_package(${package} REQUIRED)
            slipface_repair_packages()
        elseif(name MATCHES "^(deflate|stb|meshoptimizer|draco|webp)$")
            cmake_language(CALL slipface_find_${name})
        else()
            add_subdirectory("${PROJECT_SOURCE_DIR}/engine/${name}" "${PROJECT_BINARY_DIR}/engine/${name}")
        endif()
    endforeach()
endfunction()

# slipface_module(NAME DEPENDS ... PRIVATE_DEPENDS ...): the engine module in the current folder, as the target
# Slipface::NAME. Its public headers lie in include/slipface/NAME. A module sees only what it depends on, so an
# include from a floor above does not build.
function(slipface_module name)
    cmake_parse_arguments(arg "" "" "DEPENDS;PRIVATE_DEPENDS" ${ARGN})
    slipface_need(fmt::fmt ${arg_DEPENDS} ${arg_PRIVATE_DEPENDS})
    # What only headers give is needed to build a module, not to link it.
    list(TRANSFORM arg_PRIVATE_DEPENDS REPLACE "^nlohmann_json::.*" "$<BUILD_INTERFACE:\\0>")
    file(GLOB_RECURSE sources CONFIGURE_DEPENDS "${CMAKE_CURRENT_SOURCE_DIR}/*.cpp" "${CMAKE_CURRENT_SOURCE_DIR}/*.h")
    set(target slipface_${name})
    add_library(${target} ${sources})
    add_library(Slipface::${name} ALIAS ${target})
    set_target_properties(${target} PROPERTIES EXPORT_NAME ${name} VERSION ${PROJECT_VERSION}
        SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR} DEFINE_SYMBOL "" INSTALL_RPATH "$ORIGIN")
    target_compile_features(${target} PUBLIC cxx_std_20)
    target_include_directories(${target}
        PUBLIC $<BUILD_INTERFACE:${CMAKE_CURRENT_SOURCE_DIR}/include> $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>
        PRIVATE ${CMAKE_CURRENT_SOURCE_DIR})
    target_link_libraries(${target} PUBLIC ${arg_DEPENDS} PRIVATE ${arg_PRIVATE_DEPENDS})
    slipface_compile_rules(${target})
    set_property(GLOBAL APPEND PROPERTY SLIPFACE_MODULES ${target})
    if(SLIPFACE_INSTALL)
        install(DIRECTORY include/slipface DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT ${name})
    endif()

    # What a program that links this module has to find: the names of SlipfaceConfig.cmake. A shared library has found its
    # private ones itself.
    set(needs ${arg_DEPENDS})
    if(NOT BUILD_SHARED_LIBS)
        list(APPEND needs ${arg_PRIVATE_DEPENDS} fmt::fmt)
    endif()
    list(FILTER needs INCLUDE REGEX "^[A-Za-z0-9_]+::")
    list(TRANSFORM needs REPLACE "^Slipface::" "")
    list(TRANSFORM needs REPLACE "::.*" "")
    set_property(GLOBAL APPEND_STRING PROPERTY SLIPFACE_NEEDS "set(slipface_needs_${name} ${needs})\n")
endfunction()
