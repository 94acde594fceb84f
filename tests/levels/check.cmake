# Makes the shipped levels again and compares every file, byte for byte.
execute_process(COMMAND ${CMAKE_COMMAND} --build "${BUILD}" --target slipface_generate_levels
    RESULT_VARIABLE code OUTPUT_VARIABLE output ERROR_VARIABLE output)
if(NOT code EQUAL 0)
    message(FATAL_ERROR "slipface_generate_levels does not build:\n${output}")
endif()

file(REMOVE_RECURSE "${SCRATCH}")
file(MAKE_DIRECTORY "${SCRATCH}")
execute_process(COMMAND "${BUILD}/assets/slipface_generate_levels" "${SCRATCH}" COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND "${BUILD}/assets/slipface_generate_levels" --check-light "${SOURCE}/assets/levels"
    COMMAND_ERROR_IS_FATAL ANY)
file(GLOB_RECURSE made RELATIVE "${SCRATCH}" "${SCRATCH}/*")
if(NOT made)
    message(FATAL_ERROR "slipface_generate_levels made nothing")
endif()
foreach(name ${made})
    execute_process(COMMAND ${CMAKE_COMMAND} -E compare_files "${SCRATCH}/${name}" "${SOURCE}/assets/levels/${name}"
        RESULT_VARIABLE differs)
    if(differs)
        message(FATAL_ERROR "assets/levels/${name} is not what the generator makes")
    endif()
endforeach()
