# cmake --install puts the engine where find_package(Slipface) finds it.
include(CMakePackageConfigHelpers)

get_property(modules GLOBAL PROPERTY SLIPFACE_MODULES)
install(TARGETS ${modules} EXPORT SlipfaceTargets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(EXPORT SlipfaceTargets NAMESPACE Slipface:: DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/Slipface)
configure_package_config_file(cmake/SlipfaceConfig.cmake.in SlipfaceConfig.cmake
    INSTALL_DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/Slipface)
write_basic_package_version_file(SlipfaceConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES "${CMAKE_CURRENT_BINARY_DIR}/SlipfaceConfig.cmake" "${CMAKE_CURRENT_BINARY_DIR}/SlipfaceConfigVersion.cmake"
    DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/Slipface)
