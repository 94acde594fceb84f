# cmake --install puts the engine where find_package(Slipface) and pkg-config find it, and the program with its levels,
# manual pages and entry in the desktop's menu beside it.
include(CMakePackageConfigHelpers)

get_property(modules GLOBAL PROPERTY SLIPFACE_MODULES)
set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/Slipface)
# A component and a file of targets for each module: `cmake --install build --component movement`, after those of the modules
# below it, and find_package(Slipface COMPONENTS movement) meet nothing of the modules above.
list(TRANSFORM modules REPLACE "^slipface_" "" OUTPUT_VARIABLE slipface_names)
foreach(name IN LISTS slipface_names)
    install(TARGETS slipface_${name} EXPORT Slipface_${name} COMPONENT ${name}
        DESTINATION ${CMAKE_INSTALL_LIBDIR})
    install(EXPORT Slipface_${name} NAMESPACE Slipface:: DESTINATION ${package_folder} COMPONENT ${name})
endforeach()
if(SLIPFACE_STAND_INS)
    install(TARGETS slipface_stand_ins EXPORT Slipface_stand_ins COMPONENT base DESTINATION ${CMAKE_INSTALL_LIBDIR})
    install(EXPORT Slipface_stand_ins NAMESPACE Slipface:: DESTINATION ${package_folder} COMPONENT base)
endif()
foreach(name mover c)
    if(TARGET slipface_${name})
        list(APPEND slipface_names ${name})  # engine/mover/CMakeLists.txt installs it
    endif()
endforeach()
list(JOIN slipface_names " " slipface_names)
get_property(slipface_needs GLOBAL PROPERTY SLIPFACE_NEEDS)
install(FILES LICENSE NOTICES README.md DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT base)
install(DIRECTORY docs/ DESTINATION ${CMAKE_INSTALL_DOCDIR} FILES_MATCHING PATTERN "*.md" PATTERN site EXCLUDE)
configure_package_config_file(cmake/SlipfaceConfig.cmake.in SlipfaceConfig.cmake INSTALL_DESTINATION ${package_folder})
write_basic_package_version_file(SlipfaceConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES "${CMAKE_CURRENT_BINARY_DIR}/SlipfaceConfig.cmake" "${CMAKE_CURRENT_BINARY_DIR}/SlipfaceConfigVersion.cmake"
    cmake/SlipfaceLibraries.cmake DESTINATION ${package_folder} COMPONENT base)

# Static libraries in an order that the linker resolves: those that use others first. The floors are listed ground first.
list(REVERSE modules)
list(TRANSFORM modules PREPEND "-l")
list(JOIN modules " " libraries)
file(RELATIVE_PATH prefix_from_here "${CMAKE_INSTALL_FULL_LIBDIR}/pkgconfig" "${CMAKE_INSTALL_PREFIX}")
string(REGEX REPLACE "/$" "" prefix_from_here "${prefix_from_here}")
# pkg-config --libs NAME links a program in C or C++ with the shared library; with --static, and where only the static one is,
# also with that. slipface-cpp has the modules, for programs in C++; it names assimp itself, because Debian's assimp.pc names files
# that only those need who build assimp.
if(TARGET slipface_mover_shared)
    list(APPEND pkgconfig slipface-mover)
endif()
if(NOT SLIPFACE_STAND_INS)
    list(APPEND pkgconfig slipface-cpp)
    if(TARGET slipface_c_shared)
        list(APPEND pkgconfig slipface)
    endif()
endif()
foreach(name IN LISTS pkgconfig)
    configure_file(cmake/${name}.pc.in ${name}.pc @ONLY)
    string(REPLACE "slipface-" "" component ${name})
    install(FILES "${CMAKE_CURRENT_BINARY_DIR}/${name}.pc" DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig COMPONENT ${component})
endforeach()

if(TARGET slipface)
    if(BUILD_SHARED_LIBS)
        set_target_properties(slipface PROPERTIES INSTALL_RPATH "$ORIGIN/../${CMAKE_INSTALL_LIBDIR}")
    endif()
    install(TARGETS slipface DESTINATION ${CMAKE_INSTALL_BINDIR})
    install(DIRECTORY assets/levels assets/presets assets/movesets assets/climb assets/tapes assets/props assets/blender DESTINATION ${CMAKE_INSTALL_DATADIR}/slipface
        PATTERN __pycache__ EXCLUDE)
endif()
if(TARGET slipface AND NOT WIN32)
    install(FILES editor/desktop/slipface.desktop DESTINATION ${CMAKE_INSTALL_DATADIR}/applications)
    install(FILES editor/desktop/slipface.xml DESTINATION ${CMAKE_INSTALL_DATADIR}/mime/packages)
    install(FILES editor/desktop/org.slipface.Slipface.metainfo.xml DESTINATION ${CMAKE_INSTALL_DATADIR}/metainfo)
    install(FILES editor/desktop/slipface.svg DESTINATION ${CMAKE_INSTALL_DATADIR}/icons/hicolor/scalable/apps)
    # The program writes these from its tables, so they are made when it is there for certain.
    install(CODE "
        set(share \"\$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}/${CMAKE_INSTALL_DATADIR}\")
        file(MAKE_DIRECTORY \"\${share}/man/man1\" \"\${share}/bash-completion/completions\")
        execute_process(COMMAND \"$<TARGET_FILE:slipface>\" docs --man \"\${share}/man/man1\"
            --completion \"\${share}/bash-completion/completions/slipface\" COMMAND_ERROR_IS_FATAL ANY)")
endif()

# `cmake --build build/windows --target package`: out/slipface-windows.zip.
if(WIN32)
    set(CPACK_GENERATOR ZIP)
    set(CPACK_PACKAGE_FILE_NAME slipface-windows)
    set(CPACK_OUTPUT_FILE_PREFIX "${PROJECT_SOURCE_DIR}/out")
    include(CPack)
endif()
