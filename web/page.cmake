# The page: the editor as WebAssembly, the levels that come with it, and the HTML around it. `cmake --install` makes a folder
# that any file server can serve.
set(page "${PROJECT_SOURCE_DIR}/web")
add_executable(slipface_page "${page}/main.cpp" "${page}/host.cpp" "${page}/keys.cpp")
target_link_libraries(slipface_page PRIVATE slipface_editor_app nlohmann_json::nlohmann_json)
slipface_compile_rules(slipface_page)
set_target_properties(slipface_page PROPERTIES OUTPUT_NAME slipface)
target_link_options(slipface_page PRIVATE -sENVIRONMENT=web -sMIN_WEBGL_VERSION=2 -sMAX_WEBGL_VERSION=2
    -sFORCE_FILESYSTEM=1 -sEXPORTED_RUNTIME_METHODS=FS,ccall,UTF8ToString,setValue -sEXPORTED_FUNCTIONS=_main,_malloc,_free
    "SHELL:--preload-file ${PROJECT_SOURCE_DIR}/assets/levels@/assets/levels"
    "SHELL:--preload-file ${PROJECT_SOURCE_DIR}/assets/presets@/assets/presets"
    "SHELL:--preload-file ${PROJECT_SOURCE_DIR}/assets/tapes@/assets/tapes")
set_target_properties(slipface_page PROPERTIES LINK_DEPENDS "${page}/page.cmake")
install(FILES "${page}/page/index.html" "${page}/page/page.css" "${page}/page/page.js"
    "${PROJECT_SOURCE_DIR}/editor/desktop/slipface.svg" "${PROJECT_SOURCE_DIR}/LICENSE" "${PROJECT_SOURCE_DIR}/NOTICES" "$<TARGET_FILE_DIR:slipface_page>/slipface.js"
    "$<TARGET_FILE_DIR:slipface_page>/slipface.wasm" "$<TARGET_FILE_DIR:slipface_page>/slipface.data" DESTINATION . COMPONENT page)
